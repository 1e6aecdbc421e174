// SPDX-License-Identifier: MIT
// Garments that the localization tests share, their motions and chi at their fine vertices.
#pragma once

#include "localization/garment/placed_garment.h"
#include "meshes/files/obj_file.h"
#include "tests/localization/localization_cases.h"
#include "tests/meshes/garment/garments.h"

#include <random>

namespace homespun::tests
{
using Space = localization::Positions<3>;

/// A coarse cloth with its fine cloth, of a cell with a smooth chi.
struct Garment
{
  meshes::HomogenizedCell cell;
  meshes::ClothMesh coarse;
  meshes::FineCloth fine;

  Garment(const meshes::ClothMesh &coarse, const meshes::FineClothOptions &options = {})
      : cell(smooth_cell(skewed_lattice(), 7, 6))
      , coarse(coarse)
      , fine(meshes::fine_cloth(cell.mesh, cell.lattice, coarse, options))
  {
  }

  Space upsampled(const Space &current, const localization::UpsamplerOptions &options = {}) const
  {
    const localization::Upsampler<3, double> upsampler(
      localization::placed_garment(cell, coarse, fine, options));
    Space result;
    upsampler.upsample(current, result);
    return result;
  }

  double fade(const localization::UpsamplerOptions &options = {}) const
  {
    return options.seam_fade * std::sqrt(cell.lattice.area());
  }

  /// Largest distance between vertices that a seam sews together.
  double seam_gap(const Space &positions) const
  {
    double gap = 0.;
    for (int v = 0; v < fine.n_vertices(); ++v)
      gap = std::max(gap, (positions.row(v) - positions.row(fine.same_in_space(v))).norm());
    return gap;
  }
};

inline Garment two_panels()
{
  meshes::FineClothOptions options;
  options.grains = {{{0.001, 0.}, 0.}, {{0.31, -0.2}, 0.3}};
  return {TwoPanels().cloth, options};
}

inline Garment skirt()
{
  return {meshes::read_cloth(HOMESPUN_SOURCE_DIR "/meshes/scenes/skirt.obj")};
}

/// Random displacements of a fifth of a coarse edge.
inline Space random_motion(const meshes::ClothMesh &cloth, const unsigned seed)
{
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> random(-2e-3, 2e-3);
  Space current = cloth.positions;
  for (Eigen::Index k = 0; k < current.size(); ++k)
    current.data()[k] += random(generator);
  return current;
}

/// Where the fine vertices of two panels lie when these are flat and fit together.
inline meshes::Points flat_points(const meshes::FineCloth &fine)
{
  meshes::Points flat(fine.n_vertices(), 2);
  for (int v = 0; v < fine.n_vertices(); ++v)
    flat.row(v) = TwoPanels::flat_of(fine.panel(v), fine.rest.vertices.row(v));
  return flat;
}

/// chi at a fine vertex, in its cell's frame.
inline Eigen::Matrix<double, 1, 6> chi_at(const Garment &garment, const int v)
{
  if (garment.fine.cell_vertex(v) >= 0)
    return garment.cell.chi.row(garment.fine.cell_vertex(v));
  Eigen::Matrix<double, 1, 6> chi = Eigen::Matrix<double, 1, 6>::Zero();
  for (int k = 0; k < 3; ++k)
    chi += garment.fine.cell_weights(v, k) *
           garment.cell.chi.row(garment.cell.mesh.triangles(garment.fine.cell_triangle(v), k));
  return chi;
}
} // namespace homespun::tests
