// SPDX-License-Identifier: MIT
// What a study says of the ellipticity of a level: levels.csv, its notes, the column of
// validity.csv.
#include "meshes/files/temporary_folder.h"
#include "tests/homogenization/cell/cells.h"
#include "verification/strain/level_ellipticity.h"
#include "verification/strain/validity.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::verification;

namespace
{
LevelRow row(const double strain, const int lost, const double least,
             const std::string &part = "yarn")
{
  return {"cell", "strip-1", "biot", strain, part, 10, lost, least};
}

/// A cloth of one phase, E/G = 40: `biot` is lost at 4/36 along either axis.
homogenization::UnitCell yarn_cell()
{
  homogenization::Phase yarn = homogenization::isotropic("yarn", 40., 0., 1., 1.);
  yarn.G12                   = 1.;
  return tests::cell_of(tests::square_lattice(0.01), 1, 1, {yarn},
                        [](double, double) { return 0; });
}
} // namespace

TEST(exact_level_ellipticity, the_strain_of_loss_lies_between_the_levels)
{
  EXPECT_TRUE(std::isnan(strain_of_loss({row(0.01, 0, 0.9), row(0.02, 0, 0.8)})));
  EXPECT_DOUBLE_EQ(strain_of_loss({row(0.04, 3, -1.)}), 0.02);
  EXPECT_DOUBLE_EQ(strain_of_loss({row(0.04, 3, -0.3), row(0.02, 0, 0.1), row(0.1, 0, 2.)}), 0.025);
  const std::vector<LevelRow> both = {row(0.04, 3, -1.), row(0.04, 1, -3., coarse_cloth_part)};
  EXPECT_DOUBLE_EQ(elliptic_up_to(both, "cell", "strip-1", "biot"), 0.01);
  EXPECT_TRUE(std::isnan(elliptic_up_to(both, "cell", "strip-1", "green")));
  StrainRow error = {"cell", "strip-1", 0.04, "biot", "localized"};
  error.mean = error.per_cell         = 0.02;
  const std::vector<ValidityRow> rows = validity_rows({error}, both);
  ASSERT_FALSE(rows.empty());
  for (const ValidityRow &valid : rows)
    EXPECT_DOUBLE_EQ(valid.elliptic_up_to, 0.01);
}

TEST(tripwire_level_ellipticity, the_range_of_validity_ends_where_ellipticity_is_lost)
{
  std::vector<StrainRow> errors;
  for (const double strain : {0.01, 0.02, 0.04})
  {
    StrainRow error = {"cell", "strip-1", strain, "biot", "localized"};
    error.mean = error.per_cell = 0.1 * strain;
    error.bar                   = 0.01 * strain;
    errors.push_back(error);
  }
  const auto of_limit = [&](const double limit, const std::vector<LevelRow> &ellipticity)
  {
    for (const ValidityRow &valid : validity_rows(errors, ellipticity))
      if (valid.measure == "cell side" && valid.limit == limit)
        return valid;
    return ValidityRow();
  };
  EXPECT_EQ(of_limit(0.05, {}).relation, ">");
  EXPECT_DOUBLE_EQ(of_limit(0.05, {}).largest, 0.04);
  const std::vector<LevelRow> lost = {row(0.02, 0, 0.1), row(0.04, 3, -0.3)}; // at 0.025
  const ValidityRow found          = of_limit(0.05, lost);
  EXPECT_EQ(found.relation, "=");
  for (const double strain : {found.largest, found.lower, found.upper})
    EXPECT_DOUBLE_EQ(strain, 0.025);
  EXPECT_NE(found.note.find("loses ellipticity"), std::string::npos);
  EXPECT_NE(found.note.find("at every level, to 4 %"), std::string::npos) << found.note;
  // A loss beyond the range, or none, changes nothing.
  errors[1].per_cell = errors[1].mean = 0.1;
  EXPECT_LT(of_limit(0.05, lost).largest, 0.02);
  EXPECT_EQ(of_limit(0.05, lost).note, "");
  EXPECT_EQ(of_limit(0.05, {row(0.01, 0, 0.9), row(0.02, 0, 0.8)}).note, "");
  // Nor does the upper end go beyond it.
  errors[1].bar = 0.06;
  EXPECT_EQ(of_limit(0.05, lost).upper, 0.025);
}

TEST(exact_level_ellipticity, a_pulled_cloth_of_one_phase_is_lost_where_theory_says_and_told_once)
{
  const homogenization::UnitCell cell = yarn_cell();
  const meshes::Sheet sheet           = meshes::tile(cell.mesh, cell.lattice, 1, 1);
  const meshes::HomogenizedCell as_one =
    homogenization::homogenized_cell(cell, tests::solved(cell), "test");
  const Load load("uniaxial-1");
  const meshes::TriangleMesh coarse =
    meshes::coarse_sheet(sheet.origin, sheet.lattice.vectors, sheet.n1, sheet.n2);
  const meshes::TemporaryFolder folder(testing::TempDir());
  StrainStudyOptions options;
  options.output = folder.path;
  options.budget = options.run_time = false;
  std::vector<std::string> told;
  StrainOutput output(options, [&](const std::string &line) { told.push_back(line); });
  const auto pulled = [](const meshes::Points &rest, const double strain)
  {
    meshes::Points moved = rest;
    moved.col(0) *= 1. + strain; // the sides are free, Poisson's ratio is zero
    return moved;
  };
  for (const Law law : {Law::linear, Law::biot, Law::green, Law::yarn})
    for (const double strain : {0.11, 0.112, 0.15})
    {
      const StrainLevel level = {cell.name, load.name, law, strain};
      ReferenceStep fine;
      fine.positions = pulled(sheet.mesh.vertices, strain);
      write_ellipticity(level, {sheet, fine, 0, 1, {}, Stability::every_triangle, 0.}, cell,
                        output);
      write_coarse_ellipticity(level, coarse, as_one.stiffness, pulled(coarse.vertices, strain),
                               output);
    }
  // The numerator of the closed form is linear in strain, its square of stretches is not:
  // 2 % of curvature over 0.002 of strain.
  std::vector<LevelRow> rows; // beside those of the levels, which have the notes
  for (const LevelRow &row : output.levels.rows())
    if (!row.part.empty())
      rows.push_back(row);
  EXPECT_EQ(rows.size(), 18u); // linear has none to lose
  EXPECT_NEAR(elliptic_up_to(rows, cell.name, load.name, "biot"), 4. / 36., 2e-6);
  for (const LevelRow &found : rows)
  {
    // The coarse cloth has the law of yarns beside them, else the corotational one.
    const bool is_biot =
      found.reference == "biot" || (found.part == coarse_cloth_part && found.reference != "yarn");
    EXPECT_EQ(found.lost, is_biot && found.strain > 4. / 36. ? 2 : 0) << found.part;
    const double l1 = 1. + found.strain;
    if (is_biot)
    {
      EXPECT_NEAR(found.least, (4. * l1 * l1 - 40. * (l1 - 1.) * l1) / std::pow(l1 + 1., 2), 1e-9);
    }
  }
  ASSERT_EQ(told.size(), 3u); // two levels of the phase, once the coarse cloth
  EXPECT_NE(told[0].find("2 of 2 triangles of phase yarn are not elliptic under biot, the first "
                         "from a strain of 11.1 % on"),
            std::string::npos)
    << told[0];
  EXPECT_NE(told[1].find("of the coarse cloth are not elliptic under its law, biot with C^H"),
            std::string::npos)
    << told[1];
}
