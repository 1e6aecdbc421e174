// SPDX-License-Identifier: MIT
// Printed digits, and the checks of brackets.
#include "verification/cell/assessed_cell.h"
#include "verification/cell/cell_summary.h"
#include "verification/cell/energy_order.h"
#include "verification/record/number_text.h"
#include "verification/stress/stress_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace homespun;
using namespace homespun::verification;

namespace
{
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

UnitCell inclusion()
{
  return inclusion_cell(8, homogenization::isotropic("soft", 1e6, 0.3, 1e-3, 100.),
                        homogenization::isotropic("hard", 1e8, 0.3, 1e-3, 100.));
}

Outcome outcome_of(const std::vector<Verdict> &checks, const std::string &words)
{
  for (const Verdict &check : checks)
    if (check.claim.find(words) != std::string::npos)
      return check.outcome;
  ADD_FAILURE() << "no check says: " << words;
  return Outcome::inconclusive;
}
} // namespace

TEST(exact_printed_digits, bars_are_rounded_up_and_carry_the_rounding_of_the_value)
{
  EXPECT_EQ(with_bar(2.12345678, 1.49e-2), "2.12 +- 0.02");
  EXPECT_EQ(with_bar(2.125, 0.0151), "2.13 +- 0.03");
  EXPECT_EQ(with_bar(1581.7, 0.96), "1582 +- 2");
  EXPECT_EQ(with_bar(1581.7, 0.085), "1581.70 +- 0.09");
  EXPECT_EQ(with_bar(-0.25, 0.0999), "-0.3 +- 0.2");
  EXPECT_EQ(with_bar(123456., 1234.), "123000 +- 2e+03");
  EXPECT_EQ(with_bar(2., nan_value), "2 +- nan");
}

TEST(bound_printed_digits, no_value_within_its_bar_is_outside_of_what_is_printed)
{
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> mantissa(-10., 10.), exponent(-9., 4.);
  for (int k = 0; k < 20000; ++k)
  {
    const double value = mantissa(generator) * 100., bar = std::pow(10., exponent(generator));
    const std::string text = with_bar(value, bar);
    const double printed = std::stod(text), up = std::stod(text.substr(text.find("+-") + 2));
    EXPECT_GE(printed + up, value + bar - 1e-12) << text;
    EXPECT_LE(printed - up, value - bar + 1e-12) << text;
    EXPECT_LE(up, 3. * bar) << text; // and it is not vast
  }
}

TEST(tripwire_bracket_checks, what_is_not_a_number_fails_and_no_bracket_is_inconclusive)
{
  EXPECT_TRUE(std::isnan(larger(1., nan_value)));
  EXPECT_TRUE(std::isnan(larger(nan_value, 1.)));
  EXPECT_EQ(larger(1., 2.), 2.);
  EXPECT_EQ(larger(2., 1.), 2.);
  const Eigen::Matrix3d I    = Eigen::Matrix3d::Identity(),
                        none = Eigen::Matrix3d::Constant(nan_value);
  EXPECT_TRUE(std::isnan(order_violation(none, I)) && std::isnan(order_violation(I, none)));
  EXPECT_TRUE(std::isnan(energy_difference(none, I)) && std::isnan(energy_difference(I, none)));

  CellBracket cell_bracket;
  cell_bracket.remark = "none: a hole that the outline cuts";
  const auto missing  = checks_of(cell_bracket, {}, I, 0.);
  EXPECT_EQ(outcome_of(missing, "has a bracket"), Outcome::inconclusive);
  EXPECT_EQ(missing[0].limit, cell_bracket.remark);
  // What --max-dofs leaves out is no claim, unless --tolerance asks for it.
  cell_bracket.is_left_out = true;
  EXPECT_TRUE(checks_of(cell_bracket, {}, I, 0.).empty());
  BracketOptions asked_for;
  asked_for.tolerance = 0.1;
  EXPECT_EQ(outcome_of(checks_of(cell_bracket, asked_for, I, 0.), "as narrow as"), Outcome::fail);

  homogenization::Bracket bracket;
  bracket.lower = 0.9 * I, bracket.upper = bracket.stiffness = I, bracket.width = 0.1;
  cell_bracket.bracket       = bracket;
  cell_bracket.on_given_mesh = I;
  EXPECT_EQ(outcome_of(checks_of(cell_bracket, {}, I, 0.), "C_lower <= C_upper"), Outcome::pass);
  EXPECT_EQ(outcome_of(checks_of(cell_bracket, {}, none, 0.), "Both codes agree"), Outcome::fail);
  EXPECT_EQ(outcome_of(checks_of(cell_bracket, {}, none, 1.), "Both codes agree"), Outcome::fail);
  EXPECT_EQ(outcome_of(checks_of(cell_bracket, {}, 1.001 * I, 0.), "Both codes agree"),
            Outcome::fail);
  EXPECT_EQ(outcome_of(checks_of(cell_bracket, {}, 1.001 * I, 0.01), "Both codes agree"),
            Outcome::inconclusive);
  // One load whose gap is wider than what the bracket says.
  EXPECT_EQ(outcome_of(checks_of(cell_bracket, {}, I, 0.), "wider gap"), Outcome::pass);
  for (int k = 0; k < 3; ++k)
  {
    cell_bracket.bracket->lower       = 0.9 * I;
    cell_bracket.bracket->lower(k, k) = 0.89;
    EXPECT_EQ(outcome_of(checks_of(cell_bracket, {}, I, 0.), "wider gap"), Outcome::fail) << k;
  }
  cell_bracket.bracket->lower = none;
  EXPECT_EQ(outcome_of(checks_of(cell_bracket, {}, I, 0.), "C_lower <= C_upper"), Outcome::fail);
}

TEST(tripwire_bracket_checks, a_bracket_that_memory_does_not_hold_is_refused_before_it_starts)
{
  const UnitCell cell = inclusion();
  BracketOptions options;
  EXPECT_EQ(too_large_text(cell, options), "");
  options.refine   = 11;
  options.max_dofs = 4000000000u; // 4 x 128 x 4^11 are 2.1e9, which take some 5 TB
  EXPECT_NE(too_large_text(cell, options).find("of memory are free"), std::string::npos);
  options.max_dofs = 400000;
  EXPECT_NE(too_large_text(cell, options).find("more than 400000, which is about"),
            std::string::npos);
}

TEST(tripwire_bracket_checks, a_soft_direction_counts_as_much_as_a_stiff_one)
{
  CellBracket cell_bracket;
  homogenization::Bracket bracket;
  bracket.upper = Eigen::Vector3d(1e6, 1., 1.).asDiagonal();
  bracket.lower = bracket.stiffness = bracket.upper;
  cell_bracket.bracket              = bracket;
  cell_bracket.on_given_mesh        = bracket.upper;
  Eigen::Matrix3d off               = bracket.upper;
  off(1, 1) *= 1. + 1e-4; // 1e-10 of the largest entry
  EXPECT_EQ(outcome_of(checks_of(cell_bracket, {}, off, 0.), "Both codes agree"), Outcome::fail);
}

TEST(bound_assessed_cell, the_bar_of_a_cell_without_a_bracket_holds_its_stiffness)
{
  const UnitCell cell = inclusion();
  homogenization::HomogenizationOptions finest;
  finest.refine               = 3;
  const Eigen::Matrix3d limit = homogenization::homogenize(cell, finest, MPI_COMM_SELF).stiffness;
  for (const unsigned int order : {1u, 2u})
  {
    homogenization::HomogenizationOptions options;
    options.order         = order;
    AssessedCell assessed = assess(cell, options, MPI_COMM_SELF);
    add_estimate(cell, 1000000, MPI_COMM_SELF, assessed);
    ASSERT_TRUE(assessed.uncertainty.has_value());
    const Eigen::Matrix3d distance = (assessed.result.stiffness - limit).cwiseAbs();
    for (int a = 0; a < 3; ++a)
    {
      EXPECT_LT(distance(a, a), (*assessed.uncertainty)(a, a)) << a << a << ", P" << order;
      EXPECT_GT(distance(a, a), 0.2 * (*assessed.uncertainty)(a, a)) << a << a << ", P" << order;
    }
  }
}

TEST(exact_cell_checks, every_check_says_where_its_limit_comes_from)
{
  const UnitCell cell   = inclusion();
  AssessedCell assessed = assess(cell, {}, MPI_COMM_SELF);
  BracketOptions options;
  options.tolerance = 1e-3;
  add_bracket(
    cell, options, [](const std::string &) {}, assessed);
  EXPECT_EQ(assessed.checks.size(), 13u);
  for (const Verdict &check : assessed.checks)
  {
    EXPECT_FALSE(check.derivation.empty()) << check.claim;
    EXPECT_EQ(check.kind, check.claim.find("--tolerance") != std::string::npos ||
                              check.claim.find("no displacements") != std::string::npos
                            ? Kind::input
                            : Kind::program)
      << check.claim;
  }
}

TEST(bound_cell_checks, stripes_attain_their_bounds_to_less_than_nine_digits)
{
  // Nine digits were the limit for any cell; that of round-off is tighter where the contrast is
  // moderate.
  const UnitCell cell = stripe_cell(4, homogenization::isotropic("soft", 1e6, 0.3, 1e-3, 100.),
                                    homogenization::isotropic("hard", 1e8, 0.3, 1e-3, 100.));
  const AssessedCell assessed = assess(cell, {}, MPI_COMM_SELF);
  for (const Verdict &check : assessed.checks)
  {
    EXPECT_EQ(check.outcome, Outcome::pass) << check.claim << " " << check.value;
    if (check.claim.find("bound") != std::string::npos)
    {
      EXPECT_LT(std::stod(check.limit.substr(3)), 1e-9) << check.limit;
    }
  }
}

TEST(bound_cell_checks, a_limit_that_lets_faults_pass_fails_unless_the_contrast_asks_for_it)
{
  const auto check_of = [](const double stiff)
  {
    const UnitCell cell = stripe_cell(4, homogenization::isotropic("soft", 1e6, 0.3, 1e-3, 100.),
                                      homogenization::isotropic("hard", stiff, 0.3, 1e-3, 100.));
    for (const Verdict &check : assess(cell, {}, MPI_COMM_SELF).checks)
      if (check.claim.find("fault of a millionth") != std::string::npos)
        return check;
    return Verdict();
  };
  EXPECT_EQ(check_of(1e8).outcome, Outcome::pass);
  EXPECT_LT(check_of(1e8).value, 1e-9);
  EXPECT_NE(check_of(1e17).outcome, Outcome::fail); // round-off of a contrast of 1e11
}

TEST(bound_bracket_output, an_adaptive_bracket_replaces_checks_and_chi_together)
{
  const UnitCell cell   = inclusion();
  AssessedCell assessed = assess(cell, {}, MPI_COMM_SELF);
  const auto coarse     = assessed.result;
  BracketOptions options;
  options.tolerance = 1e-3;
  add_bracket(
    cell, options, [](const std::string &) {}, assessed);
  ASSERT_TRUE(assessed.bracket->bracket.has_value());
  EXPECT_FALSE(any_failed(assessed.checks));
  EXPECT_EQ(outcome_of(assessed.checks, "anchor"), Outcome::pass);
  EXPECT_EQ(outcome_of(assessed.checks, "admissible"), Outcome::pass);
  EXPECT_EQ(outcome_of(assessed.checks, "no displacements"), Outcome::pass);
  EXPECT_EQ(assessed.result.seconds.solve, assessed.bracket->history.back().seconds);
  EXPECT_EQ(assessed.result.seconds.assembly, 0.);
  // Hill-Mandel is that of the new pair of forms.
  double gap = 0., size = 0.;
  for (int k = 0; k < 9; ++k)
  {
    gap =
      larger(gap, std::abs(assessed.result.stiffness(k) - assessed.result.stiffness_by_flux(k)));
    size = larger(size, std::abs(assessed.result.stiffness(k)));
  }
  EXPECT_EQ(assessed.checks[0].value, gap / size);
  EXPECT_GT(energy_difference(coarse.stiffness, assessed.result.stiffness), 1e-4);
  // And strains of triangles are those of the new chi, which leaves their mean alone.
  const Eigen::VectorXd areas   = meshes::signed_areas(cell.mesh);
  const Eigen::RowVectorXd mean = areas.transpose() * assessed.result.strains / areas.sum();
  EXPECT_LT((mean.reshaped(3, 3) - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_GT((assessed.result.strains - coarse.strains).norm(), 0.01);
  EXPECT_FALSE(edges_beside(cell, assessed).edges.has_value());
}

TEST(bound_bracket_output, printed_stiffness_and_moduli_hold_those_of_a_far_narrower_bracket)
{
  const UnitCell cell    = inclusion();
  AssessedCell assessed  = assess(cell, {}, MPI_COMM_SELF);
  const std::string bare = summary(cell, assessed);
  EXPECT_NE(bare.find("three digits: no error bar"), std::string::npos);
  add_bracket(
    cell, {}, [](const std::string &) {}, assessed);
  AssessedCell narrow = assessed;
  BracketOptions options;
  options.tolerance = 1e-5;
  add_bracket(
    cell, options, [](const std::string &) {}, narrow);
  const auto exact       = homogenization::engineering_constants(narrow.result.stiffness);
  const std::string text = summary(cell, assessed);
  const auto holds       = [&](const std::string &name, const double value)
  {
    const std::size_t at = text.find(name + " ");
    ASSERT_NE(at, std::string::npos) << text;
    const std::string from = text.substr(at + name.size() + 1);
    const double printed = std::stod(from), bar = std::stod(from.substr(from.find("+-") + 2));
    EXPECT_LE(std::abs(printed - value), bar * 1.001) << name << " " << value << "\n" << text;
    EXPECT_LT(bar, 0.2 * std::abs(value)) << name;
  };
  holds("E1", exact.E1);
  holds("E2", exact.E2);
  holds("G12", exact.G12);
  holds("nu12", exact.nu12);
  holds("nu21", exact.nu21);
}
