// SPDX-License-Identifier: MIT
#include "verification/reference/load_forces.h"

#include "meshes/plain/triangle_kinematics.h"

#include <Eigen/LU>

#include <cmath>
#include <limits>

namespace homespun::verification
{
namespace
{
/// How far the moving clamp goes per strain [m].
Eigen::RowVector2d way_per_strain(const Load &load, const Eigen::Matrix2d &sides)
{
  return load.displacement({1., 1.}, sides, 1.);
}
} // namespace

double force_along(const Load &load, const Eigen::Matrix2d &sides, const LoadForces &forces)
{
  if (load.is_periodic())
    return std::numeric_limits<double>::quiet_NaN();
  return forces.on_clamps.row(1).dot(way_per_strain(load, sides).normalized());
}

double force_per_width(const Load &load, const Eigen::Matrix2d &sides, const LoadForces &forces)
{
  if (load.has_free_sides()) // those of the sides are zero
    return (forces.stress.cwiseProduct(load.gradient(1., {0., 0.}) - Eigen::Matrix2d::Identity()))
      .sum();
  if (load.is_periodic())
    return forces.stress.cwiseProduct(load.gradient(1.) - load.gradient(0.)).sum();
  return force_along(load, sides, forces) / sides.row(1 - load.axis()).norm();
}

LoadForces load_forces(const Load &load, const meshes::Sheet &sheet, const meshes::Points &rest,
                       const meshes::Points &gradient)
{
  LoadForces forces;
  if (!load.is_periodic())
    for (Eigen::Index v = 0; v < rest.rows(); ++v)
      if (const Eigen::RowVector2d f = sheet.fraction(rest.row(v)); load.holds(f))
        forces.on_clamps.row(f(load.axis()) < 0.5 ? 0 : 1) += gradient.row(v);
  // Relative to a corner of the sheet, so that one far from the origin keeps its digits.
  forces.stress =
    gradient.transpose() * (rest.rowwise() - sheet.origin) / std::abs(sheet.sides().determinant());
  return forces;
}

SheetEnergy sheet_energy(const meshes::Sheet &sheet,
                         const std::vector<Eigen::Matrix3d> &stiffness_of_phase, const Law law,
                         const meshes::Points &positions)
{
  SheetEnergy sum;
  for (int t = 0; t < sheet.mesh.n_triangles(); ++t)
  {
    const Eigen::RowVector3i corners = sheet.mesh.triangles.row(t);
    const double area =
      0.5 * meshes::sides_of_triangle<2>(corners, sheet.mesh.vertices).determinant();
    const Response local =
      response(law, stiffness_of_phase[static_cast<std::size_t>(sheet.mesh.material(t))],
               meshes::deformation_gradient<2>(sheet.mesh, t, positions));
    sum.energy += area * local.energy;
    sum.stress += area * Eigen::Map<const Eigen::Matrix2d>(local.stress.data()).transpose();
  }
  sum.stress /= std::abs(sheet.sides().determinant());
  return sum;
}
} // namespace homespun::verification
