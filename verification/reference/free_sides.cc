// SPDX-License-Identifier: MIT
#include "verification/reference/free_sides.h"

#include "meshes/plain/errors.h"

#include <Eigen/LU>

#include <limits>
#include <vector>

namespace homespun::verification
{
Eigen::Vector2d free_strains_of(const Load &load, const Law law, const Eigen::Matrix3d &C,
                                const double strain)
{
  return free_strains_of(
    load, [&](const Eigen::Matrix2d &F) { return response(law, C, F); }, C, strain);
}

Eigen::Vector2d free_strains_of(const Load &load,
                                const std::function<Response(const Eigen::Matrix2d &F)> &law,
                                const Eigen::Matrix3d &C, const double strain)
{
  // Places of e and g among F11, F12, F21, F22.
  const Eigen::Vector2i places = load.axis() == 0 ? Eigen::Vector2i(3, 1) : Eigen::Vector2i(0, 2);
  Eigen::Vector2d free         = Eigen::Vector2d::Zero();
  std::vector<double> history;
  for (int newton = 0; newton < 50; ++newton)
  {
    // The first step is that of linear theory.
    const Eigen::Matrix2d F = load.gradient(strain, free);
    const Response here     = newton == 0 ? response(Law::linear, C, F) : law(F);
    Eigen::Vector2d stress;
    Eigen::Matrix2d tangent;
    for (int k = 0; k < 2; ++k)
    {
      stress(k) = here.stress(places(k));
      for (int l = 0; l < 2; ++l)
        tangent(k, l) = here.tangent(places(k), places(l));
    }
    // F carries the strains with an absolute error of a rounding of 1.
    const double round_off = std::numeric_limits<double>::epsilon() * C.norm();
    history.push_back(stress.norm() / here.stress.norm());
    if (newton > 0 && stress.norm() <= 4. * round_off + 1e-13 * here.stress.norm())
      return free;
    free -= tangent.fullPivLu().solve(stress);
  }
  throw meshes::NotConverged("the sides of the homogenized cloth do not become free of stress",
                             history);
}
} // namespace homespun::verification
