// SPDX-License-Identifier: MIT
#include "meshes/cloth/seams.h"
#include "tests/localization/fine_position.h"
#include "tests/localization/garment_cases.h"

#include <gtest/gtest.h>

#include <map>

using namespace homespun;
using namespace homespun::localization;
using tests::Garment;
using tests::Space;

TEST(invariant_garment, seams_stay_closed_to_round_off_whatever_the_motion)
{
  for (const Garment &garment : {tests::two_panels(), tests::skirt()})
  {
    int n_sewn = 0;
    for (int v = 0; v < garment.fine.n_vertices(); ++v)
      n_sewn += garment.fine.same_in_space(v) != v ? 1 : 0;
    EXPECT_GT(n_sewn, 40);
    for (unsigned seed = 0; seed < 5; ++seed)
    {
      const Space fine = garment.upsampled(tests::random_motion(garment.coarse, seed));
      EXPECT_LT(garment.seam_gap(fine), 1e-16);
    }
  }
}

TEST(invariant_garment, one_panel_sewn_to_itself_is_a_closed_tube)
{
  // 13 columns that do not fit the cells; the first and the last column of vertices are one in
  // space.
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
  EXPECT_LT(garment.seam_gap(garment.upsampled(tests::random_motion(tube, 8))), 1e-16);
}

TEST(tripwire_garment, without_the_fade_the_seams_gape)
{
  const Garment garment = tests::skirt();
  UpsamplerOptions options;
  options.seam_fade   = 0.;
  const Space current = tests::random_motion(garment.coarse, 1);
  EXPECT_GT(garment.seam_gap(garment.upsampled(current, options)), 1e-6);
}

TEST(exact_garment, the_fluctuation_fades_at_seams_and_not_at_free_edges)
{
  const Garment garment = tests::two_panels();
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
  const Garment garment       = tests::two_panels();
  const Space current         = tests::random_motion(garment.coarse, 2);
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
          return tests::fine_position<3>(frames, where.first, weights, chi, at_rest_vertices);
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
    const Eigen::Vector3d expected = tests::fine_position<3>(
      frames, garment.fine.coarse_triangle(v), garment.fine.coarse_weights.row(v).transpose(),
      tests::chi_at(garment, v), at_rest_vertices);
    EXPECT_LT((fine.row(v).transpose() - expected).norm(), 1e-16);
  }
}
