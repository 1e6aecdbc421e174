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
/// chi of a cell that is turned against the rest frame: w = Q w_cell(Q^T E Q).
Eigen::Matrix<double, 6, 6> turned_chi(const Eigen::Matrix2d &Q)
{
  Eigen::Matrix<double, 6, 6> map = Eigen::Matrix<double, 6, 6>::Zero(); // chi row times map
  for (int b = 0; b < 3; ++b)
  {
    Eigen::Matrix2d strain = Eigen::Matrix2d::Zero();
    if (b < 2)
      strain(b, b) = 1.;
    else
      strain(0, 1) = strain(1, 0) = 0.5;
    const Eigen::Matrix2d in_cell = Q.transpose() * strain * Q;
    const Eigen::Vector3d voigt(in_cell(0, 0), in_cell(1, 1), 2. * in_cell(0, 1));
    for (int a = 0; a < 3; ++a)
      map.block<2, 2>(2 * a, 2 * b) = voigt(a) * Q.transpose();
  }
  return map;
}

/// Grows from 0 at 0 to 1 at 1, with slope zero at both.
double smooth_step(const double s)
{
  const double t = std::clamp(s, 0., 1.);
  return t * t * (3. - 2. * t);
}

/// chi at the fine vertices in the rest frames of their panels, column 2 a + c [m].
/// @param chi of the cell (n_cell,6) [m]
/// @param fade distance from a seam over which chi grows from zero to its full size [m]
meshes::Chi chi_of_garment(const meshes::HomogenizedCell &cell, const meshes::Chi &chi,
                           const meshes::FineCloth &fine, const double fade)
{
  std::vector<Eigen::Matrix<double, 6, 6>> turned; // chi row times map, of each panel
  for (const meshes::Grain &grain : fine.grains)
    turned.push_back(turned_chi(grain.rotation()));
  meshes::Chi result(fine.n_vertices(), 6);
  for (int v = 0; v < fine.n_vertices(); ++v)
  {
    Eigen::Matrix<double, 1, 6> here = Eigen::Matrix<double, 1, 6>::Zero();
    if (fine.cell_vertex(v) >= 0)
      here = chi.row(fine.cell_vertex(v));
    else
      for (int k = 0; k < 3; ++k)
        here += fine.cell_weights(v, k) * chi.row(cell.mesh.triangles(fine.cell_triangle(v), k));
    const auto panel = static_cast<std::size_t>(fine.panel(v));
    if (fine.grains[panel].angle != 0.)
      here = (here * turned[panel]).eval();
    if (const double distance = fine.seam_distance(v); distance < fade)
      here *= smooth_step(distance / fade);
    result.row(v) = here;
  }
  return result;
}
} // namespace

PlacedVertices placed_garment(const meshes::HomogenizedCell &cell, const meshes::ClothMesh &coarse,
                              const meshes::FineCloth &fine, const UpsamplerOptions &options)
{
  if (const auto faults = garment_faults(cell, coarse, fine, options); !faults.empty())
    throw meshes::BadInput(faults);
  PlacedVertices placed;
  placed.options       = options;
  placed.coarse_rest   = coarse.rest;
  placed.space_of_rest = meshes::space_of_rest(coarse);
  placed.n_space       = coarse.n_vertices();
  placed.triangle      = fine.coarse_triangle;
  placed.weights       = fine.coarse_weights;
  placed.chi           = options.microscopic
                           ? chi_of_garment(cell, anchored(cell, options.anchor), fine,
                                            options.seam_fade * std::sqrt(cell.lattice.area()))
                           : meshes::Chi::Zero(fine.n_vertices(), 6);
  return placed;
}
} // namespace homespun::localization
