// SPDX-License-Identifier: MIT
// The ways through the data, aligned, halved and general, give the same positions.
#include "localization/upsampler.h"
#include "tests/localization/fine_position.h"
#include "tests/localization/localization_cases.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::localization;

TEST(invariant_upsampler, the_aligned_and_the_general_path_agree)
{
  const tests::Cloth cloth = tests::skewed_cloth();
  for (const Blend blend : {Blend::continuous, Blend::piecewise})
    for (const Lift lift : {Lift::rotation, Lift::affine, Lift::identity})
      for (const bool microscopic : {true, false})
      {
        UpsamplerOptions aligned;
        aligned.blend            = blend;
        aligned.lift             = lift;
        aligned.microscopic      = microscopic;
        UpsamplerOptions general = aligned;
        general.path             = Path::general;
        ASSERT_TRUE(
          (Upsampler<2, double>(cloth.cell, cloth.coarse, cloth.sheet, aligned).is_aligned()));
        ASSERT_FALSE(
          (Upsampler<2, double>(cloth.cell, cloth.coarse, cloth.sheet, general).is_aligned()));
        const auto plane = tests::wavy_motion<2>(cloth.coarse.vertices);
        const auto space = tests::wavy_motion<3>(cloth.coarse.vertices);
        EXPECT_LT(
          (tests::upsampled<2>(cloth, plane, aligned) - tests::upsampled<2>(cloth, plane, general))
            .cwiseAbs()
            .maxCoeff(),
          1e-16);
        EXPECT_LT(
          (tests::upsampled<3>(cloth, space, aligned) - tests::upsampled<3>(cloth, space, general))
            .cwiseAbs()
            .maxCoeff(),
          1e-16);
      }
}

// In the plane and in space, with vertices on the sides of the halved triangles and off them; with
// three quads per side of a cell nothing is shared.
TEST(invariant_upsampler, cells_that_a_coarse_mesh_cuts_move_as_on_the_general_path)
{
  for (const int r : {2, 3})
    for (const Blend blend : {Blend::continuous, Blend::piecewise})
      for (const bool microscopic : {true, false})
        for (const Lift lift : {Lift::rotation, Lift::affine, Lift::identity})
        {
          tests::Cloth cloth = tests::skewed_cloth();
          cloth.coarse = meshes::coarse_sheet(cloth.sheet.origin, cloth.sheet.lattice.vectors / r,
                                              r * cloth.sheet.n1, r * cloth.sheet.n2);
          UpsamplerOptions options;
          options.blend            = blend;
          options.microscopic      = microscopic;
          options.lift             = lift;
          UpsamplerOptions general = options;
          general.path             = Path::general;
          const auto plane         = tests::wavy_motion<2>(cloth.coarse.vertices);
          const auto space         = tests::wavy_motion<3>(cloth.coarse.vertices);
          EXPECT_LT((tests::upsampled<2>(cloth, plane, options) -
                     tests::upsampled<2>(cloth, plane, general))
                      .cwiseAbs()
                      .maxCoeff(),
                    1e-15)
            << r;
          EXPECT_LT((tests::upsampled<3>(cloth, space, options) -
                     tests::upsampled<3>(cloth, space, general))
                      .cwiseAbs()
                      .maxCoeff(),
                    1e-15)
            << r;
        }
}

TEST(invariant_upsampler, cells_whose_sides_are_halved_share_their_tables)
{
  tests::Cloth cloth = tests::skewed_cloth();
  cloth.coarse       = meshes::coarse_sheet(cloth.sheet.origin, cloth.sheet.lattice.vectors / 2,
                                            2 * cloth.sheet.n1, 2 * cloth.sheet.n2);
  UpsamplerOptions general;
  general.path = Path::general;
  EXPECT_LT((Upsampler<3>(cloth.cell, cloth.coarse, cloth.sheet).table_bytes()),
            (Upsampler<3>(cloth.cell, cloth.coarse, cloth.sheet, general).table_bytes()) / 2);
}

TEST(exact_upsampler, both_paths_compute_the_definition_point_by_point)
{
  const tests::Cloth cloth   = tests::skewed_cloth();
  const Positions<3> current = tests::wavy_motion<3>(cloth.coarse.vertices);
  const auto fine            = tests::upsampled<3>(cloth, current);
  const CoarseFrames<3> frames(cloth.coarse, {});
  const int n_blocks = cloth.sheet.n1 * cloth.sheet.n2 * cloth.sheet.n_per_cell;
  for (int v = 0; v < n_blocks; ++v)
  {
    const int cell   = v / cloth.sheet.n_per_cell;
    const bool below = v % cloth.sheet.n_per_cell < cloth.sheet.begin_of_eighth[4];
    const Eigen::RowVector2d f =
      cloth.sheet.lattice.fractional(cloth.sheet.mesh.vertices.row(v) - cloth.sheet.origin) -
      cloth.sheet.cell.row(v).cast<double>();
    const Eigen::Vector3d weights  = below ? Eigen::Vector3d(1. - f(0), f(0) - f(1), f(1))
                                           : Eigen::Vector3d(1. - f(1), f(0), f(1) - f(0));
    const Eigen::Vector3d expected = tests::fine_position<3>(
      frames, 2 * cell + !below, weights, cloth.cell.chi.row(cloth.sheet.cell_vertex(v)), current);
    EXPECT_LT((fine.row(v).transpose() - expected).norm(), 1e-16);
  }
}
