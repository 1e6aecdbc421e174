// SPDX-License-Identifier: MIT
// Curved surfaces with the deflection of the bent cell: both paths, single precision, panels.
#include "tests/localization/curved_cases.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::localization;

namespace
{
/// Slopes of the same by the same formulas, [a][c].
Eigen::Matrix<double, 3, 2> slopes_at(const meshes::Lattice &lattice,
                                      const Eigen::RowVector2d &point)
{
  const Eigen::RowVector2d f = 2. * M_PI * lattice.fractional(point);
  Eigen::Matrix<double, 3, 2> by_fraction;
  by_fraction << std::cos(f(0)), -std::cos(f(1)), std::sin(f(0) + f(1)), std::sin(f(0) + f(1)),
    std::cos(f(0) - f(1)), -std::cos(f(0) - f(1)) + 0.5 * std::cos(f(1));
  // d f / d x = (a1, a2)^-T
  return 0.02 * lattice.area() * 2. * M_PI * by_fraction * lattice.vectors.inverse().transpose();
}
} // namespace

// z = K11 w_1 + K22 w_2 + 2 K12 w_3 along the normal, and the slopes of it.
TEST(exact_bent_modes, a_bent_cell_deflects_by_its_modes_times_the_curvature)
{
  constexpr double angle = 0.6, large = 5.; // the sheet turns by less than a hundredth
  const double c = std::cos(angle), s = std::sin(angle);
  const Eigen::RowVector3d K = Eigen::RowVector3d(c * c, s * s, 2. * c * s) / large;
  const Shape shape          = cylinder(angle, large);
  double slope_error[2]      = {};
  for (const int level : {0, 1})
  {
    const tests::Cloth cloth(deflecting_cell(tests::skewed_lattice(), 12 * (1 + level)), 4, 3);
    const auto current        = moved(cloth.coarse.vertices, shape);
    const FineSurface without = curved(cloth, current, with(Surface::curved, false));
    for (const Path path : {Path::automatic, Path::general})
    {
      const FineSurface found = curved(cloth, current, with(Surface::curved, true, path));
      for (int v = 0; v < cloth.sheet.mesh.n_vertices(); ++v)
      {
        const BentPoint exact      = shape(cloth.sheet.mesh.vertices.row(v));
        const Eigen::RowVector3d w = cloth.cell.bending->deflection.row(cloth.sheet.cell_vertex(v));
        const double size          = K.norm() * 0.02 * cloth.cell.lattice.area();
        EXPECT_LT(
          (found.positions.row(v) - without.positions.row(v) - K.dot(w) * exact.normal).norm(),
          1e-4 * size);
        const Eigen::RowVector2d slope =
          K * slopes_at(cloth.cell.lattice, cloth.sheet.mesh.vertices.row(v) - cloth.sheet.origin);
        Eigen::RowVector3d tilt(slope(0), slope(1),
                                0.); // the tangents of such a sheet are its axes
        slope_error[level] = std::max(
          slope_error[level], (found.normals.row(v) - without.normals.row(v) + tilt).norm() /
                                (size / std::sqrt(cloth.cell.lattice.area())));
      }
    }
  }
  EXPECT_LT(slope_error[0], 0.15 * 2. * M_PI); // (2 pi / 12)²/6 = 0.05 for the longest waves
  EXPECT_NEAR(slope_error[0] / slope_error[1], 4., 0.7);
}

TEST(exact_bent_modes, both_paths_agree_also_where_a_coarse_mesh_halves_the_cells)
{
  tests::Cloth cloth(deflecting_cell(tests::skewed_lattice(), 8), 3, 4);
  for (const int quads : {1, 2})
  {
    cloth.coarse = meshes::coarse_sheet(cloth.sheet.origin, cloth.sheet.lattice.vectors / quads,
                                        3 * quads, 4 * quads);
    const Positions<3> current = tests::wavy_motion<3>(cloth.coarse.vertices);
    const FineSurface aligned  = curved(cloth, current, with(Surface::curved, true)),
                      general  = curved(cloth, current, with(Surface::curved, true, Path::general));
    EXPECT_LT((aligned.positions - general.positions).cwiseAbs().maxCoeff(), 1e-16);
    EXPECT_LT((aligned.normals - general.normals).cwiseAbs().maxCoeff(), 1e-11);
  }
}

TEST(exact_bent_modes, single_precision_gives_the_same_to_its_rounding)
{
  const tests::Cloth cloth(deflecting_cell(tests::skewed_lattice(), 8), 5, 4);
  const Positions<3> current = tests::wavy_motion<3>(cloth.coarse.vertices);
  const auto options         = with(Surface::curved, true);
  const FineSurface exact    = curved(cloth, current, options);
  const Upsampler<3, float> upsampler(cloth.cell, cloth.coarse, cloth.sheet, options);
  Upsampler<3, float>::Fine positions, normals;
  upsampler.upsample(current, positions, normals);
  // Sixteen roundings.
  EXPECT_LT((positions.cast<double>() - exact.positions).cwiseAbs().maxCoeff(),
            16. * 6e-8 * exact.positions.cwiseAbs().maxCoeff());
  EXPECT_LT((normals.cast<double>() - exact.normals).cwiseAbs().maxCoeff(), 3e-6);
  EXPECT_LT((normals.cast<double>().rowwise().norm().array() - 1.).abs().maxCoeff(), 1.2e-6);
}

TEST(invariant_bent_modes, what_is_missing_is_named)
{
  const tests::Cloth cloth = tests::skewed_cloth();
  EXPECT_NE(tests::refusal([&]() { curved(cloth, {}, with(Surface::curved, true)); })
              .find("has no deflection of a bent sheet"),
            std::string::npos);
  EXPECT_NE(tests::refusal([&]() { curved(cloth, {}, with(Surface::flat, true)); })
              .find("normals: the surface is that of flat triangles"),
            std::string::npos);
}

// Of panels that lie in frames of their own: a bent sheet cut in two is the bent sheet.
TEST(exact_bent_modes, panels_bend_like_the_sheet_that_they_are_of_and_seams_stay_closed)
{
  tests::Garment garment           = tests::two_panels();
  garment.cell.bending             = deflecting_cell(garment.cell.lattice, 7).bending;
  garment.cell.bending->deflection = meshes::Deflection::Zero(garment.cell.mesh.n_vertices(), 3);
  garment.cell.chi.setZero();
  const meshes::Points flat  = tests::flat_points(garment.fine);
  const Shape shape          = cylinder(0.4, 0.5);
  const Positions<3> current = moved(tests::TwoPanels().flat, shape);
  UpsamplerOptions options   = with(Surface::curved, true);
  const Positions<3> found   = garment.upsampled(current, options),
                     facets  = garment.upsampled(current);
  double of_found = 0., of_facets = 0.;
  for (int v = 0; v < garment.fine.n_vertices(); ++v)
  {
    const Eigen::RowVector3d exact = shape(flat.row(v)).position;
    if (garment.fine.seam_distance(v) < 0.012) // a coarse triangle
      continue;
    of_found  = std::max(of_found, (found.row(v) - exact).norm());
    of_facets = std::max(of_facets, (facets.row(v) - exact).norm());
  }
  EXPECT_GT(of_facets, 1e-5); // H²/8 R = 2.5e-5
  EXPECT_LT(of_found, 0.02 * of_facets);
  for (unsigned seed = 0; seed < 3; ++seed)
    EXPECT_LT(
      garment.seam_gap(garment.upsampled(tests::random_motion(garment.coarse, seed), options)),
      1e-16);
}
