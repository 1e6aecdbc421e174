// SPDX-License-Identifier: MIT
#include "verification/record/error_norms.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
ErrorNorms error_norms(const Eigen::VectorXd &distances)
{
  return {distances.mean(),
          std::sqrt(distances.squaredNorm() / static_cast<double>(distances.size())),
          distances.maxCoeff()};
}

std::pair<double, double> apart_from_edges(const Eigen::VectorXd &distances,
                                           const meshes::Sheet &sheet)
{
  Eigen::Vector2d sum = Eigen::Vector2d::Zero(), n = Eigen::Vector2d::Zero();
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d f = sheet.fraction(sheet.mesh.vertices.row(v));
    const auto is_in           = [](const double fraction, const int n_cells)
    { return std::min(fraction, 1. - fraction) * n_cells > 1. + 1e-6; };
    const int region = is_in(f(0), sheet.n1) && is_in(f(1), sheet.n2) ? 0 : 1;
    sum(region) += distances(v);
    n(region) += 1.;
  }
  return {n(0) > 0. ? sum(0) / n(0) : std::nan(""), sum(1) / n(1)};
}
} // namespace homespun::verification
