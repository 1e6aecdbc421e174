// SPDX-License-Identifier: MIT
#include "localization/garment/placed_garment.h"

#include "localization/garment/garment_faults.h"
#include "meshes/cloth/seams.h"
#include "meshes/plain/errors.h"

#include <algorithm>
#include <cmath>

namespace homespun::localization
{
namespace
{
/// Grows from 0 at 0 to 1 at 1, with slope zero at both.
double smooth_step(const double s)
{
  const double t = std::clamp(s, 0., 1.);
  return t * t * (3. - 2. * t);
}

/// Modes at the fine vertices.
/// @param of_cell its modes
/// @param fade distance from a seam over which they grow from zero to their full size [m]
CellModes modes_of_garment(const meshes::HomogenizedCell &cell, const CellModes &of_cell,
                           const meshes::FineCloth &fine, const double fade)
{
  CellModes result(fine.n_vertices(), of_cell.cols());
  for (int v = 0; v < fine.n_vertices(); ++v)
  {
    auto here = result.row(v);
    if (fine.cell_vertex(v) >= 0)
      here = of_cell.row(fine.cell_vertex(v));
    else
    {
      here.setZero();
      for (int k = 0; k < 3; ++k)
        here +=
          fine.cell_weights(v, k) * of_cell.row(cell.mesh.triangles(fine.cell_triangle(v), k));
    }
    if (const double distance = fine.seam_distance(v); distance < fade)
      here *= smooth_step(distance / fade);
  }
  return result;
}

/// The panels at rest, each turned into the frame of its cells.
meshes::TriangleMesh in_frames_of_cells(const meshes::ClothMesh &coarse,
                                        const std::vector<meshes::Grain> &grains)
{
  meshes::TriangleMesh rest   = coarse.rest;
  const Eigen::VectorXi panel = meshes::panels_of(coarse).of_vertex;
  for (int v = 0; v < rest.n_vertices(); ++v)
    if (const int p = panel(v); p >= 0 && grains[static_cast<std::size_t>(p)].angle != 0.)
      rest.vertices.row(v) =
        (rest.vertices.row(v) * grains[static_cast<std::size_t>(p)].rotation()).eval();
  return rest;
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
  placed.space_of_rest = meshes::space_of_rest(coarse);
  placed.n_space       = coarse.n_vertices();
  placed.triangle      = fine.coarse_triangle;
  placed.weights       = fine.coarse_weights;
  placed.modes         = modes_of_garment(cell, cell_modes(cell, options), fine,
                                          options.seam_fade * std::sqrt(cell.lattice.area()));
  return placed;
}
} // namespace homespun::localization
