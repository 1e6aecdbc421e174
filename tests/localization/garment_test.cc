// SPDX-License-Identifier: MIT
#include "localization/garment/homespun.h"
#include "tests/localization/garment_cases.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::localization;
using tests::Garment;
using tests::Space;

TEST(exact_garment, without_modes_an_affine_motion_is_reproduced_at_every_fine_vertex)
{
  const tests::TwoPanels panels;
  const Garment garment = tests::two_panels();
  const auto F          = tests::some_stretch<3>();
  UpsamplerOptions options;
  options.microscopic  = false;
  const Space fine     = garment.upsampled(tests::affine_motion<3>(panels.flat, F), options);
  const Space expected = tests::affine_motion<3>(tests::flat_points(garment.fine), F);
  EXPECT_LT((fine - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(exact_garment, a_frame_that_folds_flat_on_itself_is_up_sampled_in_one_call)
{
  // Three columns of squares; folded along the third edge, the last ends within the one before.
  meshes::Points rest(8, 2);
  rest << 0., 0., 0.012, 0., 0.021, 0., 0.027, 0., 0., 0.01, 0.012, 0.01, 0.021, 0.01, 0.027, 0.01;
  meshes::Triangles F(6, 3);
  F << 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6;
  meshes::SpacePoints V(8, 3);
  V << rest, Eigen::VectorXd::Zero(8);
  for (const int v : {3, 7})
    V(v, 0) = 0.042 - V(v, 0);
  const auto cell = tests::smooth_cell(tests::skewed_lattice(), 7, 6);
  const auto fine = upsample(V, F, cell, rest).positions;
  EXPECT_TRUE(fine.allFinite());
  EXPECT_NEAR(fine.col(0).maxCoeff(), 0.021, 1e-4);
}

TEST(exact_garment, under_a_uniform_strain_each_panel_follows_the_closed_form_in_its_own_frame)
{
  const tests::TwoPanels panels;
  const Garment garment = tests::two_panels();
  const auto F          = tests::some_stretch<3>();
  for (const Lift lift : {Lift::rotation, Lift::affine})
  {
    UpsamplerOptions options;
    options.lift       = lift;
    const Space fine   = garment.upsampled(tests::affine_motion<3>(panels.flat, F), options);
    const Space affine = tests::affine_motion<3>(tests::flat_points(garment.fine), F);
    double largest     = 0.;
    int n_compared     = 0;
    for (int v = 0; v < garment.fine.n_vertices(); ++v)
    {
      if (garment.fine.seam_distance(v) < garment.fade())
        continue;
      // The cell's frame: the flat frame turned by the panel and by the grain.
      const int panel = garment.fine.panel(v);
      const Eigen::Matrix2d panel_turn =
        panel == 0 ? Eigen::Matrix2d::Identity().eval() : tests::turn(tests::TwoPanels::angle);
      const Eigen::Matrix2d cell_turn =
        garment.fine.grains[static_cast<std::size_t>(panel)].rotation();
      const Eigen::Matrix<double, 3, 2> F_cell = F * panel_turn.transpose() * cell_turn;
      const Frame<3> frame                     = tests::frame_by_svd<3>(F_cell);
      const Eigen::Matrix<double, 3, 2> L      = lift == Lift::rotation ? frame.lift : F_cell;
      const Eigen::Matrix<double, 1, 6> chi    = tests::chi_at(garment, v);
      Eigen::Vector2d w                        = Eigen::Vector2d::Zero();
      for (int a = 0; a < 3; ++a)
        w -= frame.strain(a) * chi.segment<2>(2 * a).transpose();
      const Eigen::RowVector3d expected = affine.row(v) + (L * w).transpose();
      EXPECT_LT((fine.row(v) - expected).norm(), 1e-15);
      largest = std::max(largest, w.norm());
      ++n_compared;
    }
    EXPECT_GT(largest, 1e-5); // far from nothing
    EXPECT_GT(n_compared, garment.fine.n_vertices() / 2);
  }
}

TEST(exact_garment, a_flat_sheet_without_seams_gives_the_positions_of_the_sheet)
{
  const tests::Cloth cloth       = tests::skewed_cloth();
  const meshes::ClothMesh placed = meshes::placed_sheet(
    cloth.coarse, Eigen::Matrix<double, 3, 2>::Identity(), Eigen::RowVector3d::Zero());
  meshes::FineClothOptions options;
  options.grains[0].origin = cloth.sheet.origin;
  const meshes::FineCloth fine =
    meshes::fine_cloth(cloth.cell.mesh, cloth.cell.lattice, placed, options);
  ASSERT_EQ(fine.n_vertices(), cloth.sheet.mesh.n_vertices());
  for (const auto &[lift, blend] :
       {std::pair(Lift::rotation, Blend::continuous), std::pair(Lift::affine, Blend::continuous),
        std::pair(Lift::rotation, Blend::piecewise)})
  {
    UpsamplerOptions choices;
    choices.lift        = lift;
    choices.blend       = blend;
    const Space current = tests::wavy_motion<3>(cloth.coarse.vertices);
    const Space sheet   = tests::upsampled<3>(cloth, current, choices);
    Space garment;
    Upsampler<3, double>(placed_garment(cloth.cell, placed, fine, choices))
      .upsample(current, garment);
    for (int v = 0; v < fine.n_vertices(); ++v)
    {
      int twin = 0;
      (cloth.sheet.mesh.vertices.rowwise() - fine.rest.vertices.row(v))
        .rowwise()
        .norm()
        .minCoeff(&twin);
      EXPECT_LT((garment.row(v) - sheet.row(twin)).norm(), 1e-15);
    }
  }
}

TEST(invariant_garment, a_rigid_motion_moves_the_fine_cloth_rigidly)
{
  const Garment garment = tests::skirt();
  const Space current = tests::random_motion(garment.coarse, 5), fine = garment.upsampled(current);
  for (const double angle : {0.4, 1.9, 3.1415926535897931})
  {
    const Eigen::Matrix3d R =
      Eigen::AngleAxisd(angle, Eigen::Vector3d(1., -2., 0.5).normalized()).toRotationMatrix();
    const Eigen::RowVector3d shift(0.3, -0.2, 0.9);
    const Space moved = garment.upsampled((current * R.transpose()).rowwise() + shift);
    EXPECT_LT((moved - ((fine * R.transpose()).rowwise() + shift)).cwiseAbs().maxCoeff(), 1e-14);
  }
  // From rest, where nothing is strained, the fine cloth is the coarse cloth.
  const Upsampler<3, double> upsampler(placed_garment(garment.cell, garment.coarse, garment.fine));
  UpsamplerOptions affine;
  affine.microscopic = false;
  EXPECT_LT((garment.upsampled(garment.coarse.positions) -
             garment.upsampled(garment.coarse.positions, affine))
              .cwiseAbs()
              .maxCoeff(),
            1e-12); // the skirt's file has 12 digits
}

TEST(invariant_garment, turning_a_panel_at_rest_together_with_its_grain_changes_nothing)
{
  const meshes::ClothMesh ring = tests::ring(0.021, 0.052, 23, {0.013, -0.008});
  meshes::ClothMesh turned     = ring;
  turned.rest.vertices         = (ring.rest.vertices * tests::turn(1.1).transpose()).eval();
  meshes::FineClothOptions straight, grain;
  straight.grains[0] = {{0.002, 0.001}, 0.2};
  grain.grains[0]    = {Eigen::RowVector2d(0.002, 0.001) * tests::turn(1.1).transpose(), 0.2 + 1.1};
  const Garment a(ring, straight), b(turned, grain);
  ASSERT_EQ(a.fine.n_vertices(), b.fine.n_vertices());
  const Space current       = tests::random_motion(ring, 3);
  const Space straight_fine = a.upsampled(current), turned_fine = b.upsampled(current);
  const meshes::Points turned_back = b.fine.rest.vertices * tests::turn(1.1);
  for (int v = 0; v < a.fine.n_vertices(); ++v)
  {
    int twin = 0; // the order may differ
    (turned_back.rowwise() - a.fine.rest.vertices.row(v)).rowwise().norm().minCoeff(&twin);
    EXPECT_LT((straight_fine.row(v) - turned_fine.row(twin)).norm(), 1e-14);
  }
}

TEST(bound_garment, float_and_double_agree_to_the_digits_of_a_float)
{
  const Garment garment = tests::skirt();
  const Space current   = tests::random_motion(garment.coarse, 4);
  const Upsampler<3> upsampler(placed_garment(garment.cell, garment.coarse, garment.fine));
  EXPECT_EQ(upsampler.n_fine(), garment.fine.n_vertices());
  EXPECT_EQ(upsampler.n_coarse(), 440);
  EXPECT_FALSE(upsampler.is_aligned());
  Upsampler<3>::Fine fine;
  upsampler.upsample(current, fine);
  // In halves of a last digit (2^-24 of the largest coordinate): one for the corners, one for each
  // of the four additions where no fused multiply-add is, and less than one for weights and chi.
  EXPECT_LT((fine.cast<double>() - garment.upsampled(current)).cwiseAbs().maxCoeff(),
            6. * std::ldexp(1., -24) * current.cwiseAbs().maxCoeff());
}

TEST(exact_garment, with_whole_triangles_only_every_vertex_still_follows_the_definition)
{
  meshes::FineClothOptions options;
  options.outline              = meshes::Outline::whole;
  options.grains[0]            = {{0.001, 0.002}, 0.3};
  const meshes::ClothMesh ring = tests::ring(0.021, 0.052, 23, {0.013, -0.008});
  const Garment whole(ring, options);
  options.outline = meshes::Outline::clipped;
  const Garment clipped(ring, options);
  const Space current = tests::random_motion(ring, 6), jagged = whole.upsampled(current),
              smooth = clipped.upsampled(current);
  int n_shared       = 0;
  for (int v = 0; v < whole.fine.n_vertices(); ++v)
  {
    int twin              = 0;
    const double distance = (clipped.fine.rest.vertices.rowwise() - whole.fine.rest.vertices.row(v))
                              .rowwise()
                              .norm()
                              .minCoeff(&twin);
    EXPECT_LT(distance, 1e-15);
    EXPECT_LT((jagged.row(v) - smooth.row(twin)).norm(), 1e-15);
    ++n_shared;
  }
  EXPECT_GT(n_shared, 500);
}
