// SPDX-License-Identifier: MIT
#include "localization/upsampler.h"
#include "localization/vertex_normals.h"
#include "meshes/errors.h"
#include "meshes/obj_file.h"
#include "meshes/seams.h"
#include "tests/localization/localization_cases.h"
#include "tests/meshes/garments.h"

#include <gtest/gtest.h>

#include <limits>

using namespace homespun;
using namespace homespun::localization;

namespace
{
using Space = Positions<3>;

struct Garment
{
  meshes::HomogenizedCell cell;
  meshes::ClothMesh coarse;
  meshes::FineCloth fine;

  Garment(const meshes::ClothMesh &coarse, const meshes::FineClothOptions &options = {})
      : cell(tests::smooth_cell(tests::skewed_lattice(), 7, 6))
      , coarse(coarse)
      , fine(meshes::fine_cloth(cell.mesh, cell.lattice, coarse, options))
  {
  }

  Space upsampled(const Space &current, const UpsamplerOptions &options = {}) const
  {
    const Upsampler<3, double> upsampler(cell, coarse, fine, options);
    Space result;
    upsampler.upsample(current, result);
    return result;
  }

  double fade(const UpsamplerOptions &options = {}) const
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

Garment two_panels()
{
  meshes::FineClothOptions options;
  options.grains = {{{0.001, 0.}, 0.}, {{0.31, -0.2}, 0.3}};
  return {tests::TwoPanels().cloth, options};
}

Garment skirt()
{
  return {meshes::read_cloth(HOMESPUN_SOURCE_DIR "/meshes/scenes/skirt.obj")};
}

/// Random displacements of a fifth of a coarse edge.
Space random_motion(const meshes::ClothMesh &cloth, const unsigned seed)
{
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> random(-2e-3, 2e-3);
  Space current = cloth.positions;
  for (Eigen::Index k = 0; k < current.size(); ++k)
    current.data()[k] += random(generator);
  return current;
}

/// Where the fine vertices of two panels lie when these are flat and fit together.
meshes::Points flat_points(const meshes::FineCloth &fine)
{
  meshes::Points flat(fine.n_vertices(), 2);
  for (int v = 0; v < fine.n_vertices(); ++v)
    flat.row(v) = tests::TwoPanels::flat_of(fine.panel(v), fine.rest.vertices.row(v));
  return flat;
}

/// What chi is at a fine vertex, in its cell's frame.
Eigen::Matrix<double, 1, 6> chi_at(const Garment &garment, const int v)
{
  if (garment.fine.cell_vertex(v) >= 0)
    return garment.cell.chi.row(garment.fine.cell_vertex(v));
  Eigen::Matrix<double, 1, 6> chi = Eigen::Matrix<double, 1, 6>::Zero();
  for (int k = 0; k < 3; ++k)
    chi += garment.fine.cell_weights(v, k) *
           garment.cell.chi.row(garment.cell.mesh.triangles(garment.fine.cell_triangle(v), k));
  return chi;
}
} // namespace

TEST(exact_garment, without_modes_an_affine_motion_is_reproduced_at_every_fine_vertex)
{
  const tests::TwoPanels panels;
  const Garment garment = two_panels();
  const auto F          = tests::some_stretch<3>();
  UpsamplerOptions options;
  options.microscopic  = false;
  const Space fine     = garment.upsampled(tests::affine_motion<3>(panels.flat, F), options);
  const Space expected = tests::affine_motion<3>(flat_points(garment.fine), F);
  EXPECT_LT((fine - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(exact_garment, under_a_uniform_strain_each_panel_follows_the_closed_form_in_its_own_frame)
{
  const tests::TwoPanels panels;
  const Garment garment = two_panels();
  const auto F          = tests::some_stretch<3>();
  for (const Lift lift : {Lift::rotation, Lift::affine})
  {
    UpsamplerOptions options;
    options.lift       = lift;
    const Space fine   = garment.upsampled(tests::affine_motion<3>(panels.flat, F), options);
    const Space affine = tests::affine_motion<3>(flat_points(garment.fine), F);
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
      const Eigen::Matrix<double, 1, 6> chi    = chi_at(garment, v);
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
    Upsampler<3, double>(cloth.cell, placed, fine, choices).upsample(current, garment);
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
  const Garment garment = skirt();
  const Space current = random_motion(garment.coarse, 5), fine = garment.upsampled(current);
  for (const double angle : {0.4, 1.9, 3.1415926535897931})
  {
    const Eigen::Matrix3d R =
      Eigen::AngleAxisd(angle, Eigen::Vector3d(1., -2., 0.5).normalized()).toRotationMatrix();
    const Eigen::RowVector3d shift(0.3, -0.2, 0.9);
    const Space moved = garment.upsampled((current * R.transpose()).rowwise() + shift);
    EXPECT_LT((moved - ((fine * R.transpose()).rowwise() + shift)).cwiseAbs().maxCoeff(), 1e-14);
  }
  // From rest, where nothing is strained, the fine cloth is the coarse cloth.
  const Upsampler<3, double> upsampler(garment.cell, garment.coarse, garment.fine);
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
  const Space current       = random_motion(ring, 3);
  const Space straight_fine = a.upsampled(current), turned_fine = b.upsampled(current);
  const meshes::Points turned_back = b.fine.rest.vertices * tests::turn(1.1);
  for (int v = 0; v < a.fine.n_vertices(); ++v)
  {
    int twin = 0; // the order may differ
    (turned_back.rowwise() - a.fine.rest.vertices.row(v)).rowwise().norm().minCoeff(&twin);
    EXPECT_LT((straight_fine.row(v) - turned_fine.row(twin)).norm(), 1e-14);
  }
}

TEST(invariant_garment, seams_stay_closed_to_round_off_whatever_the_motion)
{
  for (const Garment &garment : {two_panels(), skirt()})
  {
    int n_sewn = 0;
    for (int v = 0; v < garment.fine.n_vertices(); ++v)
      n_sewn += garment.fine.same_in_space(v) != v ? 1 : 0;
    EXPECT_GT(n_sewn, 40);
    for (unsigned seed = 0; seed < 5; ++seed)
    {
      const Space fine = garment.upsampled(random_motion(garment.coarse, seed));
      EXPECT_LT(garment.seam_gap(fine), 1e-16);
    }
  }
}

TEST(invariant_garment, one_panel_sewn_to_itself_is_a_closed_tube)
{
  // 13 columns that do not fit the cells; the first and the last column of vertices are one in space.
  constexpr int columns = 13, rows = 4;
  const meshes::TriangleMesh flat = meshes::coarse_sheet(
    {0.001, 0.002}, Eigen::Vector2d(0.0091, 0.0087).asDiagonal(), columns, rows);
  meshes::ClothMesh tube;
  tube.rest = flat;
  tube.positions.resize(columns * (rows + 1), 3);
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i < columns; ++i)
    {
      const double angle = 2. * M_PI * i / columns;
      tube.positions.row(j * columns + i) << 0.019 * std::cos(angle), 0.019 * std::sin(angle),
        0.0087 * j;
    }
  tube.triangles = flat.triangles.unaryExpr(
    [](const int v) { return v / (columns + 1) * columns + v % (columns + 1) % columns; });
  const Garment garment(tube);
  EXPECT_EQ(meshes::seam_edges(tube).size(), 4u);
  EXPECT_EQ(tests::topology_of(garment.fine.rest.triangles).euler, 1);
  EXPECT_EQ(tests::topology_of(garment.fine.sewn_triangles()).euler, 0);
  EXPECT_LT(garment.seam_gap(garment.upsampled(random_motion(tube, 8))), 1e-16);
}

TEST(tripwire_garment, without_the_fade_the_seams_gape)
{
  const Garment garment = skirt();
  UpsamplerOptions options;
  options.seam_fade   = 0.;
  const Space current = random_motion(garment.coarse, 1);
  EXPECT_GT(garment.seam_gap(garment.upsampled(current, options)), 1e-6);
}

TEST(exact_garment, the_fluctuation_fades_at_seams_and_not_at_free_edges)
{
  const Garment garment = two_panels();
  const auto F          = tests::some_stretch<3>();
  const Space current   = tests::affine_motion<3>(tests::TwoPanels().flat, F);
  UpsamplerOptions affine, full;
  affine.microscopic = false;
  full.seam_fade     = 0.;
  const Space none = garment.upsampled(current, affine), all = garment.upsampled(current, full),
              some    = garment.upsampled(current);
  double at_free_edge = 0.;
  for (int v = 0; v < garment.fine.n_vertices(); ++v)
  {
    const double s    = std::min(garment.fine.seam_distance(v) / garment.fade(), 1.),
                 part = s * s * (3. - 2. * s);
    const double w = (some - none).row(v).norm(), whole = (all - none).row(v).norm();
    EXPECT_NEAR(w, part * whole, 1e-15);
    if (garment.fine.coarse_weights.row(v).minCoeff() == 0. && part == 1.)
      at_free_edge = std::max(at_free_edge, w);
  }
  EXPECT_GT(at_free_edge, 1e-5);
}

TEST(invariant_garment, positions_do_not_jump_across_coarse_edges)
{
  const Garment garment       = two_panels();
  const Space current         = random_motion(garment.coarse, 2);
  const Eigen::VectorXi space = meshes::space_of_rest(garment.coarse);
  Space at_rest_vertices(space.size(), 3);
  for (int v = 0; v < space.size(); ++v)
    at_rest_vertices.row(v) = current.row(space(v));
  const CoarseFrames<3> frames(garment.coarse.rest, {});
  const meshes::Triangles &triangles = garment.coarse.rest.triangles;
  std::map<std::array<int, 2>, std::pair<int, int>> sides;
  int n_compared = 0;
  for (int t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
      sides[{triangles(t, k), triangles(t, (k + 1) % 3)}] = {t, k};
  for (const auto &[ends, side] : sides)
    if (const auto other = sides.find({ends[1], ends[0]}); other != sides.end())
      for (const double part : {0.1, 0.5, 0.8})
      {
        const auto position = [&](const std::pair<int, int> &where, const double s)
        {
          Eigen::Vector3d weights               = Eigen::Vector3d::Zero();
          weights(where.second)                 = 1. - s;
          weights((where.second + 1) % 3)       = s;
          const Eigen::Matrix<double, 1, 6> chi = garment.cell.chi.row(17);
          return fine_position<3>(frames, where.first, weights, chi, at_rest_vertices);
        };
        EXPECT_LT((position(side, part) - position(other->second, 1. - part)).norm(), 1e-16);
        ++n_compared;
      }
  EXPECT_GT(n_compared, 100);

  // And the table holds that definition, chi turned with the grain, at every vertex.
  const Space fine = garment.upsampled(current);
  for (int v = 0; v < garment.fine.n_vertices(); ++v)
  {
    if (garment.fine.seam_distance(v) < garment.fade() || garment.fine.panel(v) != 0)
      continue;
    const Eigen::Vector3d expected = fine_position<3>(
      frames, garment.fine.coarse_triangle(v), garment.fine.coarse_weights.row(v).transpose(),
      chi_at(garment, v), at_rest_vertices);
    EXPECT_LT((fine.row(v).transpose() - expected).norm(), 1e-16);
  }
}

TEST(bound_garment, collapsed_coarse_triangles_give_finite_positions)
{
  const Garment garment = skirt();
  Space current         = garment.coarse.positions;
  current.row(41)       = current.row(40); // an edge without length
  current.row(85)       = 0.5 * (current.row(84) + current.row(86));
  current.row(200).setConstant(1e6);
  EXPECT_TRUE(garment.upsampled(current).allFinite());
  EXPECT_TRUE(garment.upsampled(Space::Zero(440, 3)).allFinite());
  current = garment.coarse.positions;
  current.col(2).setZero();
  current.col(1).setZero(); // a line
  EXPECT_TRUE(garment.upsampled(current).allFinite());
}

TEST(bound_garment, float_and_double_agree_to_the_digits_of_a_float)
{
  const Garment garment = skirt();
  const Space current   = random_motion(garment.coarse, 4);
  const Upsampler<3> upsampler(garment.cell, garment.coarse, garment.fine);
  EXPECT_EQ(upsampler.n_fine(), garment.fine.n_vertices());
  EXPECT_EQ(upsampler.n_coarse(), 440);
  EXPECT_FALSE(upsampler.is_aligned());
  Upsampler<3>::Fine fine;
  upsampler.upsample(current, fine);
  // In halves of a last digit (2^-24 of the largest coordinate): one for the corners, one for each of the
  // four additions where no fused multiply-add is, and less than one for weights and modes.
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
  const Space current = random_motion(ring, 6), jagged = whole.upsampled(current),
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

TEST(exact_vertex_normals, triangles_count_by_their_area_and_symmetry_makes_normals_radial)
{
  // In the planes z = 0 and y = 0, with the areas 1/2 and 1.
  const Space corners = (Space(4, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2).finished();
  const Space two     = vertex_normals<double>(corners, meshes::Triangles{{0, 1, 2}, {0, 3, 1}});
  EXPECT_LT((two.row(0) - Eigen::RowVector3d(0., 2., 1.) / std::sqrt(5.)).norm(), 1e-15);
  EXPECT_EQ(two.row(2), Eigen::RowVector3d(0., 0., 1.));
  EXPECT_EQ(two.row(3), Eigen::RowVector3d(0., 1., 0.));
  const Space flat = vertex_normals<double>(Space::Zero(3, 3), meshes::Triangles{{0, 1, 2}});
  EXPECT_EQ(flat.norm(), 0.);

  const meshes::Surface ball = meshes::read_surface(HOMESPUN_SOURCE_DIR "/meshes/scenes/ball.obj");
  const Space normals        = vertex_normals<double>(ball.positions, ball.triangles);
  for (int v = 0; v < 12; ++v) // corners of the icosahedron, with five triangles alike
    EXPECT_LT((normals.row(v) - ball.positions.row(v).normalized()).norm(), 1e-9);
  // In float the squares of small areas underflow; the direction must not.
  const auto tiny =
    vertex_normals<float>((1e-15 * ball.positions).cast<float>().eval(), ball.triangles);
  EXPECT_LT((tiny.cast<double>() - normals).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(tripwire_garment, faults_are_named)
{
  const Garment good = two_panels();
  const auto refusal = [](const Garment &garment, const UpsamplerOptions &options = {})
  {
    try
    {
      Upsampler<3>(garment.cell, garment.coarse, garment.fine, options);
      return std::string();
    }
    catch (const meshes::BadInput &fault)
    {
      return std::string(fault.what());
    }
  };
  const auto expect = [](const std::string &text, const std::string &part)
  { EXPECT_NE(text.find(part), std::string::npos) << text; };
  EXPECT_EQ(refusal(good), "");
  Garment bad = good;
  bad.coarse.rest.vertices.row(3) += Eigen::RowVector2d(1e-4, 0.);
  expect(refusal(bad), "at rest; expected none: it was made from another coarse cloth");
  bad                         = good;
  bad.fine.coarse_triangle(7) = 100;
  expect(refusal(bad), "vertex 7 lies in triangle 100 of panel 0; expected one of 100 triangles");
  bad                     = good;
  bad.fine.cell_vertex(7) = 56;
  expect(refusal(bad), "vertex 7 names vertex 56");
  bad = good;
  bad.fine.seam_distance.conservativeResize(3);
  expect(refusal(bad), "do not all have one entry");
  bad = good;
  bad.cell.lattice.vectors *= 1.01;
  expect(refusal(bad), "lattice vectors differ");
  bad                        = good;
  bad.coarse.triangles(0, 0) = 5;
  expect(refusal(bad), "coarse cloth: rest vertex");
  UpsamplerOptions options;
  options.seam_fade = 5.;
  expect(refusal(good, options), "fades over 5 cell sides at seams; expected 0 to 4");
  options.seam_fade = std::nan("");
  expect(refusal(good, options), "expected 0 to 4");

  const Upsampler<3> upsampler(good.cell, good.coarse, good.fine);
  Upsampler<3>::Fine fine;
  Space current      = good.coarse.positions;
  current(7, 1)      = std::numeric_limits<double>::infinity();
  const auto refused = [&](const Space &positions)
  {
    try
    {
      upsampler.upsample(positions, fine);
      return std::string();
    }
    catch (const meshes::BadInput &fault)
    {
      return std::string(fault.what());
    }
  };
  expect(refused(current), "coarse vertex 7: its position is not finite");
  expect(refused(Space::Zero(72, 3)), "have 72 rows; expected 66"); // 72 rest vertices, 66 in space
}
