// SPDX-License-Identifier: MIT
#include "meshes/files/temporary_folder.h"
#include "verification/strain/strain_output.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace homespun;
using namespace homespun::verification;

namespace
{
meshes::Sheet one_triangle()
{
  meshes::Sheet sheet;
  sheet.n1 = sheet.n2   = 1;
  sheet.lattice.vectors = Eigen::Matrix2d::Identity();
  sheet.origin.setZero();
  sheet.mesh.vertices.resize(3, 2);
  sheet.mesh.vertices << 0., 0., 1., 0., 0., 1.;
  sheet.mesh.triangles.resize(1, 3);
  sheet.mesh.triangles << 0, 1, 2;
  return sheet;
}
} // namespace

TEST(exact_strain_output, a_fluctuation_that_is_not_known_is_empty_and_never_zero)
{
  const meshes::TemporaryFolder folder(testing::TempDir());
  StrainStudyOptions options;
  options.output = folder.path;
  options.budget = options.run_time = false;
  constexpr double not_known        = std::numeric_limits<double>::quiet_NaN();
  const StrainLevel level           = {"cell", "strip-1", Law::biot, 0.01};
  {
    StrainOutput output(options, [](const std::string &) {});
    for (const auto &[method, fluctuation] :
         {std::pair{"known", 1e-6}, {"zero", 0.}, {"localized", not_known}})
    {
      StrainRow row = row_of(level, method, one_triangle());
      set_errors(row, Eigen::VectorXd::Constant(3, 2e-6), one_triangle(), fluctuation);
      output.strain.append(row);
    }
    LevelRow step    = row_of(level);
    step.fluctuation = step.fluctuation_bar = not_known;
    output.write_step(step);
  }
  // As the next run, or the report, reads it.
  const StrainOutput again(options, [](const std::string &) {});
  ASSERT_EQ(again.strain.rows().size(), 3u);
  EXPECT_DOUBLE_EQ(again.strain.rows()[0].per_fluctuation, 2.);
  EXPECT_TRUE(std::isnan(again.strain.rows()[1].per_fluctuation));
  EXPECT_TRUE(std::isnan(again.strain.rows()[2].per_fluctuation));
  EXPECT_TRUE(std::isnan(again.levels.rows().at(0).fluctuation));
  EXPECT_TRUE(std::isnan(again.levels.rows().at(0).fluctuation_bar));
}

TEST(exact_strain_output, a_level_has_its_remarks_once_in_its_own_row_and_they_are_taken_up)
{
  const meshes::TemporaryFolder folder(testing::TempDir());
  StrainStudyOptions options;
  options.output = folder.path;
  options.budget = options.run_time = false;
  const StrainLevel level           = {"cell", "strip-1", Law::biot, 0.01};
  LevelRow step                     = row_of(level);
  step.ranks                        = 2;
  step.stability                    = "stable";
  {
    StrainOutput output(options, [](const std::string &) {});
    output.write_note(level, "one");
    output.write_step(step);
    output.write_note(level, "two; residual norms 1");
  }
  StrainOutput again(options, [](const std::string &) {});
  again.write_note(level, "one");
  step.ranks = 3; // of a level that was solved before
  again.write_step(step);
  ASSERT_EQ(again.levels.rows().size(), 1u);
  EXPECT_EQ(again.levels.rows()[0].ranks, 2u);
  EXPECT_EQ(again.levels.rows()[0].note, "one | two");
  EXPECT_EQ(again.notes(), (std::vector<std::string>{"cell, strip-1, biot at strain 0.01: one",
                                                     "cell, strip-1, biot at strain 0.01: two"}));
}
