// SPDX-License-Identifier: MIT
#include "localization/cell_modes.h"

#include "localization/coarse_frames.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/lattice.h"

#include <Eigen/Dense>

#include <algorithm>

namespace homespun::localization
{
Modes kind_of_modes(const UpsamplerOptions &options)
{
  if (!options.microscopic)
    return linear_modes;
  if (options.fitted != nullptr)
  {
    const auto &kinds = options.edge_kinds;
    return options.edges != nullptr &&
               std::find(kinds.begin(), kinds.end(), EdgeKind::free) != kinds.end()
             ? fitted_modes_and_free_edges
             : fitted_modes;
  }
  return options.second_order.empty() ? linear_modes : quadratic_modes;
}

CellModes cell_modes(const meshes::HomogenizedCell &cell, const UpsamplerOptions &options)
{
  if (!options.microscopic)
    return CellModes::Zero(cell.mesh.n_vertices(), 6);
  if (kind_of_modes(options) == linear_modes)
    return anchored(cell, options.anchor);
  CellModes modes(cell.mesh.n_vertices(), 18);
  modes.leftCols(6) = anchored(cell, options.anchor);
  if (are_fitted(kind_of_modes(options)))
    modes.rightCols(12) = anchored_fitted(cell, *options.fitted, options.anchor);
  else
  {
    modes.rightCols(12) = anchored_quadratic(cell, options.second_order, options.anchor);
    modes.middleCols(6, 6) *= 0.5; // of equal strains
  }
  return modes;
}

BentModes bent_modes(const meshes::HomogenizedCell &cell, const UpsamplerOptions &options)
{
  const Eigen::Index n = cell.mesh.n_vertices();
  BentModes modes      = BentModes::Zero(n, 9);
  if (!options.microscopic)
    return modes;
  modes.leftCols<3>()        = anchored_deflection(cell, options.anchor);
  const auto images          = meshes::match_images(cell.mesh.vertices, cell.lattice);
  const Eigen::VectorXd area = meshes::signed_areas(cell.mesh);
  BentModes sums             = BentModes::Zero(n, 9); // of slopes, and of areas in column 0
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
  {
    const auto corners = cell.mesh.triangles.row(t);
    Eigen::Matrix2d legs; // rows
    Eigen::Matrix<double, 2, 3> rises;
    for (int k = 0; k < 2; ++k)
    {
      legs.row(k)  = cell.mesh.vertices.row(corners(k + 1)) - cell.mesh.vertices.row(corners(0));
      rises.row(k) = modes.row(corners(k + 1)).head<3>() - modes.row(corners(0)).head<3>();
    }
    const Eigen::Matrix<double, 2, 3> slopes = legs.inverse() * rises;
    for (int k = 0; k < 3; ++k)
    {
      const int v = images.representative[static_cast<std::size_t>(corners(k))];
      sums(v, 0) += area(t);
      sums.row(v).tail<6>() += area(t) * Eigen::Map<const Eigen::RowVectorXd>(slopes.data(), 6);
    }
  }
  for (Eigen::Index v = 0; v < n; ++v)
  {
    const auto sum         = sums.row(images.representative[static_cast<std::size_t>(v)]);
    modes.row(v).tail<6>() = sum.tail<6>() / sum(0);
  }
  return modes;
}
} // namespace homespun::localization
