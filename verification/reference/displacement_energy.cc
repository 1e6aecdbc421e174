// SPDX-License-Identifier: MIT
#include "verification/reference/displacement_energy.h"

#include "meshes/plain/epsilon.h"

#include <Eigen/LU>

#include <cmath>

namespace homespun::verification
{
Eigen::Vector3d affine_strain(const meshes::Sheet &sheet, const Load &load, const double strain)
{
  const Eigen::Matrix2d sides      = sheet.sides();
  const Eigen::RowVector2d at_rest = load.displacement({0., 0.}, sides, strain);
  Eigen::Matrix2d along_sides; // rows: what the displacement gains along each side
  along_sides << load.displacement({1., 0.}, sides, strain) - at_rest,
    load.displacement({0., 1.}, sides, strain) - at_rest;
  const Eigen::Matrix2d gradient = (sides.inverse() * along_sides).transpose(); // du_i / dx_j
  return {gradient(0, 0), gradient(1, 1), gradient(0, 1) + gradient(1, 0)};
}

DisplacementEnergy displacement_energy(const meshes::Sheet &sheet,
                                       const std::vector<Eigen::Matrix3d> &stiffness_of_phase,
                                       const Load &load, const double strain,
                                       const meshes::Points &positions)
{
  const meshes::Points &rest   = sheet.mesh.vertices;
  const Eigen::Vector3d affine = affine_strain(sheet, load, strain);
  DisplacementEnergy result;
  long double energy = 0., work = 0.;
  double forces = 0.;
  for (int t = 0; t < sheet.mesh.n_triangles(); ++t)
  {
    const Eigen::RowVector3i corners = sheet.mesh.triangles.row(t);
    Eigen::Matrix2d legs; // columns
    legs << (rest.row(corners(1)) - rest.row(corners(0))).transpose(),
      (rest.row(corners(2)) - rest.row(corners(0))).transpose();
    const double area             = 0.5 * legs.determinant();
    const Eigen::Matrix2d inverse = legs.inverse();
    Eigen::Matrix<double, 2, 3> slopes; // gradients of the shape functions
    slopes << -inverse.row(0).transpose() - inverse.row(1).transpose(), inverse.row(0).transpose(),
      inverse.row(1).transpose();
    Eigen::Matrix<double, 3, 6> B = Eigen::Matrix<double, 3, 6>::Zero();
    Eigen::Matrix<double, 6, 1> moved, rounded;
    for (int k = 0; k < 3; ++k)
    {
      const int v = corners(k);
      B.col(2 * k) << slopes(0, k), 0., slopes(1, k);
      B.col(2 * k + 1) << 0., slopes(1, k), slopes(0, k);
      moved.segment<2>(2 * k) = (positions.row(v) - rest.row(v)).transpose();
      rounded.segment<2>(2 * k) =
        2. * meshes::epsilon * (positions.row(v).cwiseAbs() + rest.row(v).cwiseAbs()).transpose();
    }
    const Eigen::Matrix3d &C = stiffness_of_phase[static_cast<std::size_t>(sheet.mesh.material(t))];
    const Eigen::Vector3d eps   = B * moved;
    const Eigen::Vector3d sigma = C * eps;
    const Eigen::Vector3d wrong =
      B.cwiseAbs() * (rounded + 4. * meshes::epsilon * moved.cwiseAbs());
    energy += 0.5 * area * sigma.dot(eps);
    work += 0.5 * area * sigma.dot(affine);
    result.round_off += area * sigma.cwiseAbs().dot(wrong);
    result.round_off_of_work +=
      area * (sigma - 0.5 * C * affine).cwiseAbs().dot(wrong) +
      4. * meshes::epsilon * area * sigma.cwiseAbs().dot(affine.cwiseAbs());
    forces += (area * B.transpose() * sigma).squaredNorm();
  }
  result.energy      = static_cast<double>(energy);
  result.affine_work = static_cast<double>(work);
  result.force_size  = std::sqrt(forces);
  double distance    = 0.;
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
    distance += (positions.row(v) - rest.row(v) -
                 load.displacement(sheet.fraction(rest.row(v)), sheet.sides(), strain))
                  .squaredNorm();
  result.distance_from_affine = std::sqrt(distance);
  return result;
}
} // namespace homespun::verification
