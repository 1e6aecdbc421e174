// SPDX-License-Identifier: MIT
#include "verification/upsample/coarse_indicators.h"

#include "meshes/cloth/seams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace homespun::verification
{
CoarseIndicators::CoarseIndicators(const meshes::ClothMesh &given, const double cell_side)
    : coarse(given)
    , cell_side(cell_side)
    , frames(given.rest, {})
    , space_of_rest(meshes::space_of_rest(given))
    , areas(meshes::signed_areas(given.rest))
    , smallest_height(std::numeric_limits<double>::infinity())
{
  for (int t = 0; t < coarse.n_triangles(); ++t)
  {
    // The gradient of a corner's hat function: the opposite edge, turned, over twice the area.
    Eigen::Matrix<double, 2, 3> gradients;
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::RowVector2d edge =
        coarse.rest.vertices.row(coarse.rest.triangles(t, (k + 2) % 3)) -
        coarse.rest.vertices.row(coarse.rest.triangles(t, (k + 1) % 3));
      gradients.col(k) << -edge(1), edge(0);
      smallest_height = std::min(smallest_height, 2. * areas(t) / edge.norm());
    }
    shape_gradients.push_back(gradients / (2. * areas(t)));
  }
}

TriangleIndicators CoarseIndicators::of(const meshes::SpacePoints &positions) const
{
  const int m = coarse.n_triangles();
  meshes::SpacePoints at_rest_vertices(space_of_rest.size(), 3);
  for (Eigen::Index v = 0; v < space_of_rest.size(); ++v)
    at_rest_vertices.row(v) = positions.row(space_of_rest(v));
  const auto &blended       = frames.values(at_rest_vertices);
  TriangleIndicators result = {Eigen::VectorXd(m), Eigen::VectorXd(m), Eigen::VectorXd(m)};
  for (int t = 0; t < m; ++t)
  {
    const localization::PrincipalStrain principal =
      localization::principal_strain(frames.of_triangle(t, at_rest_vertices).strain);
    result.strain(t)      = principal.largest();
    result.compression(t) = principal.compression();
    // Columns: derivatives of (E11, E22, gamma12 / sqrt(2)) along the axes; the largest stretch of
    // that map of directions is its largest singular value.
    Eigen::Matrix<double, 3, 2> gradient = Eigen::Matrix<double, 3, 2>::Zero();
    for (int k = 0; k < 3; ++k)
      gradient += blended.row(coarse.rest.triangles(t, k)).head<3>().transpose() *
                  shape_gradients[static_cast<std::size_t>(t)].col(k).transpose();
    gradient.row(2) /= std::sqrt(2.);
    const Eigen::Matrix2d square = gradient.transpose() * gradient;
    result.change(t) =
      cell_side *
      std::sqrt(localization::principal_strain({square(0, 0), square(1, 1), 2. * square(0, 1)})
                  .largest()); // positive, both
  }
  return result;
}

double CoarseIndicators::round_off(const meshes::SpacePoints &positions) const
{
  constexpr double unit = 0.5 * std::numeric_limits<float>::epsilon();
  return 8. * unit * positions.cwiseAbs().maxCoeff() / smallest_height;
}

UpsampleRow CoarseIndicators::row_of(const Eigen::VectorXd &values, const double limit,
                                     const meshes::SpacePoints &positions) const
{
  UpsampleRow row;
  row.triangles      = coarse.n_triangles();
  const double total = areas.sum();
  row.mean           = areas.dot(values) / total;
  std::vector<int> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](const int a, const int b) { return values(a) < values(b); });
  double below = 0.;
  for (const int t : order)
  {
    below += areas(t);
    row.quantile = values(t);
    if (below >= 0.99 * total)
      break;
  }
  Eigen::Index worst        = 0;
  row.largest               = values.maxCoeff(&worst);
  row.worst                 = static_cast<int>(worst);
  Eigen::RowVector2d rest   = Eigen::RowVector2d::Zero();
  Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
  for (int k = 0; k < 3; ++k)
  {
    rest += coarse.rest.vertices.row(coarse.rest.triangles(worst, k)) / 3.;
    middle += positions.row(coarse.triangles(worst, k)) / 3.;
  }
  row.worst_rest_1 = rest(0);
  row.worst_rest_2 = rest(1);
  row.worst_x      = middle(0);
  row.worst_y      = middle(1);
  row.worst_z      = middle(2);
  row.limit        = limit;
  if (std::isfinite(limit))
  {
    const Eigen::Array<bool, Eigen::Dynamic, 1> is_beyond = values.array() > limit;
    row.beyond                                            = static_cast<int>(is_beyond.count());
    row.share_beyond = std::min(1., is_beyond.select(areas.array(), 0.).sum() / total);
  }
  return row;
}
} // namespace homespun::verification
