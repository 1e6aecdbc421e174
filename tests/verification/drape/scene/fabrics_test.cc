// SPDX-License-Identifier: MIT
#include "verification/drape/scene/fabrics.h"

#include <gtest/gtest.h>

#include <sstream>

using namespace homespun;
using namespace homespun::verification;

TEST(exact_fabrics, a_strip_along_each_direction_bends_as_measured)
{
  const shell::PlateStiffness denim = *bending_of_fabric("11oz-black-denim");
  const Eigen::Matrix3d D           = denim.matrix();
  const auto along                  = [&](const double angle)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    const Eigen::Vector3d curvature(c * c, s * s, 2. * c * s);
    return curvature.dot(D * curvature);
  };
  EXPECT_NEAR(along(0.), 64.2e-6, 1e-18);
  EXPECT_NEAR(along(M_PI / 4.), 73.4e-6, 1e-18);
  EXPECT_NEAR(along(M_PI / 2.), 97.0e-6, 1e-18);
}

TEST(exact_fabrics, all_ten_are_plates)
{
  std::istringstream names(names_of_fabrics());
  int n = 0;
  for (std::string name; std::getline(names >> std::ws, name, ','); ++n)
    EXPECT_TRUE(bending_of_fabric(name)->is_positive_definite()) << name;
  EXPECT_EQ(n, 10);
  EXPECT_FALSE(bending_of_fabric("cotton"));
}
