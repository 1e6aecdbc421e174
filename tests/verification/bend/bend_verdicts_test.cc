// SPDX-License-Identifier: MIT
// Claims about bent sheets are decided by the bars of both errors, and open where one is missing.
#include "verification/bend/bend_verdicts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

using namespace homespun::verification;

namespace
{
/// A method with errors in k eps² and k eps, each with a tenth of itself as its bar.
BendRow row_of(const std::string &method, const double position, const double normal)
{
  BendRow row;
  row.cell       = "made";
  row.load       = "roll";
  row.reference  = "linear";
  row.method     = method;
  row.bending    = 0.1;
  row.side       = 0.01;
  row.curvature  = 8.; // at large turns it is not that of the load
  row.mean       = position * 10. * 1e-4;
  row.bar        = 0.1 * row.mean;
  row.normal     = normal * 10. * 1e-2;
  row.normal_bar = 0.1 * row.normal;
  return row;
}

std::map<std::string, Verdict> judged_rows(const std::vector<BendRow> &rows)
{
  std::map<std::string, Verdict> verdicts;
  for (const Verdict &one : verdicts_on_bending(row_of("", 0., 0.), rows))
    verdicts[one.id.substr(12) + (one.claim.find("position") != std::string::npos ? " p" : " n")] =
      one;
  return verdicts;
}
} // namespace

TEST(exact_bend_verdicts, are_decided_by_both_bars_against_the_better_base)
{
  const auto found = judged_rows({row_of("affine", 1., 1.), row_of("localized", 1.15, 0.5),
                                  row_of("affine+edges", 0.5, 2.), row_of("full", 0.45, 0.2),
                                  row_of("flat", 3., 3.)});
  EXPECT_EQ(found.size(), 6u);
  EXPECT_EQ(found.at("base p").outcome, Outcome::inconclusive);
  EXPECT_DOUBLE_EQ(found.at("base p").value, 0.9);
  EXPECT_NE(found.at("base p").limit.find("base: affine+edges"), std::string::npos);
  EXPECT_EQ(found.at("base n").outcome, Outcome::pass);
  EXPECT_DOUBLE_EQ(found.at("base n").value, 0.2);
  EXPECT_EQ(found.at("affine p").outcome, Outcome::pass);
  EXPECT_EQ(found.at("localized p").outcome, Outcome::inconclusive);
  EXPECT_EQ(found.at("localized n").outcome, Outcome::pass);
  const auto worse = judged_rows({row_of("affine", 1., 1.), row_of("localized", 1.3, 1.3)});
  EXPECT_EQ(worse.at("localized p").outcome, Outcome::fail);
  EXPECT_EQ(worse.at("base p").outcome, Outcome::inconclusive);
  EXPECT_NE(worse.at("base p").limit.find("no terms of edges"), std::string::npos);
}

TEST(exact_bend_verdicts, a_sheet_that_wrinkles_later_than_a_wave_without_fluctuation_fails)
{
  WrinkleRow row;
  row.cell             = "made";
  row.cells_per_wave   = 4;
  row.most_compression = 2.;
  EXPECT_EQ(verdict_on_wrinkles(row).outcome, Outcome::inconclusive);
  row.compression     = 2.1;
  row.compression_bar = 0.2;
  EXPECT_EQ(verdict_on_wrinkles(row).outcome, Outcome::pass);
  row.compression_bar = 0.05;
  EXPECT_EQ(verdict_on_wrinkles(row).outcome, Outcome::fail);
  std::vector<OwedClaim> owed;
  add_owed_of_wrinkles("made", {4, 6}, owed);
  EXPECT_EQ(missing_claims(owed, {verdict_on_wrinkles(row)}).size(), 3u);
}

TEST(tripwire_bend_verdicts, without_a_bar_an_equilibrium_or_an_error_nothing_is_claimed)
{
  BendRow full = row_of("full", 0.1, 0.1);
  full.bar     = BendRow::none;
  const auto no_bar =
    judged_rows({row_of("affine", 1., 1.), row_of("affine+edges", 0.5, 0.5), full});
  EXPECT_EQ(no_bar.at("affine p").outcome, Outcome::inconclusive);
  EXPECT_NE(no_bar.at("affine p").limit.find("an error bar is not known"), std::string::npos);
  EXPECT_EQ(no_bar.at("affine n").outcome, Outcome::pass);
  for (const auto &[name, one] : judged_rows({}))
  {
    EXPECT_EQ(one.outcome, Outcome::inconclusive) << name;
    EXPECT_NE(one.limit.find("no equilibrium"), std::string::npos) << name;
  }
  const auto nothing = judged_rows({row_of("affine", 1e-9, 1e-9), row_of("localized", 0., 0.)});
  EXPECT_EQ(nothing.at("localized p").outcome, Outcome::inconclusive);
  // A placebo to which a method adds something.
  const auto placebo = judged_rows({row_of("affine", 1e-9, 0.), row_of("localized", 0.5, 0.5)});
  EXPECT_EQ(placebo.at("localized p").outcome, Outcome::fail);
  EXPECT_EQ(placebo.at("localized n").outcome, Outcome::fail);
  // A load that was left out altogether: its claims are owed.
  std::vector<OwedClaim> owed;
  add_owed_of_bending("made", "roll", "linear", owed);
  EXPECT_EQ(missing_claims(owed, {}).size(), 6u);
  EXPECT_TRUE(missing_claims(owed, verdicts_on_bending(row_of("", 0., 0.), {})).empty());
}
