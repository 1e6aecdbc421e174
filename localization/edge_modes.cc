// SPDX-License-Identifier: MIT
#include "localization/edge_modes.h"

#include "meshes/plain/point_location.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace homespun::localization
{
namespace
{
std::vector<int> images_across(const meshes::HomogenizedCell &cell, const meshes::Points &in_cell,
                               const int axis)
{
  const meshes::ImageClasses images = meshes::match_images(cell.mesh.vertices, cell.lattice);
  const auto is_high                = [&](const int v) { return in_cell(v, axis) > 0.5; };
  std::vector<std::array<int, 2>> ends(static_cast<std::size_t>(in_cell.rows()), {-1, -1});
  std::vector<int> across(ends.size());
  for (int v = 0; v < in_cell.rows(); ++v)
    ends[static_cast<std::size_t>(images.representative[static_cast<std::size_t>(v)])][is_high(v)] =
      v;
  for (int v = 0; v < in_cell.rows(); ++v)
  {
    const auto &of_class =
      ends[static_cast<std::size_t>(images.representative[static_cast<std::size_t>(v)])];
    const int other                     = of_class[is_high(v) ? 0 : 1];
    across[static_cast<std::size_t>(v)] = other < 0 ? v : other;
  }
  return across;
}
} // namespace

double smooth_step(const double s)
{
  const double t = std::clamp(s, 0., 1.);
  return t * t * (3. - 2. * t);
}

EdgeModes::EdgeModes(const meshes::HomogenizedCell &cell, const UpsamplerOptions &options)
    : cell(cell)
    , edges(options.edges)
    , kinds(options.edge_kinds)
    , fade(options.seam_fade)
    , free_are_apart(kind_of_modes(options) == fitted_modes_and_free_edges)
    , in_cell(cell.mesh.n_vertices(), 2)
{
  if (!options.microscopic)
    edges = nullptr;
  for (int v = 0; v < in_cell.rows(); ++v)
    in_cell.row(v) =
      cell.lattice.fractional(cell.mesh.vertices.row(v) - cell.mesh.vertices.row(cell.anchor));
  for (std::size_t axis = 0; are_there() && axis < 2; ++axis)
    across[axis] = images_across(cell, in_cell, static_cast<int>(axis));
}

int EdgeModes::reached(const PanelEdge &edge, const int of_cell) const
{
  const auto side = static_cast<std::size_t>(edge.side);
  const int depth = edge.depth_of_cell(of_cell);
  return are_there() && kinds[side] != EdgeKind::none && depth >= 0 &&
             depth < edges->sides[side].n_cells
           ? depth
           : -1;
}

std::vector<int> EdgeModes::depths(const Panel &sheet, const int i, const int j) const
{
  std::vector<int> result;
  for (const PanelEdge &edge : sheet.edges)
    result.push_back(reached(edge, edge.axis() == 0 ? i : j));
  return result;
}

double EdgeModes::part_at(const Panel &panel, const PanelEdge &edge, const PanelPoint &place) const
{
  const int other    = 1 - edge.axis();
  const double depth = edge.depth(place.inside), along = place.inside(other);
  if (depth < 0. || along < edge.ends[0] || along > edge.ends[1])
    return 0.;
  for (const auto &[from, to] : panel.outline)
    if ((from(other) <= along) != (to(other) <= along))
    {
      const double between = (along - from(other)) / (to(other) - from(other)),
                   in_way  = edge.depth(from + between * (to - from));
      if (in_way > 1e-5 && in_way < depth) // the edge itself may be a little off its line
        return 0.;
    }
  double part = 1.;
  for (std::size_t end = 0; end < 2; ++end)
    if (!edge.is_corner[end] && fade > 0.)
      part *= smooth_step(std::abs(place.point(other) - edge.ends[end]) / fade);
  return part;
}

EdgeModes::Row EdgeModes::at(const Panel &panel, const PanelPoint &place, const EdgeKind kind) const
{
  Row sum = Row::Zero();
  for (const PanelEdge &edge : panel.edges)
  {
    const auto side = static_cast<std::size_t>(edge.side);
    const int axis  = edge.axis();
    if (!are_there() || kinds[side] != kind ||
        edge.depth(place.point) > edges->sides[side].n_cells + 0.5)
      continue;
    const double part = part_at(panel, edge, place);
    if (part == 0.)
      continue;
    const meshes::EdgeModes &modes =
      kind == EdgeKind::clamped ? edges->sides[side].clamped : edges->sides[side].free;
    double in_its_cell = 0.;
    for (int k = 0; k < 3; ++k)
      in_its_cell += place.weights(k) * in_cell(place.corners[static_cast<std::size_t>(k)], axis);
    // A vertex on a line between two cells is taken as the lower end of the upper one, but on the
    // last line. Either of the two has the same modes.
    const int last = meshes::is_far_side(edge.side)
                       ? edge.line - 1
                       : static_cast<int>(std::ceil(panel.high(axis) - 1e-6)) - 1;
    for (int k = 0; k < 3; ++k)
    {
      int corner         = place.corners[static_cast<std::size_t>(k)];
      const double along = std::round(place.point(axis) - in_its_cell) + in_cell(corner, axis);
      const int of_cell  = std::min(static_cast<int>(std::floor(along + 1e-6)), last);
      if (std::abs(in_cell(corner, axis) - (along - of_cell)) > 0.5)
        corner = across[static_cast<std::size_t>(axis)][static_cast<std::size_t>(corner)];
      if (const int depth = reached(edge, of_cell); depth >= 0 && place.weights(k) != 0.)
        sum += part * place.weights(k) *
               modes.row(static_cast<Eigen::Index>(depth) * cell.mesh.n_vertices() + corner);
    }
  }
  return sum;
}

ModesRow EdgeModes::added_to(const ModesRow &of_cell, const Panel &panel,
                             const PanelPoint &place) const
{
  ModesRow row(of_cell.size() + (free_are_apart ? 6 : 0));
  row.head(of_cell.size()) = of_cell;
  row.head<6>() -= at(panel, place, EdgeKind::clamped);
  if (free_are_apart)
    row.tail<6>() = -at(panel, place, EdgeKind::free);
  else
    row.head<6>() -= at(panel, place, EdgeKind::free);
  return row;
}

EdgeSlip EdgeModes::slip_of(const std::vector<Panel> &panels,
                            const meshes::TriangleMesh &coarse) const
{
  constexpr double off_line = 1e-6, on_line = 1e-12; // of a vertex at an edge, as it is drawn
  EdgeSlip slip;
  std::map<std::pair<int, int>, int> source_of; // of a vertex at an edge and its side
  std::vector<Eigen::Triplet<double>> entries;
  for (const Panel &panel : panels)
  {
    std::vector<PanelEdge> clamped;
    for (const PanelEdge &edge : panel.edges)
      if (are_there() && kinds[static_cast<std::size_t>(edge.side)] == EdgeKind::clamped)
        clamped.push_back(edge);
    if (clamped.empty())
      continue;
    const meshes::PointLocation location(coarse, panel.triangles);
    std::set<int> vertices;
    for (const int t : panel.triangles)
      for (const int v : coarse.triangles.row(t))
        vertices.insert(v);
    for (const int v : vertices)
    {
      const Eigen::RowVector2d point = cell.lattice.fractional(coarse.vertices.row(v) - panel.zero)
                                         .cwiseMax(panel.low)
                                         .cwiseMin(panel.high);
      std::vector<double> weight;
      std::vector<meshes::Location> at; // opposite the vertex
      for (const PanelEdge &edge : clamped)
      {
        const int axis              = edge.axis();
        Eigen::RowVector2d opposite = point;
        opposite(axis)              = edge.line;
        opposite(1 - axis)          = std::clamp(point(1 - axis), edge.ends[0], edge.ends[1]);
        const double distance = (opposite - point).cwiseQuotient(panel.high - panel.low).norm();
        weight.push_back(1. / (distance > off_line ? distance : on_line));
        const auto locate = [&]() {
          return location.locate(panel.zero + opposite * cell.lattice.vectors, {0., 0.});
        };
        at.push_back(locate());
        if (at.back().triangle < 0) // the edge is drawn a little off its line
        {
          opposite(axis) += meshes::is_far_side(edge.side) ? -1e-5 : 1e-5;
          at.back() = locate();
        }
      }
      const double sum = std::accumulate(weight.begin(), weight.end(), 0.);
      for (std::size_t k = 0; k < clamped.size(); ++k)
        for (int c = 0; at[k].triangle >= 0 && c < 3; ++c)
          if (std::abs(at[k].weights(c)) > 1e-9)
          {
            const int vertex = coarse.triangles(at[k].triangle, c), side = clamped[k].side;
            const auto [found, is_new] =
              source_of.try_emplace({vertex, side}, static_cast<int>(slip.sources.size()));
            if (is_new)
              slip.sources.push_back({vertex, edges->sides[static_cast<std::size_t>(side)].slip});
            entries.emplace_back(v, found->second, weight[k] / sum * at[k].weights(c));
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
