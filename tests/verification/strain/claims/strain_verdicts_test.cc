// SPDX-License-Identifier: MIT
// The judge, on synthetic rows: it must pass what is right and fail what is planted.
#include "verification/record/convergence.h"
#include "verification/strain/claims/strain_verdicts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace homespun::verification;

namespace
{
using Rows = std::vector<StrainRow>;

StrainRow row(const std::string &load, const double strain, const std::string &method,
              const double error_m, const double uncertainty_m = 1e-12)
{
  StrainRow one   = {"cell", load, strain, "biot", method, 20, 800, 288000};
  one.mean        = error_m;
  one.per_cell    = error_m / 0.01;
  one.uncertainty = one.bar = uncertainty_m;
  one.bar_safety            = 1.25;
  return one;
}

/// The verdicts of a study that was asked for the strains of its rows.
std::vector<Verdict> judged(const Rows &rows)
{
  std::vector<double> strains;
  for (const StrainRow &one : rows)
    strains.push_back(one.strain);
  std::sort(strains.begin(), strains.end());
  strains.erase(std::unique(strains.begin(), strains.end()), strains.end());
  return strain_verdicts(rows, strains);
}

Rows periodic(const double order)
{
  Rows rows;
  for (const double strain : {1e-3, 1e-2, 1e-1})
    rows.push_back(row("periodic-12", strain, "localized", 1e-4 * std::pow(strain, order)));
  return rows;
}

Rows sheet(const double affine, const double localized, const double uncertainty)
{
  return {row("strip-1", 0.01, "affine", affine, uncertainty),
          row("strip-1", 0.01, "localized", localized, uncertainty)};
}
} // namespace

TEST(exact_verdicts, the_slope_of_a_power_law_is_its_exponent)
{
  for (const double order : {1., 2., 3.5})
    EXPECT_NEAR(judged(periodic(order))[0].value, order, 1e-5);
}

TEST(tripwire_verdicts, the_second_order_passes_and_the_first_fails)
{
  EXPECT_EQ(judged(periodic(2.))[0].outcome, Outcome::pass);
  EXPECT_EQ(judged(periodic(1.))[0].outcome, Outcome::fail); // a lost or turned chi
  // The shear of a cell with mirrors has no quadratic term.
  EXPECT_EQ(judged(periodic(3.))[0].outcome, Outcome::pass);
}

TEST(tripwire_verdicts, a_cell_without_biot_is_judged_against_yarn_and_one_with_both_against_biot)
{
  const auto of_law = [](Rows rows, const std::string &cell, const std::string &law)
  {
    for (StrainRow &one : rows)
    {
      one.cell      = cell;
      one.reference = law;
    }
    return rows;
  };
  const auto slopes = [](const Rows &rows)
  {
    std::vector<std::pair<std::string, Outcome>> found;
    for (const Verdict &verdict : judged(rows))
      if (const auto at = verdict.claim.find("localized error against "); at != std::string::npos)
        found.emplace_back(verdict.claim.substr(0, 5) + verdict.claim.substr(at + 24, 4),
                           verdict.outcome);
    return found;
  };
  // One study of two cells: each has its law.
  Rows rows = of_law(periodic(1.), "weave", "yarn");
  for (const StrainRow &one : of_law(periodic(2.), "plate", "biot"))
    rows.push_back(one);
  using Found = std::vector<std::pair<std::string, Outcome>>;
  EXPECT_EQ(slopes(rows), (Found{{"weaveyarn", Outcome::fail}, {"platebiot", Outcome::pass}}));
  for (const StrainRow &one : of_law(periodic(2.), "weave", "biot"))
    rows.push_back(one);
  EXPECT_EQ(slopes(rows), (Found{{"platebiot", Outcome::pass}, {"weavebiot", Outcome::pass}}));
  // Green is no law of the coarse cloth, and its slope no claim.
  EXPECT_TRUE(slopes(of_law(periodic(1.), "plate", "green")).empty());
}

TEST(tripwire_verdicts, the_affine_motion_must_not_pass_for_one_of_second_order)
{
  const auto judged_of = [](const double affine)
  {
    Rows rows = periodic(2.);
    for (const double strain : {1e-3, 1e-2, 1e-1})
      rows.push_back(row("periodic-12", strain, "affine", 1e-4 * std::pow(strain, affine)));
    std::vector<Outcome> found;
    for (const Verdict &verdict : judged(rows))
      if (verdict.claim.find("does not pass for one") != std::string::npos)
        found.push_back(verdict.outcome);
    return found;
  };
  EXPECT_EQ(judged_of(1.), std::vector<Outcome>{Outcome::pass});
  EXPECT_TRUE(judged_of(2.).empty()); // not what theory says of affine: nothing is claimed
  EXPECT_TRUE(judged_of(1.5).empty());
}

TEST(tripwire_verdicts,
     strains_that_are_not_small_for_the_cell_decide_nothing_until_smaller_ones_do)
{
  // Quadratic at first, then less than that: a yarn that has turned into the load.
  const auto error = [](const double strain, const double first_order)
  { return 1e-2 * (first_order * strain + strain * strain / (1. + strain / 2e-4)); };
  const auto rows_of = [&](const std::vector<double> &strains, const double first_order)
  {
    Rows rows;
    for (const double strain : strains)
      rows.push_back(row("periodic-11", strain, "localized", error(strain, first_order)));
    return rows;
  };
  EXPECT_EQ(judged(rows_of({1e-4, 1e-3, 1e-2, 0.1}, 0.))[0].outcome, Outcome::inconclusive);
  const std::vector<double> smaller = {1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1};
  EXPECT_EQ(judged(rows_of(smaller, 0.))[0].outcome, Outcome::pass);
  EXPECT_EQ(judged(rows_of(smaller, 1e-3))[0].outcome, Outcome::fail);
}

TEST(tripwire_verdicts, a_term_of_first_order_fails_at_any_size_that_shows)
{
  // At the default strains; a chi that is off by so much that the order falls towards zero strain.
  for (const double first_order : {3e-3, 1e-2, 2e-2, 0.1})
  {
    Rows rows;
    for (const double strain : {1e-3, 2e-3, 5e-3, 0.01, 0.02, 0.05, 0.1})
      rows.push_back(
        row("periodic-12", strain, "localized", 1e-4 * (first_order * strain + strain * strain)));
    EXPECT_EQ(judged(rows)[0].outcome, Outcome::fail) << first_order;
  }
}

TEST(tripwire_verdicts, an_order_that_overshoots_two_is_open_until_smaller_strains_settle_it)
{
  // satin pulled along its yarns, measured: quadratic below 1e-4, straightening at 1e-3, another
  // equilibrium at 1 %.
  const std::vector<std::pair<double, double>> measured = {
    {1e-6, 9.24e-13}, {1e-5, 9.22e-11}, {1e-4, 8.91e-9}, {1e-3, 6.73e-7}, {1e-2, 1.31e-3}};
  const auto outcome = [&](const std::size_t first)
  {
    Rows rows;
    for (std::size_t k = first; k < measured.size(); ++k)
      rows.push_back(row("periodic-11", measured[k].first, "localized", 0.01 * measured[k].second));
    return judged(rows)[0].outcome;
  };
  EXPECT_EQ(outcome(2), Outcome::inconclusive);
  EXPECT_EQ(outcome(0), Outcome::pass);
}

TEST(tripwire_verdicts, an_order_between_one_and_two_that_does_not_rise_is_open)
{
  // satin pulled along its yarns, measured from 0.1 % on, where it has left small strain already.
  const std::vector<std::pair<double, double>> measured = {
    {1e-3, 8.28e-7}, {1e-2, 2.75e-5}, {0.05, 2.99e-4}, {0.1, 8.18e-4}};
  Rows rows;
  for (const auto &[strain, per_cell] : measured)
    rows.push_back(row("periodic-11", strain, "localized", 0.01 * per_cell));
  const Verdict open = judged(rows)[0];
  EXPECT_EQ(open.outcome, Outcome::inconclusive);
  EXPECT_NE(open.limit.find("give smaller --strains"), std::string::npos) << open.limit;
  EXPECT_EQ(judged(periodic(1.8))[0].outcome, Outcome::inconclusive);
  // What a first order beside a second looks like on the whole: 1.5, and rising.
  Rows of_both;
  for (const double strain : {1e-3, 1e-2, 1e-1})
    of_both.push_back(
      row("periodic-12", strain, "localized", 1e-4 * (0.01 * strain + strain * strain)));
  EXPECT_EQ(judged(of_both)[0].outcome, Outcome::fail);
}

TEST(tripwire_verdicts, an_error_that_is_not_a_number_fails)
{
  Rows rows        = periodic(2.);
  rows[2].per_cell = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judged(rows)[0].outcome, Outcome::fail);
}

TEST(tripwire_verdicts, two_of_three_levels_leave_the_claim_open)
{
  Rows rows   = periodic(2.);
  rows.back() = row("periodic-12", 0.1, unreached, 0.);
  EXPECT_EQ(strain_verdicts(rows, {1e-3, 1e-2, 0.1})[0].outcome, Outcome::inconclusive);
}

TEST(tripwire_verdicts, a_level_that_was_not_reached_is_open_also_beyond_the_loss_of_the_law)
{
  // Not reached at 10 %. The last equilibrium, at 5 %, has a triangle that is lost: the law ends.
  Rows rows   = periodic(2.);
  rows.back() = row("periodic-12", 0.1, unreached, 0.);
  LevelRow last;
  last.cell                         = "cell";
  last.load                         = "periodic-12";
  last.reference                    = "biot";
  last.strain                       = 0.05;
  last.part                         = "yarn";
  last.triangles                    = 10;
  last.lost                         = 1;
  last.least                        = -0.25; // from 1 at rest: zero at 4 %
  const std::vector<double> strains = {1e-3, 1e-2, 0.1};
  const auto claim_of_reach         = [&](const std::vector<LevelRow> &ellipticity)
  {
    const std::vector<Verdict> all = strain_verdicts(rows, strains, ellipticity);
    // Two levels that are left decide no slope.
    EXPECT_EQ(all.front().outcome, Outcome::inconclusive);
    EXPECT_EQ(all.front().limit == "2 +- 0.1; the law is lost at 4 %", !ellipticity.empty());
    return all.back();
  };
  EXPECT_EQ(claim_of_reach({}).outcome, Outcome::inconclusive);
  const Verdict told = claim_of_reach({last});
  EXPECT_EQ(told.outcome, Outcome::inconclusive);
  EXPECT_EQ(told.value, 1.);
  EXPECT_NE(told.claim.find("the law is lost at 4 %"), std::string::npos) << told.claim;
  // No level at all beyond the loss: the law ends, and no solver is at fault.
  const Rows none = {rows.back()};
  EXPECT_EQ(strain_verdicts(none, {0.1}, {last}).back().outcome, Outcome::inconclusive);
  EXPECT_EQ(strain_verdicts(none, {0.1}).back().outcome, Outcome::fail);
  // Lost only beyond the level that is missing: that explains nothing.
  last.strain = 0.2;
  EXPECT_EQ(strain_verdicts(rows, strains, {last}).back().outcome, Outcome::inconclusive);
}

TEST(tripwire_verdicts, what_the_strains_of_a_study_cannot_decide_is_no_claim)
{
  Rows rows = periodic(2.);
  rows.pop_back();
  for (const Verdict &verdict : judged(rows))
    EXPECT_EQ(verdict.claim.find("slope"), std::string::npos) << verdict.claim;
  Rows far = sheet(2e-5, 1e-5, 1e-7);
  for (StrainRow &one : far)
    one.strain = 0.2;
  for (const Verdict &verdict : judged(far))
    EXPECT_EQ(verdict.claim.find("closer"), std::string::npos) << verdict.claim;
}

TEST(tripwire_verdicts, a_load_without_a_single_level_fails_and_one_that_lacks_some_is_open)
{
  const auto of_reach = [](const Rows &rows)
  {
    const std::vector<Verdict> verdicts = judged(rows);
    for (const Verdict &verdict : verdicts)
      if (verdict.claim.find("find an equilibrium") != std::string::npos)
        return verdict;
    return Verdict();
  };
  const StrainRow none      = row("shear-frame", 0.6, unreached, 0.),
                  also_none = row("shear-frame", 0.8, unreached, 0.),
                  reached   = row("shear-frame", 0.6, "localized", 1e-6);
  EXPECT_EQ(of_reach({none, also_none}).outcome, Outcome::fail);
  EXPECT_EQ(status_of(judged({none, also_none})), exit_status::claim_failed);
  EXPECT_EQ(of_reach({reached, also_none}).outcome, Outcome::inconclusive);
  EXPECT_EQ(of_reach({reached, also_none}).value, 1.);
  EXPECT_NE(of_reach({reached, also_none}).claim.find("none from strain 0.8"), std::string::npos);
  EXPECT_EQ(of_reach({reached}).outcome, Outcome::pass);
}

TEST(tripwire_verdicts, every_limit_says_where_it_comes_from)
{
  Rows rows = periodic(2.);
  for (const StrainRow &one : sheet(2e-5, 1e-5, 1e-7))
    rows.push_back(one);
  for (const Verdict &verdict : judged(rows))
    EXPECT_FALSE(verdict.derivation.empty()) << verdict.claim;
}

TEST(tripwire_verdicts, no_level_in_the_window_decides_nothing_and_does_not_crash)
{
  const Rows rows = {row("periodic-12", 0.2, "localized", 1e-5)};
  for (const Verdict &verdict : judged(rows))
    EXPECT_EQ(verdict.claim.find("slope"), std::string::npos);
}

TEST(tripwire_verdicts, a_small_true_error_at_small_strain_is_not_taken_for_round_off)
{
  Rows rows;
  for (const double strain : {1e-4, 2e-4, 4e-4})
    rows.push_back(row("periodic-12", strain, "localized", 0.01 * 1e-3 * strain * strain));
  EXPECT_EQ(judged(rows)[0].claim.find("is zero"), std::string::npos);
  EXPECT_EQ(judged(rows)[0].outcome, Outcome::pass);
}

TEST(tripwire_verdicts, without_an_error_bar_a_gain_is_inconclusive)
{
  Rows rows   = sheet(2e-5, 1e-5, 1e-7);
  rows[1].bar = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(judged(rows)[0].outcome, Outcome::inconclusive);
}

TEST(exact_verdicts, round_off_is_recognised_as_zero)
{
  Rows rows;
  for (const double strain : {1e-3, 1e-2, 1e-1})
    rows.push_back(row("periodic-11", strain, "localized", 1e-17));
  EXPECT_EQ(judged(rows)[0].outcome, Outcome::pass);
  EXPECT_NE(judged(rows)[0].claim.find("is zero"), std::string::npos);
}

TEST(tripwire_verdicts, a_gain_within_the_error_bar_is_no_gain)
{
  EXPECT_EQ(judged(sheet(2e-5, 1e-5, 1e-7))[0].outcome, Outcome::pass);
  EXPECT_EQ(judged(sheet(1e-5, 2e-5, 1e-7))[0].outcome, Outcome::fail);
  EXPECT_EQ(judged(sheet(2e-5, 1.95e-5, 1e-6))[0].outcome, Outcome::inconclusive);
}

TEST(exact_verdicts, levels_that_were_not_reached_are_left_out_of_slopes)
{
  Rows rows = periodic(2.);
  rows.push_back(row("periodic-12", 0.05, unreached, 0.));
  EXPECT_EQ(judged(rows)[0].outcome, Outcome::pass);
  EXPECT_NEAR(judged(rows)[0].value, 2., 1e-5);
}
