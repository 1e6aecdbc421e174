// SPDX-License-Identifier: MIT
#include "verification/strain/validity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace homespun::verification;

namespace
{
/// Of `localized`, far within every limit.
StrainRow small_error(const char *const load, const double strain)
{
  StrainRow row       = {"cell", load, strain, "biot", "localized", 4, 32, 100};
  row.mean            = 1e-6 * strain;
  row.per_cell        = 1e-4 * strain;
  row.per_fluctuation = 1e-3 * strain;
  row.bar             = 1e-8 * strain;
  return row;
}
} // namespace

TEST(exact_validity, the_limit_of_a_power_law_is_found)
{
  std::vector<double> x, y;
  for (const double strain : {0.001, 0.003, 0.02, 0.1})
  {
    x.push_back(strain);
    y.push_back(7. * strain * strain);
  }
  const Crossing found = crossing(x, y, 7. * 0.04 * 0.04);
  EXPECT_EQ(found.relation, '=');
  EXPECT_NEAR(found.strain, 0.04, 1e-12);
  EXPECT_EQ(crossing(x, y, 1.).relation, '>');
  EXPECT_EQ(crossing(x, y, 1.).strain, 0.1);
  EXPECT_EQ(crossing(x, y, 1e-9).relation, '-');
}

TEST(exact_validity, a_curve_that_comes_back_counts_up_to_its_first_crossing)
{
  EXPECT_LT(crossing({0.01, 0.02, 0.04}, {1., 3., 1.}, 2.).strain, 0.02);
}

TEST(exact_validity, rows_carry_the_error_bar_and_the_reason)
{
  std::vector<StrainRow> rows;
  for (const double strain : {0.001, 0.005, 0.01, 0.1})
  {
    StrainRow row       = {"cell", "strip-2", strain, "biot", "localized", 20, 800, 288000};
    row.mean            = 1e-2 * row.strain;
    row.per_cell        = row.strain;     // 1 % at strain 0.01
    row.per_fluctuation = 0.5;            // never within 10 %
    row.bar             = 0.1 * row.mean; // a tenth of the error
    rows.push_back(row);
  }
  const std::vector<ValidityRow> found = validity_rows(rows);
  ASSERT_EQ(found.size(), 5u);
  for (int k = 0; k < 3; ++k)
  {
    const ValidityRow &row = found[static_cast<std::size_t>(k)];
    EXPECT_EQ(row.relation, "-");
    EXPECT_TRUE(std::isnan(row.largest));
    EXPECT_NE(row.note.find("already 50 %"), std::string::npos);
  }
  EXPECT_EQ(found[3].relation, "=");
  EXPECT_NEAR(found[3].largest, 0.01, 1e-12);
  EXPECT_NEAR(found[3].lower, 0.01 / 1.1, 1e-12);
  EXPECT_NEAR(found[3].upper, 0.01 / 0.9, 1e-12);
  std::vector<StrainRow> both = rows; // and of the method that the study speaks of
  for (StrainRow row : rows)
  {
    row.method   = "full";
    row.per_cell = 0.1 * row.per_cell;
    both.push_back(row);
    row.method = "localized+edges";
    both.push_back(row);
  }
  const std::vector<ValidityRow> of_both = validity_rows(both);
  ASSERT_EQ(of_both.size(), 10u);
  EXPECT_TRUE(std::isnan(of_both[3].least_radius));
  for (const ValidityRow &row : validity_rows(both, {}, {{"cell", 0.023}, {"other", 0.07}}))
    EXPECT_EQ(row.least_radius, 0.023);
  EXPECT_EQ(of_both[3].method, "localized");
  EXPECT_NEAR(of_both[3].largest, 0.01, 1e-12);
  EXPECT_EQ(of_both[8].method, "full");
  EXPECT_GT(of_both[8].largest, 0.09);
  rows.push_back({"cell", "strip-2", 0.05, "biot", unreached});
  EXPECT_EQ(validity_rows(rows)[4].relation, ">"); // the ladder ends at 0.01
  EXPECT_NE(validity_rows(rows)[4].note.find("no equilibrium"), std::string::npos);
}

TEST(exact_validity, what_was_not_reached_or_is_not_known_is_no_range)
{
  std::vector<StrainRow> rows;
  for (const double strain : {0.001, 0.002, 0.004, 0.008})
  {
    StrainRow row       = {"cell", "strip-2", strain, "biot", "localized", 20, 800, 288000};
    row.mean            = 1e-2 * row.strain;
    row.per_cell        = row.strain;
    row.per_fluctuation = 0.01;
    row.bar             = 0.1 * row.mean;
    rows.push_back(row);
  }
  rows[2].mean = rows[2].per_cell = rows[2].per_fluctuation = StrainRow::none;
  const auto of_cell = [&](const auto &...levels) { return validity_rows(rows, levels...)[3]; };
  EXPECT_EQ(of_cell().limit, 0.01);
  EXPECT_EQ(of_cell().largest, 0.002) << "the method found no equilibrium at 0.004";
  EXPECT_NE(of_cell().note.find("no equilibrium"), std::string::npos);
  // A bar wider than the limit, and a law that is lost.
  rows[2] = rows[1];
  for (StrainRow &row : rows)
    row.bar = 20. * rows.back().mean;
  LevelRow rest = {"cell", "strip-2", "biot", 0.001}, lost = {"cell", "strip-2", "biot", 0.004};
  rest.lost = 0, rest.least = 0.5;
  lost.lost = 1, lost.least = -0.5;
  const ValidityRow row = of_cell(std::vector<LevelRow>{rest, lost});
  EXPECT_LT(row.largest, 0.004);
  EXPECT_TRUE(std::isnan(row.lower)) << row.lower;
}

TEST(exact_validity, a_load_without_any_level_has_rows_that_say_so)
{
  const std::vector<ValidityRow> found = validity_rows(
    {small_error("periodic-12", 0.6), {"cell", "shear-frame", 0.6, "biot", unreached}});
  ASSERT_EQ(found.size(), 10u);
  for (const ValidityRow &one : found)
  {
    EXPECT_EQ(one.relation, one.load == "shear-frame" ? "?" : ">");
    if (one.load == "shear-frame")
    {
      EXPECT_EQ(one.method, "localized");
      EXPECT_NE(
        one.note.find("no equilibrium of reference or coarse cloth was found at strain 0.6"),
        std::string::npos);
    }
  }
}

TEST(exact_validity, a_law_that_is_lost_before_the_smallest_strain_leaves_no_range)
{
  LevelRow lost = {"cell", "strip-1", "biot", 0.05};
  lost.lost = 3, lost.least = -1.;
  const ValidityRow found = validity_rows({small_error("strip-1", 0.05)}, {lost})[3];
  EXPECT_EQ(found.relation, "?");
  EXPECT_TRUE(std::isnan(found.largest));
  EXPECT_NE(found.note.find("loses ellipticity at 2.5 %"), std::string::npos) << found.note;
}

TEST(exact_validity, an_error_too_large_at_the_smallest_strain_reaches_no_further_than_the_law)
{
  std::vector<StrainRow> rows;
  for (const double strain : {0.01, 0.05})
  {
    rows.push_back(small_error("strip-1", strain)); // by its bar it may be small
    rows.back().mean = rows.back().per_cell = rows.back().per_fluctuation = 2.;
    rows.back().bar                                                       = 2. - 1e-6;
  }
  LevelRow rest = {"cell", "strip-1", "biot", 0.01}, lost = {"cell", "strip-1", "biot", 0.03};
  rest.lost = 0, rest.least = 1.;
  lost.lost = 1, lost.least = -1.;
  const double loss = 0.02;
  for (const ValidityRow &row : validity_rows(rows, {rest, lost}))
  {
    EXPECT_EQ(row.relation, "-");
    EXPECT_NEAR(row.upper, loss, 1e-12);
  }
}

TEST(exact_validity, the_range_of_a_base_ends_where_no_base_has_an_equilibrium)
{
  std::vector<StrainRow> rows;
  for (const double strain : {0.001, 0.01, 0.1})
    for (const char *const method : {"affine", "localized", "full-micro", "full"})
    {
      StrainRow row = small_error("strip-1", strain);
      row.method    = method;
      if (strain == 0.01 && std::string(method) == "full-micro")
        row.mean = row.per_cell = row.per_fluctuation = row.bar = StrainRow::none;
      rows.push_back(row);
    }
  for (const ValidityRow &row : validity_rows(rows))
    if (row.method == base_method)
      EXPECT_EQ(row.largest, 0.001) << row.measure;
}
