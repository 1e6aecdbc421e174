// SPDX-License-Identifier: MIT
// The claims on tables, on rows by hand: what must hold passes, and each planted fault fails.
#include "verification/strain/claims/table_verdicts.h"

#include "tests/homogenization/cell/cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

using namespace homespun;
using namespace homespun::verification;

namespace
{
constexpr double none = std::numeric_limits<double>::quiet_NaN();

StrainRow row_of(const double mean, const double rms, const double max)
{
  StrainRow row = {"cell", "strip-1", 0.01, "biot", "localized", 20, 800, 288000};
  row.mean = mean, row.rms = rms, row.max = max;
  return row;
}

UncertaintyRow ladder_of(const double p1, const double p2, const double refined)
{
  UncertaintyRow row      = {"cell", "strip-1", "linear", 0.01, 4};
  row.force_p1_to_p2      = (p1 - p2) / p1;
  row.force_p1_to_refined = (p1 - refined) / p1;
  row.force_p2_to_refined = (p2 - refined) / p1;
  return row;
}

/// A folder that goes with the test.
struct Folder
{
  Folder()
      : path(std::filesystem::temp_directory_path() /
             ("table-verdicts-" + std::to_string(::getpid())))
  {
    std::filesystem::create_directories(path);
  }
  ~Folder()
  {
    std::filesystem::remove_all(path);
  }
  const std::filesystem::path path;
};
} // namespace

TEST(bound_table_verdicts, no_coarse_cloth_that_may_be_the_base_is_closer_than_the_base)
{
  std::vector<StrainRow> rows;
  for (const auto &[method, error] :
       {std::pair("affine", 1.), std::pair("affine+p2", 3.), std::pair("full-micro", 4.),
        std::pair("localized", 0.5), std::pair("full", 0.1)})
  {
    rows.push_back({"cell", "strip-1", 0.01, "biot", method});
    rows.back().mean = error;
  }
  std::vector<GainRow> gains = {{"cell", "strip-1", 0.01, "biot", "localized", "affine"},
                                {"cell", "strip-1", 0.01, "biot", "full", "affine+p2"}};
  EXPECT_EQ(verdict_of_bases(gains, rows).outcome, Outcome::pass); // affine is no base of `full`
  gains[1].base = "full-micro";
  EXPECT_EQ(verdict_of_bases(gains, rows).outcome, Outcome::fail);
  gains[1].base = "nobody";
  EXPECT_EQ(verdict_of_bases(gains, rows).value, 1.);
}

TEST(bound_table_verdicts, norms_stand_in_their_order)
{
  // Distances 1, 2, 3.
  const StrainRow sound = row_of(2., std::sqrt(14. / 3.), 3.), unreached = row_of(none, none, none);
  EXPECT_EQ(verdict_of_norms({sound, unreached, row_of(1., 1., 1.)}).outcome, Outcome::pass);
  // A mean square told as its root, in metres: squares of small numbers are smaller.
  const Verdict squared = verdict_of_norms({sound, row_of(2e-3, 14e-6 / 3., 3e-3)});
  EXPECT_EQ(squared.outcome, Outcome::fail);
  EXPECT_EQ(squared.value, 1.);
  EXPECT_EQ(verdict_of_norms({row_of(2., 4., 3.)}).outcome, Outcome::fail);
  EXPECT_EQ(verdict_of_norms({row_of(2., none, 3.)}).outcome, Outcome::fail);
  EXPECT_EQ(verdict_of_norms({}).outcome, Outcome::inconclusive);
}

TEST(bound_table_verdicts, forces_of_nested_spaces_fall)
{
  const auto verdict = [](const UncertaintyRow &row)
  {
    const std::vector<Verdict> all = verdicts_of_nested_forces({row});
    EXPECT_EQ(all.size(), 1u);
    return all.at(0);
  };
  EXPECT_EQ(verdict(ladder_of(10., 9., 8.9)).outcome, Outcome::pass);
  EXPECT_NEAR(verdict(ladder_of(10., 9., 8.9)).value, 0.01, 1e-12);
  EXPECT_EQ(verdict(ladder_of(10., 9., 9.)).outcome, Outcome::fail);  // P2 was not refined
  EXPECT_EQ(verdict(ladder_of(10., 9., 9.1)).outcome, Outcome::fail); // it rises
  EXPECT_EQ(verdict(ladder_of(10., 11., 9.)).outcome, Outcome::fail);
  EXPECT_EQ(verdict(ladder_of(10., 11., 11.1)).outcome, Outcome::fail);
  // Where P1 is exact there is nothing to fall, and a nonlinear law or an infinite cloth has no
  // such theorem.
  EXPECT_TRUE(verdicts_of_nested_forces({ladder_of(10., 10., 10.)}).empty());
  UncertaintyRow other = ladder_of(10., 9., 9.);
  other.reference      = "biot";
  EXPECT_TRUE(verdicts_of_nested_forces({other}).empty());
  other.reference = "linear", other.load = "periodic-11";
  EXPECT_TRUE(verdicts_of_nested_forces({other}).empty());
}

// 4 x 4 squares on 4 x 4 cells: 17 x 17 vertices, of which 7 x 7 lie in the middle.
TEST(exact_table_verdicts, parts_make_up_the_mean)
{
  homogenization::UnitCell cell =
    tests::cell_of(tests::skewed_lattice(), 4, 4, tests::soft_and_hard(), tests::halves);
  cell.name     = "cell";
  StrainRow row = row_of((49. * 1. + 240. * 3.) / 289., 4., 5.);
  row.cells = 4, row.interior = 1., row.edge = 3.;
  const auto verdict = [&](const double interior)
  {
    StrainRow other = row;
    other.interior  = interior;
    return verdicts_of_parts({row, other, row_of(1., 1., 1.)}, cell).at(0);
  };
  EXPECT_EQ(verdict(1.).outcome, Outcome::pass);
  EXPECT_LT(verdict(1.).value, 1e-15);
  EXPECT_EQ(verdict(1.001).outcome, Outcome::fail);
  EXPECT_TRUE(verdicts_of_parts({row_of(1., 1., 1.)}, cell).empty());
}

TEST(exact_table_verdicts, linear_theory_is_proportional)
{
  homogenization::UnitCell cell =
    tests::cell_of(tests::square_lattice(0.01), 4, 4, tests::soft_and_hard(), tests::halves);
  cell.name             = "cell";
  const auto verdict_at = [&](const double error, const double force, const char *reference)
  {
    std::vector<StrainRow> rows;
    std::vector<ForceRow> forces;
    for (const double strain : {0.01, 0.1})
    {
      rows.push_back({"cell", "strip-1", strain, reference, "localized", 20});
      rows.back().mean = strain * (strain < 0.05 ? 1e-4 : error);
      forces.push_back({"cell", "strip-1", strain, reference, "resolved"});
      forces.back().per_width = -strain * (strain < 0.05 ? 2. : force);
    }
    return verdicts_of_proportions(rows, forces, cell, 1e-9);
  };
  EXPECT_EQ(verdict_at(1e-4, 2., "linear").at(0).outcome, Outcome::pass);
  EXPECT_NEAR(verdict_at(1.02e-4, 2., "linear").at(0).value, 1e-5, 1e-12);
  EXPECT_EQ(verdict_at(1.02e-4, 2., "linear").at(0).outcome, Outcome::fail);
  EXPECT_EQ(verdict_at(1e-4, 2.1, "linear").at(0).outcome, Outcome::fail);
  EXPECT_TRUE(verdict_at(1e-3, 3., "biot").empty());
}

TEST(bound_table_verdicts, the_third_discretization_is_no_short_cut)
{
  const auto outcome = [](const double p1_to_p2, const double p1_to_refined, const double last)
  {
    UncertaintyRow row;
    row.p1_to_p2 = p1_to_p2, row.p1_to_refined = p1_to_refined, row.p2_to_refined = last;
    return verdict_of_triangles({row, UncertaintyRow()}).outcome;
  };
  EXPECT_EQ(outcome(4., 5., 1.), Outcome::pass);
  EXPECT_EQ(outcome(0., 0., 0.), Outcome::pass);
  EXPECT_EQ(outcome(4., 5., 0.9), Outcome::fail);
  EXPECT_EQ(outcome(5., 4., 0.9), Outcome::fail);
  EXPECT_EQ(outcome(1., 1., 2.1), Outcome::fail);
  EXPECT_EQ(verdict_of_triangles({}).outcome, Outcome::inconclusive);
}

TEST(exact_table_verdicts,
     where_the_motion_is_prescribed_the_coarse_mesh_has_the_bars_of_its_reference)
{
  const homogenization::UnitCell cell = homogenization::read_unit_cell(CELLS "layered.prm");
  const auto outcome =
    [&](const std::string &load, const double of_affine, const double of_reference)
  {
    std::vector<UncertaintyRow> rows;
    for (const auto &[method, distance] :
         {std::pair("affine", of_affine), {UncertaintyRow::of_reference, of_reference}})
    {
      rows.push_back({cell.name, load, "biot", 0.05, 1, method});
      rows.back().p1_to_p2 = rows.back().p1_to_refined = rows.back().p2_to_refined = distance;
    }
    return verdict_of_prescribed_motion(rows, cell).outcome;
  };
  EXPECT_EQ(outcome("periodic-12", 1e-6, 1e-6), Outcome::pass);
  EXPECT_EQ(outcome("periodic-12", 0., 1e-6), Outcome::fail) << "of a reference that stays";
  EXPECT_EQ(outcome("periodic-12", 1e-6, 1.000001e-6), Outcome::fail);
  EXPECT_EQ(outcome("uniaxial-1", 0., 1e-6), Outcome::inconclusive);
  EXPECT_EQ(outcome("strip-1", 0., 1e-6), Outcome::inconclusive);
}

TEST(exact_table_verdicts, a_file_gives_back_its_numbers_and_a_changed_digit_is_noticed)
{
  const Folder folder;
  const std::vector<StrainRow> rows = {row_of(1. / 3., 0.4, 0.5), row_of(none, none, none)};
  {
    StrainRow second = rows[1];
    second.method    = "affine";
    Table<StrainRow> table(folder.path);
    table.append(rows[0]);
    table.append(second);
    EXPECT_EQ(verdict_of_reading(table.rows(), folder.path).outcome, Outcome::pass);
  }
  const auto file = folder.path / StrainRow::file;
  std::ifstream input(file);
  std::string text((std::istreambuf_iterator<char>(input)), std::istreambuf_iterator<char>());
  const std::size_t digits = text.find("0.3333333333333333");
  ASSERT_NE(digits, std::string::npos);
  std::ofstream(file) << text.replace(digits, 18, "0.333333");
  const Verdict changed = verdict_of_reading({rows[0]}, folder.path);
  EXPECT_EQ(changed.outcome, Outcome::fail);
  EXPECT_EQ(changed.value, 1.);
  StrainRow lost = rows[0];
  lost.load      = "strip-2";
  EXPECT_EQ(verdict_of_reading({lost}, folder.path).outcome, Outcome::fail);
}
