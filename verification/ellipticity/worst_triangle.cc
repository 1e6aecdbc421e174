// SPDX-License-Identifier: MIT
#include "verification/ellipticity/worst_triangle.h"

#include "meshes/plain/symmetric_eigen.h"
#include "meshes/plain/triangle_kinematics.h"
#include "verification/ellipticity/ellipticity.h"
#include "verification/record/number_text.h"

#include <Eigen/LU>

namespace homespun::verification
{
WorstTriangle worst_triangle(const meshes::TriangleMesh &rest,
                             const std::vector<Eigen::Matrix3d> &stiffness_of_phase, const Law law,
                             const meshes::Points &positions)
{
  std::vector<EllipticityOfLaw> laws;
  for (const Eigen::Matrix3d &C : stiffness_of_phase)
    laws.emplace_back(law, C);
  WorstTriangle worst;
  for (int t = 0; t < rest.n_triangles(); ++t)
  {
    const EllipticityOfLaw &its = laws[static_cast<std::size_t>(rest.material(t))];
    const Eigen::Matrix2d F     = meshes::deformation_gradient<2>(rest, t, positions);
    const std::optional<double> least =
      worst.triangle >= 0 && worst.least > 0. ? its.at_unless_above(F, worst.least) : its.at(F);
    if (least && (worst.triangle < 0 || *least < worst.least))
    {
      worst.triangle = t;
      worst.least    = *least;
    }
  }
  if (worst.triangle < 0)
    return worst;
  worst.is_lost           = !(worst.least > 0.);
  const Eigen::Matrix2d F = meshes::deformation_gradient<2>(rest, worst.triangle, positions);
  const Response here =
    response(law, stiffness_of_phase[static_cast<std::size_t>(rest.material(worst.triangle))], F);
  Eigen::Matrix2d P;
  P << here.stress(0), here.stress(1), here.stress(2), here.stress(3);
  const Eigen::Matrix2d S = F.inverse() * P;
  worst.stress            = meshes::symmetric_eigen<2>(0.5 * (S + S.transpose())).values;
  return worst;
}

std::string stress_text(const WorstTriangle &worst)
{
  const double size    = worst.stress.cwiseAbs().maxCoeff();
  const bool is_pulled = worst.stress(1) > 1e-6 * size, is_pressed = worst.stress(0) < -1e-6 * size;
  return std::string("is ") + (is_pulled ? "pulled" : "") +
         (is_pulled && is_pressed ? " and " : "") + (is_pressed ? "pressed" : "") +
         (is_pulled || is_pressed ? "" : "without stress") + " (principal stresses " +
         short_text(worst.stress(0)) + " and " + short_text(worst.stress(1)) + " N/m)";
}
} // namespace homespun::verification
