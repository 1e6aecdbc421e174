// SPDX-License-Identifier: MIT
#include "localization/garment/placed_garment.h"

#include "localization/garment/garment_faults.h"
#include "localization/garment/garment_panels.h"
#include "meshes/cloth/seams.h"
#include "meshes/plain/errors.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace homespun::localization
{
namespace
{
/// A fine vertex in its panel.
PanelPoint point_of(const meshes::HomogenizedCell &cell, const meshes::TriangleMesh &coarse,
                    const Panel &panel, const meshes::FineCloth &fine, const int v)
{
  const Eigen::Vector3i of_coarse = coarse.triangles.row(fine.coarse_triangle(v));
  Eigen::RowVector2d place = Eigen::RowVector2d::Zero(), middle = place;
  for (int k = 0; k < 3; ++k)
  {
    place += fine.coarse_weights(v, k) * coarse.vertices.row(of_coarse(k));
    middle += coarse.vertices.row(of_coarse(k)) / 3.;
  }
  PanelPoint result = {cell.lattice.fractional(place - panel.zero),
                       cell.lattice.fractional(place + 1e-3 * (middle - place) - panel.zero),
                       {},
                       {1., 0., 0.}};
  result.corners.fill(fine.cell_vertex(v));
  if (fine.cell_vertex(v) < 0)
  {
    result.weights = fine.cell_weights.row(v);
    for (int k = 0; k < 3; ++k)
      result.corners[static_cast<std::size_t>(k)] = cell.mesh.triangles(fine.cell_triangle(v), k);
  }
  return result;
}

/// Rows of the cell's vertices at a place.
template <typename Row, typename Rows>
Row at_place(const Rows &of_cell, const PanelPoint &place)
{
  Row here = place.weights(0) * of_cell.row(place.corners[0]);
  for (std::size_t k = 1; k < 3; ++k)
    here += place.weights(static_cast<Eigen::Index>(k)) * of_cell.row(place.corners[k]);
  return here;
}

/// By what the modes of a fine vertex fade towards seams.
double fade_at(const meshes::HomogenizedCell &cell, const meshes::FineCloth &fine, const int v,
               const UpsamplerOptions &options)
{
  const double fade = options.seam_fade * std::sqrt(cell.lattice.area());
  return fine.seam_distance(v) < fade ? smooth_step(fine.seam_distance(v) / fade) : 1.;
}

/// A panel without edges on lattice lines is as without edges: its cell is held where it was.
UpsamplerOptions without_edges(UpsamplerOptions options)
{
  if (options.edges != nullptr && options.microscopic)
    options.anchor = Anchor::lattice;
  return options;
}

/// Modes of the bent cell at the fine vertices.
BentModes bent_modes_of_garment(const meshes::HomogenizedCell &cell, const meshes::FineCloth &fine,
                                const std::vector<Panel> &panels, const PlacedVertices &placed)
{
  const BentModes with_edges = bent_modes(cell, placed.options),
                  without    = bent_modes(cell, without_edges(placed.options));
  BentModes result(fine.n_vertices(), 9);
  for (int v = 0; v < fine.n_vertices(); ++v)
  {
    const Panel &panel       = panels[static_cast<std::size_t>(fine.panel(v))];
    const BentModes &of_cell = panel.edges.empty() ? without : with_edges;
    result.row(v)            = fade_at(cell, fine, v, placed.options) *
                    at_place<Eigen::Matrix<double, 1, 9>>(
                      of_cell, point_of(cell, placed.coarse_rest, panel, fine, v));
  }
  return result;
}

/// Modes at the fine vertices.
/// @param placed all but these
CellModes modes_of_garment(const meshes::HomogenizedCell &cell, const meshes::FineCloth &fine,
                           const std::vector<Panel> &panels, const PlacedVertices &placed)
{
  const UpsamplerOptions &options = placed.options;
  const EdgeModes near_edges(cell, options);
  const CellModes with_edges = cell_modes(cell, options),
                  without    = cell_modes(cell, without_edges(options));
  CellModes result;
  for (int v = 0; v < fine.n_vertices(); ++v)
  {
    const Panel &panel       = panels[static_cast<std::size_t>(fine.panel(v))];
    const CellModes &of_cell = panel.edges.empty() ? without : with_edges;
    const PanelPoint place   = point_of(cell, placed.coarse_rest, panel, fine, v);
    const ModesRow here      = fade_at(cell, fine, v, options) *
                          near_edges.added_to(at_place<ModesRow>(of_cell, place), panel, place);
    if (v == 0)
      result.resize(fine.n_vertices(), here.size());
    result.row(v) = here;
  }
  return result;
}

/// Slip that keeps seams closed: what is sewn together moves by the mean of its panels, and not
/// where one of them has none.
EdgeSlip sewn(EdgeSlip slip, const std::vector<int> &space_of_rest)
{
  std::map<int, std::vector<int>> copies; // of a vertex in space
  for (std::size_t v = 0; v < space_of_rest.size(); ++v)
    copies[space_of_rest[v]].push_back(static_cast<int>(v));
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto &[space, rest] : copies)
    if (std::all_of(rest.begin(), rest.end(),
                    [&](const int v) { return slip.of_sources.row(v).nonZeros() > 0; }))
      for (const int v : rest)
        for (const int other : rest)
          entries.emplace_back(v, other, 1. / static_cast<double>(rest.size()));
  const Eigen::Index n = slip.of_sources.rows();
  Eigen::SparseMatrix<double, Eigen::RowMajor> mean(n, n);
  mean.setFromTriplets(entries.begin(), entries.end());
  slip.of_sources = (mean * slip.of_sources).eval();
  return slip;
}
} // namespace

PlacedVertices placed_garment(const meshes::HomogenizedCell &cell, const meshes::ClothMesh &coarse,
                              const meshes::FineCloth &fine, const UpsamplerOptions &options)
{
  if (const auto faults = garment_faults(cell, coarse, fine, options); !faults.empty())
    throw meshes::BadInput(faults);
  PlacedVertices placed;
  placed.options       = options;
  placed.coarse_rest   = in_frames_of_cells(coarse, fine.grains);
  const auto panels    = garment_panels(coarse, fine);
  placed.space_of_rest = meshes::space_of_rest(coarse);
  placed.n_space       = coarse.n_vertices();
  placed.triangle      = fine.coarse_triangle;
  placed.weights       = fine.coarse_weights;
  placed.modes         = modes_of_garment(cell, fine, panels, placed);
  if (options.surface == Surface::curved)
    placed.bent = bent_modes_of_garment(cell, fine, panels, placed);
  if (options.slip == Slip::added)
    placed.slip = sewn(EdgeModes(cell, options).slip_of(panels, placed.coarse_rest),
                       {placed.space_of_rest.begin(), placed.space_of_rest.end()});
  return placed;
}
} // namespace homespun::localization
