// SPDX-License-Identifier: MIT
#include "tests/verification/manufactured/nodal_fields.h"

#include <Eigen/LU>

#include <cmath>
#include <vector>

namespace homespun::verification
{
namespace
{
/// Barycentric coordinates, and the share of the area.
struct QuadraturePoint
{
  Eigen::RowVector3d weights;
  double share;
};

/// Dunavant, Int. J. Numer. Meth. Engng. 21, 1985: degree 4.
std::vector<QuadraturePoint> six_points()
{
  std::vector<QuadraturePoint> points;
  for (const auto &[a, share] : {std::pair(0.445948490915965, 0.223381589678011),
                                 std::pair(0.091576213509771, 0.109951743655322)})
    for (int k = 0; k < 3; ++k)
    {
      points.push_back({Eigen::RowVector3d::Constant(a), share});
      points.back().weights(k) = 1. - 2. * a;
    }
  return points;
}

Eigen::Matrix<double, 3, 2> corners_of(const meshes::TriangleMesh &rest, const int t)
{
  Eigen::Matrix<double, 3, 2> corners;
  for (int k = 0; k < 3; ++k)
    corners.row(k) = rest.vertices.row(rest.triangles(t, k));
  return corners;
}
} // namespace

Eigen::Matrix<double, 3, 2> shape_gradients(const meshes::TriangleMesh &rest, const int triangle)
{
  // b_k = 1 at corner k: the rows of the inverse of (1, x, y).
  Eigen::Matrix3d corners;
  corners << Eigen::Vector3d::Ones(), corners_of(rest, triangle);
  return corners.inverse().bottomRows<2>().transpose();
}

meshes::SpacePoints
nodal_loads(const meshes::TriangleMesh &rest,
            const std::function<FieldValue(const Eigen::RowVector2d &rest_point)> &force)
{
  const std::vector<QuadraturePoint> points = six_points();
  const Eigen::VectorXd areas               = meshes::signed_areas(rest);
  meshes::SpacePoints loads                 = meshes::SpacePoints::Zero(rest.n_vertices(), 3);
  for (int t = 0; t < rest.n_triangles(); ++t)
  {
    const Eigen::Matrix<double, 3, 2> corners = corners_of(rest, t);
    for (const QuadraturePoint &point : points)
    {
      const FieldValue f = areas(t) * point.share * force(point.weights * corners);
      for (int k = 0; k < 3; ++k)
        loads.row(rest.triangles(t, k)) += point.weights(k) * f.transpose();
    }
  }
  return loads;
}

FieldDistance distance(const meshes::TriangleMesh &rest, const meshes::SpacePoints &positions,
                       const KnownField &known)
{
  const std::vector<QuadraturePoint> points = six_points();
  const Eigen::VectorXd areas               = meshes::signed_areas(rest);
  double values = 0., gradients = 0.;
  for (int t = 0; t < rest.n_triangles(); ++t)
  {
    const Eigen::Matrix<double, 3, 2> corners = corners_of(rest, t);
    Eigen::Matrix3d current;
    for (int k = 0; k < 3; ++k)
      current.row(k) = positions.row(rest.triangles(t, k));
    const FieldGradient F = current.transpose() * shape_gradients(rest, t);
    for (const QuadraturePoint &point : points)
    {
      const Eigen::RowVector2d at = point.weights * corners;
      const double weight         = areas(t) * point.share;
      values += weight * ((point.weights * current).transpose() - known.value(at)).squaredNorm();
      gradients += weight * (F - known.gradient(at)).squaredNorm();
    }
  }
  return {std::sqrt(values), std::sqrt(gradients)};
}
} // namespace homespun::verification
