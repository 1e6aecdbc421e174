// SPDX-License-Identifier: MIT
// A cell over somebody else's cloth: bits of the up-sampler, and indicators in closed form.
#include "meshes/cloth/seams.h"
#include "meshes/files/surface_files.h"
#include "meshes/files/write_whole.h"
#include "tests/localization/edge_cases.h"
#include "tests/refusal.h"
#include "verification/upsample/coarse_indicators.h"
#include "verification/upsample/frame_files.h"
#include "verification/upsample/upsampled_cloth.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

namespace homespun::verification
{
namespace
{
namespace fs = std::filesystem;
using meshes::ClothMesh;
using meshes::SpacePoints;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

ClothMesh flat(const meshes::TriangleMesh &rest)
{
  ClothMesh cloth;
  cloth.rest      = rest;
  cloth.triangles = rest.triangles;
  cloth.positions.setZero(rest.n_vertices(), 3);
  cloth.positions.leftCols<2>() = rest.vertices;
  return cloth;
}

/// A square sheet of n x n cells of this side, with its corner at a place.
ClothMesh square_sheet(const int n, const double side, const Eigen::RowVector2d &corner)
{
  meshes::TriangleMesh rest =
    meshes::coarse_sheet(corner, side * Eigen::Matrix2d::Identity(), n, n);
  rest.material.setZero(rest.n_triangles());
  return flat(rest);
}

/// x = (X + a X²/2, Y + b Y², 0): E11 = a X, E22 = 2 b Y at the middles of edges.
SpacePoints bent_in_plane(const ClothMesh &cloth, const double a, const double b)
{
  SpacePoints x = cloth.positions;
  for (Eigen::Index v = 0; v < x.rows(); ++v)
  {
    const double X = x(v, 0), Y = x(v, 1);
    x(v, 0) = X + 0.5 * a * X * X;
    x(v, 1) = Y + b * Y * Y;
  }
  return x;
}

class Folder : public testing::Test
{
protected:
  void SetUp() override
  {
    path = testing::TempDir() + "homespun-upsample-XXXXXX";
    ASSERT_NE(mkdtemp(path.data()), nullptr);
  }
  void TearDown() override
  {
    fs::remove_all(path);
  }
  std::string path;
};
using tripwire_frame_files = Folder;
using exact_frame_files    = Folder;
} // namespace

TEST(exact_upsampled_cloth, a_sheet_of_whole_cells_has_the_bits_of_the_up_sampler)
{
  const tests::Cloth own = tests::skewed_cloth();
  // The user's sheet begins two cells away from a lattice point that is given.
  meshes::Grain grain;
  grain.origin              = {0.3, -0.2};
  meshes::TriangleMesh rest = own.coarse;
  rest.vertices.rowwise() +=
    grain.origin + Eigen::RowVector2d(2., -1.) * own.cell.lattice.vectors - own.sheet.origin;
  rest.material.setZero(rest.n_triangles());
  const UpsampledCloth cloth(own.cell, flat(rest), grain);
  EXPECT_NE(cloth.description.find("a sheet of 4 x 3 cells"), std::string::npos);
  EXPECT_TRUE(cloth.upsampler->is_aligned());
  EXPECT_EQ(cloth.triangles, own.sheet.mesh.triangles);
  EXPECT_EQ(cloth.look.material, own.sheet.mesh.material);

  const localization::Upsampler<3, float> direct(own.cell, own.coarse, own.sheet);
  Eigen::Matrix<double, 3, 2> F;
  F << 1.05, 0.02, -0.01, 0.97, 0.1, 0.2;
  for (const localization::Positions<3> &x : {tests::affine_motion<3>(own.coarse.vertices, F),
                                              tests::wavy_motion<3>(own.coarse.vertices)})
  {
    meshes::FloatPoints one, other;
    cloth.upsampler->upsample(x, one);
    direct.upsample(x, other);
    EXPECT_EQ(one, other);
  }
}

TEST(exact_upsampled_cloth, whole_cells_in_triangles_of_ones_own_are_up_sampled_as_the_sheet)
{
  tests::Cloth own          = tests::skewed_cloth(); // 4 x 3 cells
  own.cell.edges            = tests::edges_of(own.cell);
  const meshes::Grain grain = {own.sheet.origin, 0.};
  meshes::TriangleMesh rest = meshes::coarse_sheet(
    own.sheet.origin, Eigen::Vector2d(4. / 5., 3. / 7.).asDiagonal() * own.cell.lattice.vectors, 5,
    7);
  rest.material.setZero(rest.n_triangles());
  for (int v = 0; v < rest.n_vertices(); ++v)
  {
    const Eigen::RowVector2d at = own.sheet.fraction(rest.vertices.row(v));
    const bool is_inside        = (at.array() > 0.01).all() && (at.array() < 0.99).all();
    // Digits of files on the outline, another place inside.
    rest.vertices.row(v) += Eigen::RowVector2d(std::sin(7. * v), std::cos(5. * v)) *
                            (is_inside ? 0.1 : 0.6e-6) * std::sqrt(own.cell.lattice.area());
  }
  meshes::TriangleMesh ordered = own.coarse;
  ordered.material.setZero(ordered.n_triangles());
  const localization::GivenCloth given = {{"bottom", "top"}, localization::Slip::added, {}};
  const localization::Method method("localized+edges");
  const UpsampledCloth in_order(own.cell, flat(ordered), grain, method, given),
    cloth(own.cell, flat(rest), grain, method, given);
  EXPECT_EQ(cloth.description, "1 panel, 70 coarse triangles, cells cut along outlines");
  EXPECT_EQ(cloth.method.left_out, "");
  Eigen::Matrix<double, 3, 2> F; // strain is the same in all triangles of both
  F << 1.05, 0.02, -0.01, 0.97, 0.1, 0.2;
  meshes::FloatPoints at_rest, ordered_at_rest, one, other;
  cloth.upsampler->upsample(flat(rest).positions, at_rest);
  in_order.upsampler->upsample(flat(ordered).positions, ordered_at_rest);
  cloth.upsampler->upsample(tests::affine_motion<3>(rest.vertices, F), one);
  in_order.upsampler->upsample(tests::affine_motion<3>(own.coarse.vertices, F), other);
  // Cells are cut where coarse vertices lie: those of the sheet are among the vertices.
  const double tolerance = 1e-6 * std::sqrt(own.cell.lattice.area()) + 0x1p-22;
  for (Eigen::Index v = 0; v < other.rows(); ++v)
  {
    Eigen::Index same = 0;
    EXPECT_LT((at_rest.rowwise() - ordered_at_rest.row(v)).rowwise().norm().minCoeff(&same),
              tolerance);
    EXPECT_LT((one.row(same) - other.row(v)).cwiseAbs().maxCoeff(), tolerance) << v;
  }
}

TEST(exact_upsampled_cloth, every_fine_vertex_lies_in_its_coarse_triangle)
{
  const tests::Cloth own    = tests::skewed_cloth();
  meshes::TriangleMesh rest = own.coarse;
  rest.material.setZero(rest.n_triangles());
  const UpsampledCloth whole(own.cell, flat(rest), {own.sheet.origin, 0.});
  const UpsampledCloth turned(own.cell, flat(rest), {own.sheet.origin, 0.3});
  EXPECT_FALSE(turned.upsampler->is_aligned());
  EXPECT_NE(turned.description.find("1 panel, 24 coarse triangles"), std::string::npos);
  for (const UpsampledCloth *cloth : {&whole, &turned})
  {
    // At rest fine vertices are where the coarse cloth is.
    meshes::FloatPoints fine;
    cloth->upsampler->upsample(flat(rest).positions, fine);
    ASSERT_EQ(cloth->coarse_triangle.size(), fine.rows());
    for (Eigen::Index v = 0; v < fine.rows(); ++v)
    {
      const int t = cloth->coarse_triangle(v);
      Eigen::Matrix3d corners;
      for (int k = 0; k < 3; ++k)
        corners.col(k) << rest.vertices.row(rest.triangles(t, k)).transpose(), 1.;
      const Eigen::Vector3d weights =
        corners.inverse() * Eigen::Vector3d(fine(v, 0), fine(v, 1), 1.);
      EXPECT_GT(weights.minCoeff(), -1e-4) << v;
    }
  }
}

TEST(invariant_upsampled_cloth, a_rigid_motion_moves_the_fine_cloth_rigidly)
{
  const tests::Cloth own    = tests::skewed_cloth();
  meshes::TriangleMesh rest = own.coarse;
  rest.material.setZero(rest.n_triangles());
  const Eigen::Matrix3d R =
    Eigen::AngleAxisd(2., Eigen::Vector3d(1., -2., 0.5).normalized()).toRotationMatrix();
  const Eigen::RowVector3d to(0.3, -0.1, 0.2);
  for (const double angle : {0., 0.4})
  {
    const UpsampledCloth cloth(own.cell, flat(rest), {own.sheet.origin, angle});
    meshes::FloatPoints at_rest, moved;
    cloth.upsampler->upsample(flat(rest).positions, at_rest);
    const SpacePoints x = (flat(rest).positions * R.transpose()).rowwise() + to;
    cloth.upsampler->upsample(x, moved);
    const SpacePoints expected = (at_rest.cast<double>() * R.transpose()).rowwise() + to;
    // Single precision of numbers below 1: some units in the last place.
    EXPECT_LT((moved.cast<double>() - expected).cwiseAbs().maxCoeff(), 4. * 0x1p-24) << angle;
    const CoarseIndicators indicators(cloth.coarse, 0.01);
    const TriangleIndicators values = indicators.of(x);
    for (const Eigen::VectorXd *one : {&values.strain, &values.change, &values.compression})
      EXPECT_LT(one->maxCoeff(), 1e-12);
    EXPECT_EQ(*indicators.row_of(values.compression, indicators.round_off(x), x).beyond, 0);
  }
}

TEST(exact_coarse_indicators, a_uniform_strain_is_told_in_every_triangle)
{
  const ClothMesh cloth = square_sheet(4, 0.01, {0., 0.});
  const CoarseIndicators indicators(cloth, 0.01);
  // Stretches 1.03 and 0.98 along axes that are turned by 0.7, then anywhere in space.
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.7).toRotationMatrix();
  const Eigen::Matrix2d U    = turn * Eigen::Vector2d(1.03, 0.98).asDiagonal() * turn.transpose();
  const Eigen::Matrix3d R =
    Eigen::AngleAxisd(1., Eigen::Vector3d(0.2, 1., 0.4).normalized()).toRotationMatrix();
  const SpacePoints x             = cloth.rest.vertices * (R.leftCols<2>() * U).transpose();
  const TriangleIndicators values = indicators.of(x);
  EXPECT_LT((values.strain.array() - 0.03).abs().maxCoeff(), 1e-13);
  EXPECT_LT((values.compression.array() - 0.02).abs().maxCoeff(), 1e-13);
  EXPECT_LT(values.change.maxCoeff(), 1e-13);

  const UpsampleRow row = indicators.row_of(values.strain, 0.02, x);
  EXPECT_NEAR(row.mean, 0.03, 1e-13);
  EXPECT_EQ(row.triangles, 32);
  EXPECT_EQ(*row.beyond, 32);
  EXPECT_NEAR(row.share_beyond, 1., 1e-14);
  EXPECT_EQ(*indicators.row_of(values.strain, 0.04, x).beyond, 0);
  EXPECT_FALSE(indicators.row_of(values.strain, nothing, x).beyond.has_value());
}

TEST(exact_coarse_indicators, a_linear_strain_changes_by_its_slope_times_the_cell_side)
{
  const int n       = 8;
  const double side = 0.01, a = 2., b = 0.05;
  const ClothMesh cloth = square_sheet(n, side, {0., 0.});
  const CoarseIndicators indicators(cloth, side);
  const SpacePoints x             = bent_in_plane(cloth, a, b);
  const TriangleIndicators values = indicators.of(x);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < 2; ++k)
      {
        const int t = 2 * (j * n + i) + k;
        // The strain of a triangle is that in the middle of its edges along the axes.
        const double E11 = a * (i + 0.5) * side, E22 = 2. * b * (j + 0.5) * side;
        EXPECT_GT(E11, E22);
        EXPECT_NEAR(values.strain(t), E11, 1e-13);
        // grad E has the columns (a, 0, 0) and (0, 2 b, 0); the larger one decides. On the outline
        // the average at the vertices knows one side alone.
        if (i > 0 && i < n - 1 && j > 0 && j < n - 1)
          EXPECT_NEAR(values.change(t), side * a, 1e-12);
        else // a third in the corner of two triangles
          EXPECT_GT(values.change(t), (1. / 3. - 1e-9) * side * a);
      }
  EXPECT_EQ(values.compression.maxCoeff(), 0.);

  const UpsampleRow row = indicators.row_of(values.strain, a * 5. * side, x);
  EXPECT_NEAR(row.largest, a * 7.5 * side, 1e-13);
  EXPECT_NEAR(row.quantile, a * 7.5 * side, 1e-13); // the last column is more than 1 %
  EXPECT_NEAR(row.mean, a * 4. * side, 1e-13);
  EXPECT_NEAR(row.worst_rest_1, 7.5 * side, 0.2 * side);
  EXPECT_NEAR(row.worst_x, row.worst_rest_1 + a * 0.5 * row.worst_rest_1 * row.worst_rest_1,
              1e-2 * side);
  EXPECT_EQ(*row.beyond, 3 * 2 * n); // the columns 5, 6 and 7
  EXPECT_NEAR(row.share_beyond, 3. / n, 1e-13);
}

TEST(exact_coarse_indicators, the_gradient_of_shear_counts_as_that_of_a_tensor)
{
  // x = X + s (Y²/2, 0): F12 = s Y at middles of edges, gamma12 = s Y to second order.
  const int n       = 6;
  const double side = 0.01, s = 1e-5;
  const ClothMesh cloth = square_sheet(n, side, {0., 0.});
  SpacePoints x         = cloth.positions;
  x.col(0).array() += 0.5 * s * x.col(1).array().square();
  const TriangleIndicators values = CoarseIndicators(cloth, side).of(x);
  const int inside                = 2 * (2 * n + 3);
  EXPECT_NEAR(values.change(inside) / (side * s / std::sqrt(2.)), 1., 1e-5);
  EXPECT_NEAR(values.strain(inside) / (0.5 * s * 2.5 * side), 1., 1e-5);
}

TEST(exact_coarse_indicators, the_quantile_goes_by_area)
{
  // Two triangles, one with 99.5 % of the area: the other one does not count.
  meshes::TriangleMesh rest;
  rest.vertices.resize(4, 2);
  rest.vertices << 0., 0., 1., 0., 0., 1., 1. + 1. / 199., 0.;
  rest.triangles.resize(2, 3);
  rest.triangles << 0, 1, 2, 1, 3, 2;
  rest.material.setZero(2);
  const ClothMesh cloth = flat(rest);
  const CoarseIndicators indicators(cloth, 1.);
  const Eigen::Vector2d values(1., 100.);
  const UpsampleRow row = indicators.row_of(values, nothing, cloth.positions);
  EXPECT_EQ(row.quantile, 1.);
  EXPECT_EQ(row.largest, 100.);
  EXPECT_EQ(row.worst, 1);
  EXPECT_NEAR(row.mean, 0.995 * 1. + 0.005 * 100., 1e-12);
}

TEST_F(exact_frame_files, a_pattern_gives_files_in_the_order_of_their_numbers)
{
  for (const char *name : {"f_10.obj", "f_2.obj", "f_002b.obj", "f_1.obj", "other.ply"})
    meshes::write_whole(path + "/" + name, "");
  std::string names;
  for (const FrameFile &frame : frames_of({path + "/f_*.obj", path + "/other.ply"}))
    names += frame.name + " ";
  EXPECT_EQ(names, "f_1 f_2 f_002b f_10 other ");
}

TEST_F(tripwire_frame_files, patterns_without_files_and_two_of_a_name_are_refused)
{
  meshes::write_whole(path + "/a.obj", "");
  meshes::write_whole(path + "/a.ply", "");
  EXPECT_NE(tests::refusal([&]() { frames_of({path + "/*.stl"}); })
              .find("*.stl: no file fits this pattern"),
            std::string::npos);
  EXPECT_NE(tests::refusal([&]() { frames_of({path + "/a.*"}); })
              .find("a.ply: has the name of " + path + "/a.obj"),
            std::string::npos);
}

TEST_F(tripwire_frame_files, a_frame_of_another_mesh_is_refused_with_both)
{
  const meshes::Polygons rest = {SpacePoints::Zero(4, 3), {{0, 1, 2, -1}, {0, 2, 3, -1}}, {}};
  EXPECT_EQ(fault_of_frame(rest, "a", rest, "rest.obj"), "");
  meshes::Polygons more = rest, fewer = rest, other = rest;
  more.positions.setZero(5, 3);
  fewer.faces.pop_back();
  other.faces[1] = {0, 3, 2, -1};
  EXPECT_EQ(fault_of_frame(more, "a.ply", rest, "rest.obj"),
            "a.ply: has 5 vertices; expected 4, those of rest.obj: export all frames from the one "
            "mesh that rest.obj is");
  EXPECT_NE(fault_of_frame(fewer, "a", rest, "rest.obj").find("a: has 1 faces; expected 2"),
            std::string::npos);
  EXPECT_NE(fault_of_frame(other, "a", rest, "rest.obj")
              .find("a: face 1 has the vertices 0 3 2 (from 0); expected 0 2 3"),
            std::string::npos);
}
} // namespace homespun::verification
