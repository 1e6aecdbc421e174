// SPDX-License-Identifier: MIT
// A cell is what was drawn: whatever the outline and the digits of a mesh, its stiffness is that of
// the drawing, or the cell is refused.
#include "meshes/plain/refine.h"
#include "tests/homogenization/cell/drawn_cells.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <iostream>

using namespace homespun;
using namespace homespun::homogenization;
using tests::DrawnCell;
using tests::Random;
using tests::relative_difference;
using tests::uniform;
using tests::whole;

namespace
{
/// Full cells: parallelograms and hexagons, sheared, turned, mirrored, of one phase, with 4 to 9
/// digits.
void expect_no_holes_in_full_cells(const unsigned int seed, const int n_cells)
{
  Random random(seed);
  const DrawnCell drawn;
  const Eigen::Matrix3d exact = plane_stress_stiffness(isotropic("1", 1e6, 0.3, 5e-4, 400.));
  int n_fine = 0, n_fine_answers = 0, n_answers = 0;
  for (int k = 0; k < n_cells; ++k)
  {
    const int n = whole(random, 3, 8);
    meshes::TriangleMesh mesh;
    if (whole(random, 0, 1) == 0)
    {
      meshes::Lattice lattice;
      lattice.vectors << 1., 0., uniform(random, -0.7, 0.7), uniform(random, 0.5, 1.5);
      mesh = tests::parallelogram(lattice, n, whole(random, 3, 8));
      tests::shake(mesh, lattice, 0.02);
    }
    else
      mesh =
        tests::hexagon({Eigen::RowVector2d(uniform(random, 0.4, 0.8), uniform(random, -0.2, 0.2)),
                        Eigen::RowVector2d(uniform(random, 0.1, 0.4), uniform(random, 0.4, 0.8)),
                        Eigen::RowVector2d(uniform(random, -0.6, -0.2), uniform(random, 0.4, 0.8))},
                       n);
    const double turn  = whole(random, 0, 2) == 0 ? 0. : uniform(random, 0., 2. * M_PI);
    const double scale = std::pow(10., whole(random, -1, 1)) * uniform(random, 1., 3.);
    Eigen::Matrix2d map;
    map << std::cos(turn), std::sin(turn), -std::sin(turn), std::cos(turn);
    mesh.vertices = (scale * mesh.vertices * map).eval();
    if (whole(random, 0, 1) == 0)
    {
      mesh.vertices.col(0) *= -1.;
      mesh.triangles.col(1).swap(mesh.triangles.col(2));
    }
    if (whole(random, 0, 1) == 0)
      mesh.vertices.rowwise() +=
        Eigen::RowVector2d(uniform(random, -1., 1.), uniform(random, -1., 1.));
    const tests::Digits digits{whole(random, 4, 9), whole(random, 0, 1) == 0};
    const CellReading reading = drawn.read(mesh, digits);
    const std::string what    = "cell " + std::to_string(k) + ", " + std::to_string(digits.n) +
                             (digits.is_fixed ? " decimals" : " digits") + "\n" +
                             tests::texts_of(reading);
    // Decimals of a cell a tenth in size are one digit fewer.
    const bool is_fine = digits.n >= (digits.is_fixed && scale < 1. ? 7 : 6);
    n_fine += is_fine ? 1 : 0;
    if (!reading.is_whole)
    {
      EXPECT_TRUE(has_errors(reading.findings)) << what;
      continue;
    }
    ++n_answers;
    n_fine_answers += is_fine ? 1 : 0;
    EXPECT_EQ(meshes::boundary_loops(reading.cell.mesh).size(), 1u) << what;
    EXPECT_LT(relative_difference(tests::stiffness_of(reading), exact), 1e-6) << what;
  }
  std::cout << "full cells, seed " << seed << ": " << n_answers << " of " << n_cells
            << " answer, of those with 6 digits or more " << n_fine_answers << " of " << n_fine
            << "\n";
  EXPECT_GE(n_fine_answers, 0.95 * n_fine);
}

/// Patterns of squares: which of n x n are solid.
std::function<bool(int, int)> pattern(Random &random, const int n)
{
  const int kind = whole(random, 0, 4);
  std::vector<char> solid(static_cast<std::size_t>(n * n), 1);
  const auto at = [n, solid = std::move(solid)](const int i, const int j) mutable -> char &
  { return solid[static_cast<std::size_t>((i + 8 * n) % n + n * ((j + 8 * n) % n))]; };
  auto its = at;
  const auto fill =
    [&](const int i0, const int j0, const int wide, const int high, const char value)
  {
    for (int i = 0; i < wide; ++i)
      for (int j = 0; j < high; ++j)
        its(i0 + i, j0 + j) = value;
  };
  const int i = whole(random, 0, n - 1), j = whole(random, 0, n - 1);
  if (kind == 0) // squares here and there
    for (int k = 0; k < n * n; ++k)
      its(k % n, k / n) = uniform(random, 0., 1.) < 0.75 ? 1 : 0;
  else if (kind == 1) // a plus
  {
    fill(0, 0, n, n, 0);
    const int wide = whole(random, 1, n - 2);
    fill(i, 0, wide, n, 1);
    fill(0, j, n, wide, 1);
  }
  else if (kind == 2) // a slot
    fill(i, j, whole(random, 1, n - 1), 1, 0);
  else if (kind == 3) // an L
  {
    const int arm = whole(random, 2, n - 2);
    fill(i, j, arm, 1, 0);
    fill(i, j, 1, arm, 0);
  }
  else // staggered holes
    for (int k = 0; k < 2; ++k)
      fill(i + k * n / 2, j + k * n / 2, n / 2 - 1, n / 2 - 1, 0);
  return [its](const int a, const int b) mutable { return its(a, b) != 0; };
}

void expect_nets_to_be_those_of_their_frame(const unsigned int seed, const int n_nets)
{
  Random random(seed);
  const DrawnCell drawn;
  const tests::Digits all;
  int n_framed = 0, n_answers = 0, n_sound = 0, n_without_sheets = 0;
  for (int k = 0; k < n_nets; ++k)
  {
    const int n                     = whole(random, 4, 6);
    const auto is_solid             = pattern(random, n);
    const meshes::TriangleMesh mesh = tests::pixels(n, is_solid);
    const int i0 = whole(random, 0, n - 1), j0 = whole(random, 0, n - 1);
    if (mesh.n_triangles() == 0)
      continue;
    const CellReading given = drawn.read(mesh, all, "set Lattice vectors = 1 0; 0 1\n");
    const CellReading found = drawn.read(mesh, all);
    const std::string what  = "net " + std::to_string(k) + "\n" + tests::texts_of(found);
    if (!given.is_whole)
    {
      EXPECT_TRUE(has_errors(given.findings)) << what;
      // A smaller frame may be one of another cloth, but never without a reason to ask.
      continue;
    }
    ++n_sound;
    n_without_sheets += given.cell.lattice.cuts_holes ? 1 : 0;
    const Eigen::Matrix3d C = tests::stiffness_of(given);
    const auto expect_same  = [&](const CellReading &other, const char *which)
    {
      if (other.is_whole)
        EXPECT_LT(relative_difference(tests::stiffness_of(other), C), 1e-10)
          << which << " " << what;
      else
        EXPECT_TRUE(has_errors(other.findings)) << which << " " << what;
      return other.is_whole;
    };
    const Eigen::RowVector2d box =
      mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff();
    const bool is_framed = (box.array() - 1.).abs().maxCoeff() < 1e-9;
    n_framed += is_framed ? 1 : 0;
    n_answers += expect_same(found, "auto") && is_framed ? 1 : 0;
    expect_same(
      drawn.read(tests::pixels(n, is_solid, i0, j0), all, "set Lattice vectors = 1 0; 0 1\n"),
      "cut elsewhere");
    expect_same(
      drawn.read(tests::pixels(n, is_solid, 0, 0, 2), all, "set Lattice vectors = 2 0; 0 2\n"),
      "tiled");
  }
  std::cout
    << "nets, seed " << seed << ": " << n_sound << " of " << n_nets << " are cells, "
    << n_without_sheets
    << " of them without a line between their holes, of those that reach all sides of their frame "
    << n_answers << " of " << n_framed << " answer without lattice\n";
  EXPECT_GE(n_answers, 0.9 * n_framed);
  EXPECT_GT(n_sound, n_nets / 4);
  EXPECT_GT(n_without_sheets, 0);
}
} // namespace

TEST(invariant_drawn_cells, full_cells_have_no_holes_whatever_their_digits)
{
  expect_no_holes_in_full_cells(20261126, 60);
}

TEST(invariant_drawn_cells, nets_are_those_of_their_frame_wherever_they_are_cut)
{
  expect_nets_to_be_those_of_their_frame(4711, 60);
}

TEST(tripwire_drawn_cells, the_end_of_a_bar_that_is_off_as_a_whole_is_no_hole)
{
  // Two bars and a column: what is missing between the end of a bar and its image joins two holes.
  const int n         = 10;
  const auto is_solid = [](const int i, const int j)
  { return j == 1 || j == 6 || i == 4 || i == 5; };
  const DrawnCell drawn;
  for (const char *lattice : {"", "set Lattice vectors = 1 0; 0 1\n"})
  {
    meshes::TriangleMesh mesh = tests::pixels(n, is_solid);
    EXPECT_TRUE(drawn.read(mesh, {}, lattice).is_whole) << lattice;
    for (int v = 0; v < mesh.n_vertices(); ++v)
      if (mesh.vertices(v, 0) > 1. - 1e-9 && mesh.vertices(v, 1) > 0.55)
        mesh.vertices(v, 1) += 1e-3;
    const CellReading reading = drawn.read(mesh, {}, lattice);
    EXPECT_FALSE(reading.is_whole) << lattice;
    EXPECT_NE(tests::texts_of(reading).find("opposite sides are not meshed alike"),
              std::string::npos)
      << tests::texts_of(reading);
  }
}

TEST(tripwire_drawn_cells, a_hole_narrower_than_half_of_its_edges_is_told_what_makes_it_one)
{
  // Along the whole of one side but for a strap.
  meshes::TriangleMesh mesh =
    tests::pixels(4, [](const int i, const int j) { return i != 0 || j == 1; });
  mesh.vertices.col(1) *= 6.;
  const DrawnCell drawn;
  for (const std::string lattice : {"", "set Lattice vectors = 1 0; 0 6\n"})
  {
    const std::string said = tests::texts_of(drawn.read(mesh, {}, lattice));
    EXPECT_NE(said.find("which is 0.00236842 m wide on average: meshed with edges no longer than "
                        "0.00473684 m it is a hole"),
              std::string::npos)
      << said;
    EXPECT_EQ(said.find("tolerance"), std::string::npos) << said;
    EXPECT_TRUE(drawn.read(meshes::refined(mesh, 1), {}, lattice).is_whole);
    EXPECT_TRUE(drawn.read(mesh, {}, lattice + "set Slits = real\n").is_whole);
  }
}

TEST(tripwire_drawn_cells, parts_that_meet_their_images_in_vertices_alone_are_told_as_hinges)
{
  meshes::TriangleMesh mesh = tests::parallelogram(tests::square_lattice(1.), 4, 4);
  Eigen::Matrix2d turn;
  turn << 0.5, 0.5, -0.5, 0.5; // a diamond in a square
  mesh.vertices             = (mesh.vertices * turn).eval();
  const CellReading reading = DrawnCell().read(mesh, {}, "set Lattice vectors = 1 0; 0 1\n");
  EXPECT_TRUE(std::any_of(reading.findings.begin(), reading.findings.end(),
                          [](const Finding &finding)
                          { return finding.kind == "hinge" && finding.place.is_known(); }))
    << tests::texts_of(reading);
}

TEST(long_drawn_cells, full_cells_and_nets)
{
  expect_no_holes_in_full_cells(1, 1000);
  expect_nets_to_be_those_of_their_frame(2, 300);
}
