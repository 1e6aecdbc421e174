// SPDX-License-Identifier: MIT
#include "verification/drape/coarse_run.h"
#include "verification/drape/drape_verdicts.h"

#include <gtest/gtest.h>

#include <limits>

using namespace homespun;
using namespace homespun::verification;

namespace
{
/// Two frames after the beginning, of both methods.
std::vector<DrapeRow> rows_of(const double affine, const double localized, const double bar,
                              const double displacement = 1.)
{
  std::vector<DrapeRow> rows;
  for (const auto &[method, error] : {std::pair{"affine", affine}, {"localized", localized}})
    for (const int frame : {0, 1, 2})
    {
      DrapeRow row;
      row.cell         = "cell";
      row.variant      = "corotational";
      row.reference    = "biot";
      row.method       = method;
      row.frame        = frame;
      row.mean         = frame == 0 ? 0. : error;
      row.uncertainty  = frame == 0 ? std::numeric_limits<double>::quiet_NaN() : 0.75 * bar;
      row.time_step    = frame == 0 ? std::numeric_limits<double>::quiet_NaN() : 0.25 * bar;
      row.displacement = frame == 0 ? 0. : displacement;
      rows.push_back(row);
    }
  return rows;
}

std::vector<Outcome> outcomes_of(const std::vector<DrapeRow> &rows, const double side)
{
  std::vector<Outcome> outcomes;
  for (const Verdict &verdict : verdicts_of_accuracy(rows, {"cell", "corotational", "biot"}, side))
    outcomes.push_back(verdict.outcome);
  return outcomes;
}

constexpr Outcome pass = Outcome::pass, fail = Outcome::fail, open = Outcome::inconclusive;
} // namespace

TEST(exact_drape_verdicts,
     a_reference_that_stops_leaves_its_claim_open_and_one_without_a_frame_fails)
{
  EXPECT_EQ(verdict_of_reference("", "", 5, 5).outcome, Outcome::pass);
  for (const int n : {2, 3, 4})
    EXPECT_EQ(status_of({verdict_of_reference("", "", n, 5)}), exit_status::claim_open);
  for (const int n : {0, 1}) // the beginning is no answer
    EXPECT_EQ(status_of({verdict_of_reference("", "", n, 5)}), exit_status::claim_failed);
  EXPECT_EQ(verdict_of_reference("", "", 1, 5).kind, Kind::program);
}

TEST(exact_drape_verdicts, the_method_fails_where_it_stops_and_a_variant_is_open)
{
  EXPECT_EQ(
    status_of({verdict_of_cloth("", "", true, 5, 5), verdict_of_cloth("", "", false, 5, 5)}),
    exit_status::good);
  EXPECT_EQ(status_of({verdict_of_cloth("", "", true, 4, 5)}), exit_status::claim_failed);
  EXPECT_EQ(status_of({verdict_of_cloth("", "", false, 4, 5)}), exit_status::claim_open);
  EXPECT_EQ(verdict_of_cloth("", "", false, 4, 5).kind, Kind::method);
}

TEST(exact_drape_verdicts, accuracy_is_judged_with_the_bar)
{
  using All = std::vector<Outcome>;
  // Closer than affine by more than both bars; 0.02 of the displacement; 0.02 of a cell.
  EXPECT_EQ(outcomes_of(rows_of(0.04, 0.02, 0.009), 1.), (All{pass, pass, pass}));
  EXPECT_EQ(outcomes_of(rows_of(0.04, 0.02, 0.011), 1.), (All{open, pass, pass}));
  EXPECT_EQ(outcomes_of(rows_of(0.01, 0.02, 0.004), 1.), (All{fail, pass, pass}));
  EXPECT_EQ(outcomes_of(rows_of(0.01, 0.02, 0.006), 1.), (All{open, pass, pass}));
  // A small part of a cell, and a quarter of the way.
  EXPECT_EQ(outcomes_of(rows_of(0.04, 0.02, 0.009, 0.08), 1.), (All{pass, fail, pass}));
  EXPECT_EQ(outcomes_of(rows_of(0.04, 0.02, 0.009), 0.05), (All{pass, pass, fail}));
  EXPECT_EQ(outcomes_of(rows_of(0.04, 0.02, 0.009), 0.25), (All{pass, pass, open}));
}

TEST(exact_drape_verdicts, a_method_that_has_few_frames_is_held_against_the_same_ones)
{
  const auto claim = [](const std::vector<DrapeRow> &rows, const std::string &other) {
    return verdict_of_closer(rows, {"cell", "corotational", "biot"}, "mine", other);
  };
  std::vector<DrapeRow> rows = rows_of(0.04, 0.02, 0.004);
  rows[1].mean               = 10.; // affine, in a frame that is not given
  rows.push_back(rows[2]);
  rows.back().method = "mine";
  rows.back().mean   = 0.03;
  EXPECT_EQ(claim(rows, "affine").outcome, pass);
  EXPECT_NEAR(claim(rows, "affine").value, 0.03 / 0.04, 1e-12);
  EXPECT_EQ(claim(rows, "localized").outcome, fail);
  EXPECT_EQ(claim(rows, "localized").kind, Kind::method);
  EXPECT_NE(claim(rows, "full").limit.find("not among the methods"), std::string::npos);
  rows.back().uncertainty = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(claim(rows, "affine").outcome, open);
  EXPECT_NE(claim(rows, "affine").limit.find("of some frame"), std::string::npos);
  for (DrapeRow &row : rows)
    row.uncertainty = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(claim(rows, "affine").outcome, open);
  EXPECT_NE(claim(rows, "affine").limit.find("the reference has no error bar"), std::string::npos);
}

TEST(tripwire_drape_verdicts, a_frame_without_a_bar_or_a_number_leaves_accuracy_open)
{
  std::vector<DrapeRow> rows = rows_of(0.04, 0.02, 0.01);
  rows[5].time_step          = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(outcomes_of(rows, 1.), (std::vector<Outcome>{open, open, open}));
  rows         = rows_of(0.04, 0.02, 0.01);
  rows[5].mean = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(outcomes_of(rows, 1.), (std::vector<Outcome>{open, open, open}));
  rows = rows_of(0.04, 0.02, 0.01, 0.); // nothing has moved
  EXPECT_EQ(outcomes_of(rows, 1.)[1], open);
}

TEST(exact_drape_verdicts, other_variants_references_and_the_beginning_are_not_judged)
{
  std::vector<DrapeRow> rows = rows_of(0.04, 0.02, 0.01);
  EXPECT_TRUE(verdicts_of_accuracy(rows, {"cell", "corotational", "green"}, 1.).empty());
  for (DrapeRow &row : rows)
    row.variant = "nodal-warping";
  EXPECT_TRUE(verdicts_of_accuracy(rows, {"cell", "corotational", "biot"}, 1.).empty());
  rows = rows_of(0.04, 0.02, 0.01);
  rows.resize(1);
  EXPECT_TRUE(verdicts_of_accuracy(rows, {"cell", "corotational", "biot"}, 1.).empty());
}

TEST(exact_run_of_waves, the_shortest_waves_of_a_run_are_said_and_none_where_all_are_long)
{
  RunOfWaves waves;
  waves.add(0, std::numeric_limits<double>::infinity(), 0.01);
  EXPECT_EQ(sentence_of(waves, 1), "");
  waves.add(1, 5.5, 0.01);
  waves.add(2, 2.5, 0.01);
  waves.add(3, 6.5, 0.01);
  const std::string said = sentence_of(waves, 4);
  EXPECT_NE(said.find("shorter than 8 of its sides in 3 of 4 frames"), std::string::npos) << said;
  EXPECT_NE(said.find("some 2.5 sides (2.5 cm) in frame 2"), std::string::npos) << said;
}

TEST(exact_drape_verdicts, a_run_without_localized_is_judged_by_its_last_method)
{
  std::vector<DrapeRow> rows = rows_of(1., 0.1, 0.01);
  for (DrapeRow &row : rows)
    if (row.method == "localized")
      row.method = row.variant = "full"; // a cloth of its own
  EXPECT_EQ(judged_method(rows, "cell"), "full");
  EXPECT_EQ(outcomes_of(rows, 2.).size(), 3u);
  rows.erase(rows.begin() + 3, rows.end()); // affine alone
  EXPECT_EQ(judged_method(rows, "cell"), "affine");
  EXPECT_EQ(outcomes_of(rows, 2.).size(), 2u);
}
