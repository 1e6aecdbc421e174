// SPDX-License-Identifier: MIT
// Meshes, stiffnesses and placements that the tests of the moving cloth's reference share.
#pragma once

#include "meshes/plain/sheet.h"
#include "verification/reference/cloth_reference.h"

#include <Eigen/Geometry>

#include <cmath>

namespace homespun::tests
{
using namespace verification;

using Held = ClothReference::Held;

inline const Held free_everywhere = [](const Eigen::RowVector2d &, double) { return std::nullopt; };

inline Eigen::Matrix3d isotropic(const double E, const double nu) // membrane modulus [N/m]
{
  Eigen::Matrix3d C;
  C << 1., nu, 0., nu, 1., 0., 0., 0., 0.5 * (1. - nu);
  return E / (1. - nu * nu) * C;
}

inline Eigen::Matrix3d anisotropic()
{
  Eigen::Matrix3d C;
  C << 1500., 330., 120., 330., 600., -90., 120., -90., 270.;
  return C;
}

/// n1 x n2 squares of two triangles each, over a width and a height [m], inner vertices moved
/// about.
inline meshes::TriangleMesh rectangle(const double width, const double height, const int n1,
                                      const int n2, const double irregular = 0.)
{
  Eigen::Matrix2d steps;
  steps << width / n1, 0., 0., height / n2;
  meshes::TriangleMesh mesh = meshes::coarse_sheet(Eigen::RowVector2d::Zero(), steps, n1, n2);
  for (int j = 1; j < n2; ++j)
    for (int i = 1; i < n1; ++i)
      mesh.vertices.row(j * (n1 + 1) + i) +=
        irregular * Eigen::RowVector2d(std::sin(7. * i + 3. * j) * steps(0, 0),
                                       std::sin(5. * i - 4. * j) * steps(1, 1));
  mesh.material.setZero(mesh.n_triangles());
  return mesh;
}

inline ClothReferenceOptions options_of(const Law law, const unsigned int order,
                                        const bool consistent, const double tolerance = 1e-10)
{
  ClothReferenceOptions options;
  options.law             = law;
  options.order           = order;
  options.consistent_mass = consistent;
  options.tolerance       = tolerance;
  return options;
}

inline Eigen::Matrix<double, 3, 2> tilted_plane()
{
  return Eigen::AngleAxisd(0.9, Eigen::Vector3d(1., -2., 0.5).normalized())
    .toRotationMatrix()
    .leftCols<2>();
}

inline meshes::SpacePoints images(const meshes::TriangleMesh &mesh,
                                  const ClothReference::Placement &placement)
{
  meshes::SpacePoints points(mesh.n_vertices(), 3);
  for (int v = 0; v < mesh.n_vertices(); ++v)
    points.row(v) = placement(mesh.vertices.row(v));
  return points;
}

inline double largest_distance(const meshes::SpacePoints &a, const meshes::SpacePoints &b)
{
  return (a - b).rowwise().norm().maxCoeff();
}

constexpr double g = 9.81; ///< [m/s^2]
} // namespace homespun::tests
