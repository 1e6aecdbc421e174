// SPDX-License-Identifier: MIT
#include "localization/edge_modes.h"

#include "meshes/plain/point_location.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace homespun::localization
{
namespace
{
std::vector<int> images_across(const meshes::HomogenizedCell &cell, const int axis)
{
  const meshes::ImageClasses images = meshes::match_images(cell.mesh.vertices, cell.lattice);
  const int n                       = cell.mesh.n_vertices();
  const Eigen::RowVector2d origin   = cell.mesh.vertices.row(cell.anchor);
  const auto is_high                = [&](const int v)
  { return cell.lattice.fractional(cell.mesh.vertices.row(v) - origin)(axis) > 0.5; };
  std::vector<std::array<int, 2>> ends(static_cast<std::size_t>(n), {-1, -1});
  std::vector<int> across(static_cast<std::size_t>(n));
  for (int v = 0; v < n; ++v)
    ends[static_cast<std::size_t>(images.representative[static_cast<std::size_t>(v)])][is_high(v)] =
      v;
  for (int v = 0; v < n; ++v)
  {
    const auto &of_class =
      ends[static_cast<std::size_t>(images.representative[static_cast<std::size_t>(v)])];
    const int other                     = of_class[is_high(v) ? 0 : 1];
    across[static_cast<std::size_t>(v)] = other < 0 ? v : other;
  }
  return across;
}
} // namespace

EdgeModes::EdgeModes(const meshes::HomogenizedCell &cell, const meshes::Sheet &sheet,
                     const UpsamplerOptions &options)
    : cell(cell)
    , sheet(sheet)
    , edges(options.edges)
    , kinds(options.edge_kinds)
{
  for (std::size_t axis = 0; are_there() && axis < 2; ++axis)
    across[axis] = images_across(cell, static_cast<int>(axis));
}

EdgeModes::Depths EdgeModes::depths(const int i, const int j) const
{
  Depths result;
  for (int side = 0; side < meshes::CellEdges::n_sides; ++side)
  {
    const auto s    = static_cast<std::size_t>(side);
    const int axis  = meshes::axis_of_side(side);
    const int depth = meshes::is_far_side(side) ? (axis == 0 ? sheet.n1 - 1 - i : sheet.n2 - 1 - j)
                                                : (axis == 0 ? i : j);
    const bool is_reached =
      are_there() && kinds[s] != EdgeKind::none && depth >= 0 && depth < edges->sides[s].n_cells;
    result[s] = is_reached ? depth : -1;
  }
  return result;
}

EdgeModes::Row EdgeModes::at(const int vertex, const EdgeKind kind) const
{
  const Eigen::RowVector2d fraction = sheet.fraction(sheet.mesh.vertices.row(vertex)),
                           origin   = cell.mesh.vertices.row(cell.anchor);
  // In which cell, and as which vertex of it: one on a line between two cells is taken as the lower
  // end of the upper one, but on the last line. Either of the two has the same modes.
  std::array<int, 2> place, image;
  for (int axis = 0; axis < 2; ++axis)
  {
    const int n        = axis == 0 ? sheet.n1 : sheet.n2;
    const double along = fraction(axis) * n;
    const int of_cell  = std::clamp(static_cast<int>(std::floor(along + 1e-6)), 0, n - 1);
    int found          = sheet.cell_vertex(vertex);
    const double f     = cell.lattice.fractional(cell.mesh.vertices.row(found) - origin)(axis);
    if (std::abs(f - (along - of_cell)) > 0.5)
      found = across[static_cast<std::size_t>(axis)][static_cast<std::size_t>(found)];
    place[static_cast<std::size_t>(axis)] = of_cell;
    image[static_cast<std::size_t>(axis)] = found;
  }
  const Depths depth = depths(place[0], place[1]);
  Row sum            = Row::Zero();
  for (std::size_t side = 0; side < depth.size(); ++side)
    if (depth[side] >= 0 && kinds[side] == kind)
    {
      const meshes::CellEdge &edge   = edges->sides[side];
      const meshes::EdgeModes &modes = kinds[side] == EdgeKind::clamped ? edge.clamped : edge.free;
      sum += modes.row(static_cast<Eigen::Index>(depth[side]) * cell.mesh.n_vertices() +
                       image[side / 2]);
    }
  return sum;
}

EdgeSlip EdgeModes::slip_of(const meshes::TriangleMesh &coarse) const
{
  constexpr double nothing = 1e-12;
  EdgeSlip slip;
  if (!are_there() || std::find(kinds.begin(), kinds.end(), EdgeKind::clamped) == kinds.end())
    return slip;
  const meshes::PointLocation location(coarse);
  std::map<std::pair<int, std::size_t>, int> source_of; // of a vertex at an edge
  std::vector<Eigen::Triplet<double>> entries;
  for (int v = 0; v < coarse.n_vertices(); ++v)
  {
    const Eigen::RowVector2d fraction =
      sheet.fraction(coarse.vertices.row(v)).cwiseMax(0.).cwiseMin(1.);
    std::array<double, meshes::CellEdges::n_sides> weight = {};
    for (std::size_t side = 0; side < kinds.size(); ++side)
      if (kinds[side] == EdgeKind::clamped)
      {
        const double along = fraction(meshes::axis_of_side(static_cast<int>(side)));
        weight[side] =
          1. / std::max(meshes::is_far_side(static_cast<int>(side)) ? 1. - along : along, nothing);
      }
    const double sum = std::accumulate(weight.begin(), weight.end(), 0.);
    for (std::size_t side = 0; side < kinds.size(); ++side)
    {
      if (kinds[side] != EdgeKind::clamped)
        continue;
      Eigen::RowVector2d opposite = fraction;
      opposite(meshes::axis_of_side(static_cast<int>(side))) =
        meshes::is_far_side(static_cast<int>(side)) ? 1. : 0.;
      const meshes::Location at =
        location.locate(sheet.origin + opposite * sheet.sides(), Eigen::RowVector2d::Zero());
      for (int k = 0; at.triangle >= 0 && k < 3; ++k)
        if (std::abs(at.weights(k)) > 1e-9)
        {
          const int vertex = coarse.triangles(at.triangle, k);
          const auto [found, is_new] =
            source_of.try_emplace({vertex, side}, static_cast<int>(slip.sources.size()));
          if (is_new)
            slip.sources.push_back({vertex, edges->sides[side].slip});
          entries.emplace_back(v, found->second, weight[side] / sum * at.weights(k));
        }
    }
  }
  slip.of_sources.resize(coarse.n_vertices(), static_cast<Eigen::Index>(slip.sources.size()));
  slip.of_sources.setFromTriplets(entries.begin(), entries.end());
  return slip;
}

std::vector<std::string> edge_faults(const meshes::HomogenizedCell &cell,
                                     const UpsamplerOptions &options)
{
  std::vector<std::string> faults;
  if (options.edges == nullptr || !options.microscopic)
    return faults;
  if (options.anchor != Anchor::mean)
    faults.emplace_back("up-sampling: terms of edges are asked for with chi anchored at the "
                        "lattice points; expected Anchor::mean, whose missing term they are");
  if (options.slip == Slip::added && options.blend != Blend::continuous)
    faults.emplace_back(
      "up-sampling: slip of clamped edges is added with Blend::piecewise; expected "
      "Blend::continuous, whose strains at vertices it follows");
  for (std::size_t side = 0; side < options.edge_kinds.size(); ++side)
  {
    const meshes::CellEdge &edge = options.edges->sides[side];
    const Eigen::Index rows      = static_cast<Eigen::Index>(edge.n_cells) * cell.mesh.n_vertices();
    if (options.edge_kinds[side] != EdgeKind::none &&
        (edge.clamped.rows() != rows || edge.free.rows() != rows))
      faults.push_back("up-sampling: edge " + std::to_string(side) + " has modes of " +
                       std::to_string(edge.clamped.rows()) + " and " +
                       std::to_string(edge.free.rows()) + " rows; expected " +
                       std::to_string(rows) + ", one per vertex of " +
                       std::to_string(edge.n_cells) + " cells: they are those of another cell");
  }
  return faults;
}
} // namespace homespun::localization
