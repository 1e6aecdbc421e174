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
  sheet.n1 = sheet.n2 = 1;
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
    StrainErrors errors;
    errors.distance = Eigen::VectorXd::Constant(3, 2e-6);
    errors.side     = 0.01;
    for (const auto &[method, fluctuation] :
         {std::pair{"known", 1e-6}, {"zero", 0.}, {"localized", not_known}})
    {
      errors.fluctuation = fluctuation;
      output.write_errors(level, method, one_triangle(), 1, errors);
    }
    StepRow step;
    step.fluctuation = step.fluctuation_bar = not_known;
    output.write_step(level, step);
  }
  // As the next run, or the report, reads it.
  const StrainOutput again(options, [](const std::string &) {});
  ASSERT_EQ(again.strain_rows().size(), 3u);
  EXPECT_DOUBLE_EQ(again.strain_rows()[0].per_fluctuation, 2.);
  EXPECT_TRUE(std::isnan(again.strain_rows()[1].per_fluctuation));
  EXPECT_TRUE(std::isnan(again.strain_rows()[2].per_fluctuation));
  EXPECT_TRUE(std::isnan(again.step_rows().at(0).fluctuation));
  EXPECT_TRUE(std::isnan(again.step_rows().at(0).fluctuation_bar));
}
