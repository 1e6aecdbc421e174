// SPDX-License-Identifier: MIT
#include "verification/strain/claims/cubic_verdicts.h"

#include "tests/homogenization/cell/cells.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::verification;

namespace
{
/// What is said of P = C s + T/2 s² + q s³, where the coarse cloth has C s, by a cell that says
/// another T.
Outcome judged(const double said_T, const double q, const std::vector<double> &strains,
               const std::vector<LevelRow> &levels = {})
{
  const double C = 1000., T = 600.;
  meshes::HomogenizedCell homogenized;
  homogenized.stiffness                                  = C * Eigen::Matrix3d::Identity();
  homogenized.second_order["biot"].energy.derivatives(0) = said_T;
  homogenization::UnitCell cell =
    tests::cell_of(tests::square_lattice(1.), 4, 4, tests::soft_and_hard(), tests::halves);
  cell.name = "cell";
  StrainStudyOptions options;
  options.strains    = {0.001, 0.002, 0.01, 0.1};
  options.loads      = {"periodic-11", "strip-1"};
  options.references = {"linear", "biot"};
  options.methods    = {"localized", "full"};
  std::vector<ForceRow> rows;
  for (const double s : strains)
    for (const char *method : {"resolved", "coarse"})
    {
      rows.push_back({"cell", "periodic-11", s, "biot", method});
      rows.back().per_width =
        C * s + (rows.back().method == "resolved" ? T / 2. * s * s + q * s * s * s : 0.);
    }
  const std::vector<Verdict> verdicts = cubic_verdicts(rows, levels, options, cell, homogenized);
  EXPECT_EQ(verdicts.size(), 1u); // neither in linear theory nor of sheets
  return verdicts.at(0).outcome;
}
} // namespace

TEST(exact_cubic_verdicts, stress_beyond_linear_is_that_of_the_cubic_energy)
{
  const std::vector<double> strains = {0.001, 0.002, 0.01};
  for (const double q : {4., -4., 300.})
  {
    EXPECT_EQ(judged(600., q, strains), Outcome::pass) << q;
    EXPECT_EQ(judged(590., q, strains), Outcome::fail) << q;
    EXPECT_EQ(judged(-600., q, strains), Outcome::fail) << q;
  }
}

TEST(bound_cubic_verdicts, strains_that_are_not_small_or_not_reached_decide_nothing)
{
  EXPECT_EQ(judged(600., 1e6, {0.001, 0.002}), Outcome::inconclusive);
  EXPECT_EQ(judged(6., 1e6, {0.001, 0.002}), Outcome::inconclusive);
  EXPECT_EQ(judged(600., 4., {0.001, 0.01}), Outcome::inconclusive);
  LevelRow lost = {"cell", "periodic-11", "biot", 0.002, "soft", 8, 1, -0.1};
  EXPECT_EQ(judged(590., 4., {0.001, 0.002}, {lost}), Outcome::inconclusive);
}
