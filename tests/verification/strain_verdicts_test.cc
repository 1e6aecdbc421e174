// SPDX-License-Identifier: MIT
// The judge, on synthetic rows: it must pass what is right and fail what is planted.
#include "verification/result_files.h"
#include "verification/strain_verdicts.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun::verification;

namespace
{
using Rows = std::vector<std::vector<std::string>>;

std::vector<std::string> row(const std::string &load, const double strain,
                             const std::string &method, const double error_m,
                             const double uncertainty_m = 1e-12)
{
  return {"cell",
          load,
          csv_number(strain),
          "biot",
          method,
          "20",
          "800",
          "288000",
          csv_number(error_m),
          "",
          "",
          csv_number(error_m / 0.01),
          "",
          csv_number(uncertainty_m),
          "",
          ""};
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
    EXPECT_NEAR(strain_verdicts(periodic(order))[0].value, order, 1e-5);
}

TEST(tripwire_verdicts, the_second_order_passes_and_the_first_fails)
{
  EXPECT_EQ(strain_verdicts(periodic(2.))[0].outcome, Outcome::pass);
  EXPECT_EQ(strain_verdicts(periodic(1.))[0].outcome, Outcome::fail); // a lost or turned chi
  EXPECT_EQ(strain_verdicts(periodic(1.8))[0].outcome, Outcome::fail);
  // The shear of a cell with mirrors has no quadratic term.
  EXPECT_EQ(strain_verdicts(periodic(3.))[0].outcome, Outcome::pass);
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
  EXPECT_EQ(strain_verdicts(rows_of({1e-4, 1e-3, 1e-2, 0.1}, 0.))[0].outcome,
            Outcome::inconclusive);
  const std::vector<double> smaller = {1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1};
  EXPECT_EQ(strain_verdicts(rows_of(smaller, 0.))[0].outcome, Outcome::pass);
  EXPECT_EQ(strain_verdicts(rows_of(smaller, 1e-3))[0].outcome, Outcome::fail);
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
    EXPECT_EQ(strain_verdicts(rows)[0].outcome, Outcome::fail) << first_order;
  }
}

TEST(tripwire_verdicts, an_order_that_overshoots_two_is_open_until_smaller_strains_settle_it)
{
  // satin pulled along its yarns, measured: quadratic below 1e-4, straightening at 1e-3, another equilibrium at 1 %.
  const std::vector<std::pair<double, double>> measured = {
    {1e-6, 9.24e-13}, {1e-5, 9.22e-11}, {1e-4, 8.91e-9}, {1e-3, 6.73e-7}, {1e-2, 1.31e-3}};
  const auto outcome = [&](const std::size_t first)
  {
    Rows rows;
    for (std::size_t k = first; k < measured.size(); ++k)
      rows.push_back(row("periodic-11", measured[k].first, "localized", 0.01 * measured[k].second));
    return strain_verdicts(rows)[0].outcome;
  };
  EXPECT_EQ(outcome(2), Outcome::inconclusive);
  EXPECT_EQ(outcome(0), Outcome::pass);
}

TEST(tripwire_verdicts, an_error_that_is_not_a_number_fails)
{
  for (const std::string &text : {std::string(), std::string("1.5x")})
  {
    Rows rows   = periodic(2.);
    rows[2][11] = text;
    EXPECT_EQ(strain_verdicts(rows)[0].outcome, Outcome::fail) << text;
  }
}

TEST(tripwire_verdicts, two_levels_decide_nothing)
{
  Rows rows = periodic(2.);
  rows.pop_back();
  EXPECT_EQ(strain_verdicts(rows)[0].outcome, Outcome::inconclusive);
}

TEST(tripwire_verdicts, no_level_in_the_window_decides_nothing_and_does_not_crash)
{
  const Rows rows = {row("periodic-12", 0.2, "localized", 1e-5)};
  EXPECT_EQ(strain_verdicts(rows)[0].outcome, Outcome::inconclusive);
}

TEST(tripwire_verdicts, a_small_true_error_at_small_strain_is_not_taken_for_round_off)
{
  Rows rows;
  for (const double strain : {1e-4, 2e-4, 4e-4})
    rows.push_back(row("periodic-12", strain, "localized", 0.01 * 1e-3 * strain * strain));
  EXPECT_EQ(strain_verdicts(rows)[0].claim.find("round-off"), std::string::npos);
  EXPECT_EQ(strain_verdicts(rows)[0].outcome, Outcome::pass);
}

TEST(tripwire_verdicts, without_an_error_bar_a_gain_is_inconclusive)
{
  Rows rows = sheet(2e-5, 1e-5, 1e-7);
  rows[1][13].clear();
  EXPECT_EQ(strain_verdicts(rows)[0].outcome, Outcome::inconclusive);
}

TEST(exact_verdicts, round_off_is_recognised_as_zero)
{
  Rows rows;
  for (const double strain : {1e-3, 1e-2, 1e-1})
    rows.push_back(row("periodic-11", strain, "localized", 1e-17));
  EXPECT_EQ(strain_verdicts(rows)[0].outcome, Outcome::pass);
  EXPECT_NE(strain_verdicts(rows)[0].claim.find("round-off"), std::string::npos);
}

TEST(tripwire_verdicts, a_gain_within_the_error_bar_is_no_gain)
{
  EXPECT_EQ(strain_verdicts(sheet(2e-5, 1e-5, 1e-7))[0].outcome, Outcome::pass);
  EXPECT_EQ(strain_verdicts(sheet(1e-5, 2e-5, 1e-7))[0].outcome, Outcome::fail);
  EXPECT_EQ(strain_verdicts(sheet(2e-5, 1.95e-5, 1e-6))[0].outcome, Outcome::inconclusive);
}

TEST(exact_verdicts, levels_that_were_not_reached_are_not_judged)
{
  Rows rows = periodic(2.);
  rows.push_back({"cell", "periodic-12", "0.05", "biot", "unreached", "20", "800", "288000", "", "",
                  "", "", "", "", "", ""});
  EXPECT_EQ(strain_verdicts(rows).size(), 1u);
  EXPECT_EQ(strain_verdicts(rows)[0].outcome, Outcome::pass);
}
