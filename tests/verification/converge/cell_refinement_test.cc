// SPDX-License-Identifier: MIT
// The claims about uniform refinement on made-up ladders: what theory says passes, planted faults
// do not.
#include "homogenization/cell/laminate.h"
#include "verification/converge/cell_refinement.h"
#include "verification/stress/stress_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

using namespace homespun;
using namespace homespun::verification;

namespace
{
const Phase soft = homogenization::isotropic("soft", 1e6, 0.3, 1e-3, 100.);
const Phase hard = homogenization::isotropic("hard", 1e7, 0.3, 1e-3, 100.);

UnitCell laminate()
{
  return stripe_cell(4, soft, hard);
}

UnitCell inclusion()
{
  return inclusion_cell(8, soft, hard);
}

Eigen::Matrix3d limit_stiffness()
{
  return homogenization::laminate_stiffness(laminate().stiffness_of_phase(), {0.5, 0.5});
}

const homogenization::Singularity &singularity()
{
  static const homogenization::Singularity of_inclusion = []
  {
    const UnitCell cell = inclusion();
    return homogenization::singularity_of(
      homogenization::corners_of(cell.mesh, cell.lattice, cell.stiffness_of_phase()));
  }();
  return of_inclusion;
}

/// Both orders on n levels, C = C_limit (1 + error(p, h)).
std::vector<RefinementLadder>
ladders_of(const std::function<double(unsigned order, double h)> &error, const int n = 6)
{
  std::vector<RefinementLadder> ladders = {{1, {}}, {2, {}}};
  for (RefinementLadder &ladder : ladders)
    for (int k = 0; k < n; ++k)
    {
      const double h = 0.1 * std::pow(0.5, k);
      ladder.levels.push_back(
        {h, 100ul << 2 * k, (1. + error(ladder.order, h)) * limit_stiffness(), 1.});
    }
  return ladders;
}

/// The order of the corners, with P1 ten times P2.
std::vector<RefinementLadder> as_theory_says()
{
  return ladders_of(
    [](const unsigned order, const double h)
    { return (order == 1 ? 0.1 : 0.01) * std::pow(h, 2. * singularity().strongest); });
}

ConvergenceResult judged(const UnitCell &cell, const std::vector<RefinementLadder> &ladders)
{
  ConvergenceResult result;
  judge_refinements(cell, ladders, result);
  return result;
}

/// The outcome of the one claim that holds these words.
Verdict claim(const ConvergenceResult &result, const std::string &words)
{
  std::vector<Verdict> found;
  for (const Verdict &verdict : result.verdicts)
    if (verdict.claim.find(words) != std::string::npos)
      found.push_back(verdict);
  EXPECT_EQ(found.size(), 1u) << words;
  return found.empty() ? Verdict() : found[0];
}

std::vector<Outcome> outcomes(const ConvergenceResult &result)
{
  std::vector<Outcome> all;
  for (const Verdict &verdict : result.verdicts)
    all.push_back(verdict.outcome);
  return all;
}
} // namespace

TEST(exact_cell_refinement, orders_of_the_corners_pass_and_give_error_bars)
{
  const ConvergenceResult result = judged(inclusion(), as_theory_says());
  EXPECT_EQ(outcomes(result), std::vector<Outcome>(7, Outcome::pass));
  EXPECT_GT(claim(result, "the same check finds").value, 0.);
  for (const Series &series : result.series)
    if (series.quantity.rfind("C16", 0) != 0 && series.quantity.rfind("C26", 0) != 0)
    {
      EXPECT_TRUE(series.has_error_bar()) << series.quantity;
    }
    else // zero on every level: no limit is made of round-off
    {
      EXPECT_FALSE(series.richardson.has_value());
    }
}

TEST(exact_cell_refinement, limits_of_orders_are_sharp)
{
  const homogenization::Singularity its = singularity();
  ASSERT_TRUE(its.exists);
  const OrderLimit p1 = order_of_energy(its, 1), p2 = order_of_energy(its, 2);
  EXPECT_GT(p1.lowest, 1.);
  EXPECT_NEAR(p1.highest, 2.1, 1e-12);
  EXPECT_NEAR(p2.lowest, p1.lowest, 1e-12);
  EXPECT_NEAR(p2.highest, 2. * its.next + 0.1, 1e-12);
  EXPECT_LT(p2.highest, 3.);
}

TEST(exact_cell_refinement, weak_corners_of_a_polygon_do_not_fail_a_sound_cell)
{
  // A stiff 24-gon: 0.893 and 0.959 below 1, the next 1.194. Orders drift from above towards 2 x
  // 0.893.
  const homogenization::Singularity polygon = {true, 0.893, 0.959, 1.194};
  const OrderLimit limit                    = order_of_energy(polygon, 2);
  EXPECT_GT(limit.highest, 2. * 1.194);
  EXPECT_LT(limit.lowest, 2. * 0.893);
  std::vector<double> h, energy;
  for (int k = 0; k < 5; ++k)
  {
    h.push_back(0.1 * std::pow(0.5, k));
    energy.push_back(1. + 0.011 * std::pow(h.back(), 1.79) + 0.002 * std::pow(h.back(), 1.92) +
                     0.038 * std::pow(h.back(), 2.39));
  }
  EXPECT_NE(judge_values(h, energy, limit, 1e-12).outcome, Outcome::fail);
}

TEST(exact_cell_refinement, a_laminate_is_held_against_its_closed_form)
{
  const auto exact             = ladders_of([](unsigned, double) { return 0.; });
  const ConvergenceResult good = judged(laminate(), exact);
  EXPECT_EQ(outcomes(good), std::vector<Outcome>(2, Outcome::pass));
  for (const Series &series : good.series)
    EXPECT_FALSE(series.richardson.has_value());
  // The same on every level and wrong.
  const auto wrong = ladders_of([](unsigned, double) { return 1e-6; });
  EXPECT_EQ(claim(judged(laminate(), wrong), "closed form").outcome, Outcome::fail);
}

TEST(exact_cell_refinement, a_laminate_of_high_contrast_may_lose_what_round_off_takes_and_no_more)
{
  // 226 rows of triangles on the finest level, contrast 1.9e10: a stiff stripe moves by 1e-3 of the
  // soft one's stretch, the energy by 9e-7; on coarser levels by less.
  const UnitCell cell =
    stripe_cell(4, soft, homogenization::isotropic("rigid", 1e16, 0.3, 1e-3, 100.));
  const Eigen::Matrix3d exact =
    homogenization::laminate_stiffness(cell.stiffness_of_phase(), {0.5, 0.5});
  for (const double error : {5e-8, 5e-6})
  {
    auto ladders = ladders_of([](unsigned, double) { return 0.; });
    for (RefinementLadder &ladder : ladders)
      for (RefinedCell &level : ladder.levels)
        level.stiffness = (1. + error * static_cast<double>(level.n_dofs) / 102400.) * exact;
    EXPECT_EQ(claim(judged(cell, ladders), "closed form").outcome,
              error < 1e-6 ? Outcome::pass : Outcome::fail);
    EXPECT_EQ(
      claim(judged(laminate(), ladders_of([&](unsigned, double) { return error; })), "closed form")
        .outcome,
      Outcome::fail);
  }
}

TEST(tripwire_cell_refinement, characteristic_displacements_lost_at_corners_are_noticed)
{
  // chi = 0 gives Voigt's mean on every level: it falls in the Loewner order, and it is the same
  // everywhere.
  const auto lost = ladders_of([](unsigned, double) { return 0.7; });
  EXPECT_EQ(claim(judged(inclusion(), lost), "changes with mesh").outcome, Outcome::fail);
}

TEST(tripwire_cell_refinement, linear_elements_in_the_place_of_quadratic_ones_are_noticed)
{
  const auto with = [](const double of_p2)
  {
    return claim(judged(inclusion(), ladders_of(
                                       [&](const unsigned order, const double h) {
                                         return (order == 1 ? 0.1 : of_p2) *
                                                std::pow(h, 2. * singularity().strongest);
                                       })),
                 "energies of P2 lie below")
      .outcome;
  };
  EXPECT_EQ(with(0.09), Outcome::pass);
  EXPECT_EQ(with(0.1), Outcome::fail);  // the same
  EXPECT_EQ(with(0.11), Outcome::fail); // above
}

TEST(tripwire_cell_refinement, an_order_that_corners_do_not_allow_is_noticed)
{
  for (const double wrong : {0.8, 3., 4.})
  {
    const auto ladders =
      ladders_of([&](const unsigned order, const double h)
                 { return (order == 1 ? 0.1 : 0.01) * std::pow(10. * h, wrong); });
    for (const char *order : {"; P1", "; P2"})
      EXPECT_EQ(claim(judged(inclusion(), ladders), order).outcome, Outcome::fail) << wrong;
  }
}

TEST(tripwire_cell_refinement, a_level_that_is_not_a_number_fails_every_claim)
{
  for (const std::size_t level : {0u, 3u, 5u})
    for (const std::size_t ladder : {0u, 1u})
    {
      auto ladders = as_theory_says();
      ladders[ladder].levels[level].stiffness.setConstant(std::numeric_limits<double>::quiet_NaN());
      const ConvergenceResult corners = judged(inclusion(), ladders);
      EXPECT_EQ(claim(corners, "Loewner").outcome, Outcome::fail);
      EXPECT_EQ(claim(corners, "changes with mesh").outcome, Outcome::fail);
      EXPECT_EQ(claim(corners, "energies of P2 lie below").outcome, Outcome::fail);
      EXPECT_EQ(claim(corners, ladder == 0 ? "; P1" : "; P2").outcome, Outcome::fail);
      EXPECT_EQ(claim(corners, "limits of P1 and P2").outcome, Outcome::inconclusive);
      EXPECT_EQ(claim(judged(laminate(), ladders), "closed form").outcome, Outcome::fail);
    }
}

TEST(tripwire_cell_refinement, a_rise_from_level_to_level_is_noticed)
{
  const auto rising = ladders_of([](unsigned, const double h) { return -std::pow(h, 1.4); });
  EXPECT_EQ(claim(judged(inclusion(), rising), "Loewner").outcome, Outcome::fail);
}

TEST(exact_cell_refinement, what_round_off_may_hide_is_inconclusive)
{
  // 23 rows on the coarsest level and 716 on the finest, contrast 1.9e13: round-off takes 1e-4 to
  // 10 % of an energy.
  const Phase rigid      = homogenization::isotropic("rigid", 1e19, 0.3, 1e-3, 100.);
  const UnitCell stripes = stripe_cell(4, soft, rigid);
  auto exact             = ladders_of([](unsigned, double) { return 0.; });
  for (RefinementLadder &ladder : exact)
    for (RefinedCell &level : ladder.levels)
    {
      level.n_dofs = 1000ul << 2 * (&level - ladder.levels.data());
      level.stiffness =
        (1. + 1e-5) * homogenization::laminate_stiffness(stripes.stiffness_of_phase(), {0.5, 0.5});
    }
  EXPECT_EQ(claim(judged(stripes, exact), "closed form").outcome, Outcome::inconclusive);
  // A stiffness that does not change at strong corners has lost them, unless round-off is larger
  // than any change.
  const auto still         = ladders_of([](unsigned, const double h) { return 1e-7 * h; });
  const auto with_contrast = [&](const double modulus)
  { return inclusion_cell(8, soft, homogenization::isotropic("hard", modulus, 0.3, 1e-3, 100.)); };
  EXPECT_EQ(claim(judged(with_contrast(1e7), still), "changes with mesh").outcome, Outcome::pass);
  EXPECT_EQ(claim(judged(with_contrast(1e19), still), "changes with mesh").outcome,
            Outcome::inconclusive);
}

TEST(exact_cell_refinement, limits_of_orders_that_drift_agree_by_chance_and_prove_nothing)
{
  const auto drifting =
    ladders_of([](const unsigned order, const double h)
               { return (order == 1 ? 0.1 : 0.01) * std::exp(-1. / (h + 0.02)); },
               5);
  const ConvergenceResult result = judged(inclusion(), drifting);
  ASSERT_EQ(claim(result, "; P2").outcome, Outcome::inconclusive);
  EXPECT_EQ(claim(result, "limits of P1 and P2").outcome, Outcome::inconclusive);
  for (const Series &series : result.series)
    EXPECT_FALSE(series.has_error_bar()) << series.quantity;
}

TEST(exact_cell_refinement,
     a_ladder_that_ended_early_is_inconclusive_and_an_empty_one_claims_nothing)
{
  const ConvergenceResult brief =
    judged(inclusion(), ladders_of([](unsigned, const double h) { return h; }, 2));
  EXPECT_EQ(claim(brief, "; P1").outcome, Outcome::inconclusive);
  EXPECT_TRUE(judged(inclusion(), {{1, {}}, {2, {}}}).verdicts.empty());
}
