// SPDX-License-Identifier: MIT
// Where the homogenized law of the shipped cells, pulled along an axis, stops being elliptic.
#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_reading.h"
#include "verification/ellipticity/first_loss.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace homespun;
using namespace homespun::verification;

namespace
{
/// C^H on the mesh as it is given.
Eigen::Matrix3d stiffness_of(const std::string &name)
{
  homogenization::HomogenizationOptions options;
  options.order = 1;
  return homogenization::homogenize(
           homogenization::read_unit_cell(CELLS + name + ".prm", MPI_COMM_SELF), options,
           MPI_COMM_SELF)
    .stiffness;
}
} // namespace

// The closed form asks for axes of symmetry along those of the pull; the search knows nothing of
// it. E and G come from C^H by its compliance.
TEST(exact_shipped_loss, woven_cloth_loses_biot_below_half_a_percent_and_stripes_never)
{
  for (const auto &[name, lowest, highest] : {std::tuple{"plain-weave-straight", 0.003, 0.004},
                                              {"twill-straight", 0.0025, 0.0032},
                                              {"satin-straight", 0.0025, 0.003},
                                              {"auxetic", 0.24, 0.27}})
  {
    const Eigen::Matrix3d C = stiffness_of(name);
    const auto moduli       = homogenization::engineering_constants(C);
    const double E = std::max(moduli.E1, moduli.E2), ratio = 4. * moduli.G12 / E;
    const double first = std::min(uniaxial_loss(Law::biot, C, 1), uniaxial_loss(Law::biot, C, 2));
    RecordProperty(std::string(name) + "_percent", std::to_string(100. * first));
    // Where C16 and C26 couple, the closed form errs by some square of them.
    const bool is_orthotropic = C.col(2).head<2>().cwiseAbs().maxCoeff() < 1e-9 * C(2, 2);
    EXPECT_NEAR(first, ratio / (1. - ratio), (is_orthotropic ? 1e-6 : 0.02) * first) << name;
    EXPECT_GT(first, lowest) << name;
    EXPECT_LT(first, highest) << name;
    for (const int axis : {1, 2})
    {
      EXPECT_EQ(uniaxial_loss(Law::green, C, axis), never) << name;
      EXPECT_EQ(uniaxial_loss(Law::yarn, C, axis), never) << name;
    }
  }
  for (const std::string name : {"layered", "three-stiffness", "chevron", "printed-patch"})
    for (const int axis : {1, 2})
      EXPECT_EQ(uniaxial_loss(Law::biot, stiffness_of(name), axis), never) << name;
}
