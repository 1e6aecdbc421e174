// SPDX-License-Identifier: MIT
// A free sheet that turns without changing its shape: the exact motion against which integrators
// are held.
#pragma once

#include "tests/shell/solver/cloth_cases.h"

#include <Eigen/Dense>

namespace homespun::tests
{
/// A sheet in its plane whose forces hold it together as it turns about axis 3 with the angular
/// velocity ω: a stationary point of E(x) − ½ ω² Σ m |x|². Its exact motion is x(t) = R(ω t) x(0).
struct RelativeEquilibrium
{
  shell::Vectors positions, velocities; ///< (n,3)
  double largest_strain = 0.;           ///< of all triangles [-]
};

/// Newton's method in the plane, the angular velocity raised in eight parts; of the rotations,
/// under which all stays the same, each iteration takes the least.
inline RelativeEquilibrium relative_equilibrium(const meshes::ClothMesh &mesh,
                                                const Eigen::Matrix3d &D,
                                                const Eigen::VectorXd &masses, const double omega)
{
  const shell::Membrane membrane = shell::membrane(mesh.rest, {D});
  const int n                    = mesh.n_vertices();
  shell::Positions<2> x          = mesh.rest.vertices;
  x.rowwise() -= (masses.transpose() * x / masses.sum()).eval();
  const auto corners_of = [&](const int t)
  {
    Eigen::Matrix<double, 3, 2> corners;
    for (int k = 0; k < 3; ++k)
      corners.row(k) = x.row(membrane.triangles(t, k));
    return corners;
  };
  for (int iteration = 0; iteration < 24; ++iteration)
  {
    const double load = std::pow(omega * std::min(1., (iteration + 1) / 8.), 2);
    const shell::Positions<2> residual =
      shell::membrane_gradient<2>(membrane, x).gradient - load * masses.asDiagonal() * x;
    Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    for (int t = 0; t < mesh.n_triangles(); ++t)
    {
      const Eigen::Matrix<double, 6, 6> local = shell::triangle_hessian<2>(
        membrane.rest[static_cast<std::size_t>(t)], corners_of(t), membrane.stiffness[0]);
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          hessian.block<2, 2>(2 * membrane.triangles(t, a), 2 * membrane.triangles(t, b)) +=
            local.block<2, 2>(2 * a, 2 * b);
    }
    for (int v = 0; v < n; ++v)
      hessian.block<2, 2>(2 * v, 2 * v).diagonal().array() -= load * masses(v);
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(1e-11);
    solver.compute(hessian);
    const Eigen::VectorXd step =
      solver.solve(-Eigen::Map<const Eigen::VectorXd>(residual.data(), 2 * n));
    for (int v = 0; v < n; ++v)
      x.row(v) += step.segment<2>(2 * v).transpose();
  }
  RelativeEquilibrium result;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    result.largest_strain =
      std::max(result.largest_strain,
               shell::biot_strain<2>(shell::deformation_gradient<2>(
                                       membrane.rest[static_cast<std::size_t>(t)], corners_of(t)))
                 .cwiseAbs()
                 .maxCoeff());
  result.positions.resize(n, 3);
  result.positions << x, Eigen::VectorXd::Zero(n);
  result.velocities.resize(n, 3);
  for (int v = 0; v < n; ++v)
    result.velocities.row(v) << -omega * x(v, 1), omega * x(v, 0), 0.;
  return result;
}
} // namespace homespun::tests
