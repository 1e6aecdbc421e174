// SPDX-License-Identifier: MIT
// Waves of known length on sheets, in every direction and on every mesh, and what is none.
#include "shell/terms/short_waves.h"

#include "meshes/cloth/irregular_sheet.h"
#include "tests/shell/terms/plate_cases.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <string>

using namespace homespun;
using meshes::SpacePoints;
using shell::ShortWaves;

namespace
{
constexpr int n_sides     = 24; // along the sheet
constexpr double side     = 1. / n_sides;
constexpr double no_waves = std::numeric_limits<double>::infinity();

meshes::ClothMesh sheet(const std::string &kind)
{
  return tests::lying(tests::plate_mesh(kind, n_sides));
}

/// Coordinates along a direction and across it, from the middle of the sheet.
Eigen::MatrixX2d turned(const meshes::ClothMesh &mesh, const double direction)
{
  return (mesh.rest.vertices.rowwise() - Eigen::RowVector2d(0.5, 0.5)) *
         Eigen::Rotation2Dd(direction).toRotationMatrix();
}

/// A sine whose height is a tenth of its length, in sides.
SpacePoints sine(const meshes::ClothMesh &mesh, const double length, const double direction)
{
  SpacePoints x              = mesh.positions;
  const Eigen::MatrixX2d own = turned(mesh, direction);
  x.col(2) =
    0.1 * length * side * (2. * M_PI / (length * side) * own.col(0).array() + 0.7).sin().matrix();
  return x;
}

/// Bent to a radius, in sides, within a width, straight beside it.
SpacePoints rolled(const meshes::ClothMesh &mesh, const double radius, const double width,
                   const double direction)
{
  SpacePoints x              = mesh.positions;
  const Eigen::MatrixX2d own = turned(mesh, direction);
  for (Eigen::Index v = 0; v < x.rows(); ++v)
  {
    const double R = radius * side, s = own(v, 0), most = 0.5 * width * side,
                 bent = std::clamp(s, -most, most), angle = bent / R;
    x.row(v) << R * std::sin(angle) + (s - bent) * std::cos(angle), own(v, 1),
      R * (1. - std::cos(angle)) + (s - bent) * std::sin(angle);
  }
  return x;
}
} // namespace

TEST(exact_short_waves, sines_below_eight_sides_are_measured_and_longer_ones_are_none)
{
  for (const std::string &kind : tests::plate_meshes)
  {
    const meshes::ClothMesh mesh = sheet(kind);
    const ShortWaves waves(mesh);
    EXPECT_NEAR(waves.side(), side, 1e-12);
    for (const double direction : {0., 0.3, 0.25 * M_PI, 1.2, 2.2})
    {
      for (const double length : {4., 5., 6., 7.})
        EXPECT_NEAR(waves.shortest(sine(mesh, length, direction)), length, 0.8)
          << kind << ", " << direction;
      EXPECT_LT(waves.shortest(sine(mesh, 2.5, direction)), 4.) << kind << ", " << direction;
      for (const double length : {9., 10., 12., 16.})
        EXPECT_EQ(waves.shortest(sine(mesh, length, direction)), no_waves)
          << kind << ", " << direction << ", " << length;
    }
  }
}

TEST(tripwire_short_waves, what_is_flat_rolled_folded_or_twisted_has_none)
{
  for (const std::string &kind : tests::plate_meshes)
  {
    const meshes::ClothMesh mesh = sheet(kind);
    const ShortWaves waves(mesh);
    EXPECT_EQ(waves.shortest(mesh.positions), no_waves);
    SpacePoints x = mesh.positions + 1e-9 * side * meshes::random_vectors(mesh.n_vertices(), 1);
    EXPECT_EQ(waves.shortest(x), no_waves) << kind << ": round-off";
    for (const double direction : {0., 0.5, 0.25 * M_PI})
    {
      for (const double radius : {1.5, 3., 10., 30.})
        EXPECT_EQ(waves.shortest(rolled(mesh, radius, 100., direction)), no_waves)
          << kind << ", " << direction << ", " << radius;
      for (const double width : {0.5, 2., 5.})
        EXPECT_EQ(waves.shortest(rolled(mesh, width / 2.5, width, direction)), no_waves)
          << kind << ", " << direction << ", fold of " << width;
      const Eigen::MatrixX2d own = turned(mesh, direction);
      x.col(2)                   = own.col(0).cwiseProduct(own.col(1));
      EXPECT_EQ(waves.shortest(x), no_waves) << kind << ", " << direction << ": saddle";
      x.col(2) = 0.5 * own.rowwise().squaredNorm();
      EXPECT_EQ(waves.shortest(x), no_waves) << kind << ", " << direction << ": bowl";
    }
  }
}

TEST(tripwire_short_waves, a_sheet_that_is_twisted_has_none_on_an_uneven_mesh)
{
  // A mesh breaks the balance of both curvatures of a saddle, here and there.
  for (const std::string &kind : {"one diagonal", "alternating"})
  {
    meshes::TriangleMesh rest = tests::plate_mesh(kind, n_sides);
    const SpacePoints moves   = 0.3 * side * meshes::random_vectors(rest.n_vertices(), 2);
    for (int v = 0; v < rest.n_vertices(); ++v)
      if (const auto x = rest.vertices.row(v).array(); (x > 1e-9).all() && (x < 1. - 1e-9).all())
        rest.vertices.row(v) += moves.row(v).head<2>();
    const meshes::ClothMesh mesh = tests::lying(rest);
    const ShortWaves waves(mesh);
    for (const double per_side : {0.02, 0.05, 0.1})
    {
      SpacePoints x = mesh.positions;
      for (Eigen::Index v = 0; v < x.rows(); ++v)
      {
        const double angle = per_side / side * rest.vertices(v, 0), y = rest.vertices(v, 1) - 0.5;
        x.row(v) << rest.vertices(v, 0), y * std::cos(angle), y * std::sin(angle);
      }
      EXPECT_EQ(waves.shortest(x), no_waves) << kind << ", " << per_side;
    }
    EXPECT_NEAR(waves.shortest(sine(mesh, 5., 0.3)), 5., 1.) << kind;
  }
}

TEST(invariant_short_waves, a_cloth_that_is_turned_and_scaled_has_the_same)
{
  meshes::ClothMesh mesh = sheet("shaken");
  const SpacePoints x    = sine(mesh, 5., 0.3);
  const double before    = ShortWaves(mesh).shortest(x);
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.6, -0.5, 0.7).normalized()).toRotationMatrix();
  mesh.rest.vertices *= 0.01;
  EXPECT_EQ(ShortWaves(mesh).shortest((0.01 * x * turn.transpose()).rowwise() +
                                      Eigen::RowVector3d(3., 1., -2.)),
            before);
}

TEST(tripwire_short_waves, a_panel_does_not_hide_waves_of_another_that_lies_there_at_rest)
{
  const meshes::ClothMesh one = sheet("one diagonal");
  const SpacePoints waved     = sine(one, 5., 0.3);
  const double alone          = ShortWaves(one).shortest(waved);
  const int n_vertices        = one.n_vertices();
  meshes::ClothMesh both      = one;
  both.rest.vertices.resize(2 * n_vertices, 2);
  both.rest.vertices << one.rest.vertices, one.rest.vertices;
  both.rest.triangles.resize(2 * one.n_triangles(), 3);
  both.rest.triangles << one.triangles, one.triangles.array() + n_vertices;
  both.triangles = both.rest.triangles;
  both.positions.resize(2 * n_vertices, 3);
  both.positions << waved, rolled(one, 5., 100., 0.3);
  EXPECT_EQ(ShortWaves(both).shortest(both.positions), alone);
}

TEST(exact_short_waves, waves_in_a_corner_of_a_cloth_that_is_rolled_are_found)
{
  const meshes::ClothMesh mesh = sheet("alternating");
  SpacePoints x                = rolled(mesh, 20., 100., 0.);
  const SpacePoints waved      = sine(mesh, 4., 0.);
  for (Eigen::Index v = 0; v < x.rows(); ++v)
    if (mesh.rest.vertices.row(v).maxCoeff() < 0.6)
      x(v, 2) += 0.5 * waved(v, 2);
  EXPECT_NEAR(ShortWaves(mesh).shortest(x), 4., 1.);
}
