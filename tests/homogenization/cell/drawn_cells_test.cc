// SPDX-License-Identifier: MIT
// A cell is what was drawn: whatever the outline, the digits and the faults of a mesh, its
// stiffness is that of the drawing, or the cell is refused.
#include "tests/homogenization/cell/drawn_cells.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <iostream>
#include <set>

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

/// A mesh as lists, easily damaged.
struct Damaged
{
  meshes::TriangleMesh mesh;

  int add_vertex(const Eigen::RowVector2d &x)
  {
    mesh.vertices.conservativeResize(mesh.n_vertices() + 1, 2);
    mesh.vertices.row(mesh.n_vertices() - 1) = x;
    return mesh.n_vertices() - 1;
  }
  void add_triangle(const int a, const int b, const int c, const int material)
  {
    const int m = mesh.n_triangles();
    mesh.triangles.conservativeResize(m + 1, 3);
    mesh.triangles.row(m) << a, b, c;
    mesh.material.conservativeResize(m + 1);
    mesh.material(m) = material;
  }
  void remove(const int t)
  {
    const int last        = mesh.n_triangles() - 1;
    mesh.triangles.row(t) = mesh.triangles.row(last).eval();
    mesh.material(t)      = mesh.material(last);
    mesh.triangles.conservativeResize(last, 3);
    mesh.material.conservativeResize(last);
    // Vertices that no triangle uses are no part of this fault.
    std::vector<int> number(static_cast<std::size_t>(mesh.n_vertices()), -1);
    for (const int v : mesh.triangles.reshaped())
      number[static_cast<std::size_t>(v)] = 0;
    int n = 0;
    for (int v = 0; v < static_cast<int>(number.size()); ++v)
      if (number[static_cast<std::size_t>(v)] == 0)
      {
        mesh.vertices.row(n)                = mesh.vertices.row(v).eval();
        number[static_cast<std::size_t>(v)] = n++;
      }
    mesh.vertices.conservativeResize(n, 2);
    for (int &v : mesh.triangles.reshaped())
      v = number[static_cast<std::size_t>(v)];
  }
};

/// What was done to a sound mesh.
std::string damage(Damaged &its, Random &random)
{
  meshes::TriangleMesh &mesh = its.mesh;
  // Of the boundary what has an image is a side, the rest is the rim of a hole.
  const auto boundary   = meshes::boundary_edges(mesh);
  const auto is_shifted = [&](const int from, const int to)
  {
    const Eigen::RowVector2d d = (mesh.vertices.row(to) - mesh.vertices.row(from)).cwiseAbs();
    return d.minCoeff() < 1e-9 && std::abs(d.maxCoeff() - 1.) < 1e-9;
  };
  std::vector<int> sides;
  std::set<std::array<int, 2>> rim;
  for (const auto &edge : boundary)
    if (std::any_of(boundary.begin(), boundary.end(),
                    [&](const auto &other)
                    { return is_shifted(edge[0], other[1]) && is_shifted(edge[1], other[0]); }))
      sides.insert(sides.end(), edge.begin(), edge.end());
    else
      rim.insert(edge);
  const auto is_at_rim = [&](const int triangle)
  {
    for (int k = 0; k < 3; ++k)
      if (rim.count({mesh.triangles(triangle, k), mesh.triangles(triangle, (k + 1) % 3)}) > 0)
        return true;
    return false;
  };
  const int t                = whole(random, 0, mesh.n_triangles() - 1);
  const Eigen::RowVector2d a = mesh.vertices.row(mesh.triangles(t, 0)),
                           b = mesh.vertices.row(mesh.triangles(t, 1)),
                           c = mesh.vertices.row(mesh.triangles(t, 2));
  switch (whole(random, 0, 6))
  {
  case 0: // moved across its side
  case 1:
  {
    const int v =
      sides[static_cast<std::size_t>(whole(random, 0, static_cast<int>(sides.size()) - 1))];
    const Eigen::RowVector2d x  = mesh.vertices.row(v);
    const double distance       = std::pow(10., uniform(random, -8., -1.));
    Eigen::RowVector2d outwards = x(0) < 1e-9        ? Eigen::RowVector2d(-1., 0.)
                                  : x(0) > 1. - 1e-9 ? Eigen::RowVector2d(1., 0.)
                                  : x(1) < 1e-9      ? Eigen::RowVector2d(0., -1.)
                                                     : Eigen::RowVector2d(0., 1.);
    mesh.vertices.row(v) += (whole(random, 0, 1) == 0 ? distance : -distance) * outwards;
    return "vertex " + std::to_string(v) + " moved across its side by " + std::to_string(distance);
  }
  case 2: // a point doubled: some of its triangles get the other one
  {
    const int v     = mesh.triangles(t, whole(random, 0, 2));
    const int other = its.add_vertex(mesh.vertices.row(v));
    int n = 0, rest = 0;
    for (int s = 0; s < mesh.n_triangles(); ++s)
      for (int k = 0; k < 3; ++k)
        if (mesh.triangles(s, k) == v)
        {
          const bool moves = s == t || (rest > 0 && whole(random, 0, 1) == 0);
          n += moves ? 1 : 0;
          rest += moves ? 0 : 1;
          if (moves)
            mesh.triangles(s, k) = other;
        }
    if (rest == 0) // of one triangle alone: nothing is doubled
    {
      its.add_triangle(v, mesh.triangles(t, 1), mesh.triangles(t, 2), 0);
      return "triangle on a triangle";
    }
    return "vertex " + std::to_string(v) + " doubled";
  }
  case 3: // a T-junction, on one side of an edge
  {
    if (is_at_rim(t)) // where it would be one point more
      return "";
    const int middle   = its.add_vertex(0.5 * (a + b));
    const int material = mesh.material(t), third = mesh.triangles(t, 2);
    its.add_triangle(middle, mesh.triangles(t, 1), third, material);
    mesh.triangles(t, 1) = middle;
    return "a T-junction on triangle " + std::to_string(t);
  }
  case 4: // doubled, with points of its own
  {
    const int first = its.add_vertex(a);
    its.add_vertex(b);
    its.add_vertex(c);
    its.add_triangle(first, first + 1, first + 2, mesh.material(t));
    return "triangle " + std::to_string(t) + " doubled";
  }
  case 5: // at the rim of a hole that would be another hole, as well drawn
    if (is_at_rim(t))
      return "";
    its.remove(t);
    return "triangle " + std::to_string(t) + " removed";
  default: // an overlap: a triangle more, somewhere
  {
    const Eigen::RowVector2d centre = (a + b + c) / 3.;
    const double size               = std::pow(10., uniform(random, -2., -0.5));
    const int first                 = its.add_vertex(centre);
    its.add_vertex(centre + size * Eigen::RowVector2d(1., 0.2));
    its.add_vertex(centre + size * Eigen::RowVector2d(0.1, 0.9));
    its.add_triangle(first, first + 1, first + 2, 0);
    return "a triangle over others near triangle " + std::to_string(t);
  }
  }
}

void expect_faults_to_be_noticed(const unsigned int seed, const int n_faults)
{
  Random random(seed);
  const DrawnCell drawn;
  const tests::Digits all;
  const std::string lattice = "set Lattice vectors = 1 0; 0 1\n";
  int n_refused = 0, n_warned = 0, n_matched = 0, n_harmless = 0;
  for (int k = 0; k < n_faults; ++k)
  {
    // Full, with a hole inside, with a hole that the outline cuts.
    const int kind = whole(random, 0, 2), n = whole(random, 4, 7);
    Damaged its{tests::pixels(
      n, [&](const int i, const int j)
      { return kind == 0 || i == 0 + (kind == 1 ? 0 : 2) || i > 2 + kind || j == 0 || j > 2; })};
    for (int t = 0; t < its.mesh.n_triangles(); ++t)
      its.mesh.material(t) = its.mesh.vertices(its.mesh.triangles(t, 0), 1) < 0.5 - 1e-9 ? 1 : 0;
    tests::shake(its.mesh, tests::square_lattice(1.), 0.03 / n);
    const std::string more  = whole(random, 0, 1) == 0 ? lattice : "";
    const CellReading sound = drawn.read(its.mesh, all, more);
    ASSERT_TRUE(sound.is_whole) << tests::texts_of(sound);
    std::string done;
    while (done.empty())
      done = damage(its, random);
    const std::string what = "fault " + std::to_string(k) + " in cell " + std::to_string(kind) +
                             (more.empty() ? " auto: " : " given: ") + done;
    const CellReading reading = drawn.read(its.mesh, all, more);
    std::string said          = what + "\n" + tests::texts_of(reading);
    if (!reading.is_whole)
    {
      EXPECT_TRUE(has_errors(reading.findings)) << said;
      ++n_refused;
      continue;
    }
    const auto has = [&](const char *its_kind)
    {
      return std::any_of(reading.findings.begin(), reading.findings.end(),
                         [&](const Finding &finding)
                         { return finding.kind == its_kind && finding.place.is_known(); });
    };
    if (has("nearly unmatched"))
      ++n_matched;
    else if (has("missing triangle") || has("hinge"))
    {
      ++n_warned;
      continue;
    }
    else
      ++n_harmless;
    EXPECT_LT(relative_difference(tests::stiffness_of(reading), tests::stiffness_of(sound)),
              has("nearly unmatched") ? 1e-5 : 1e-10)
      << said;
  }
  std::cout << "faults, seed " << seed << ": of " << n_faults << " " << n_refused << " refused, "
            << n_warned << " warned of, " << n_matched << " matched within the tolerance, "
            << n_harmless << " without effect\n";
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

TEST(tripwire_drawn_cells, a_fault_of_the_mesh_is_refused_or_told_by_its_place)
{
  expect_faults_to_be_noticed(1729, 60);
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

TEST(tripwire_drawn_cells, a_tab_that_reaches_into_its_image_is_no_hole)
{
  // Across the right side into the notch of the left one, and beyond it.
  const int n = 20;
  meshes::TriangleMesh mesh =
    tests::pixels(n, [](const int i, const int j) { return i >= 4 || j < 8 || j > 11; });
  const auto vertex_at = [&](const double x, const double y)
  {
    Eigen::Index nearest;
    (mesh.vertices.rowwise() - Eigen::RowVector2d(x, y)).rowwise().norm().minCoeff(&nearest);
    return static_cast<int>(nearest);
  };
  Damaged its{mesh};
  const int low = vertex_at(1., 0.475), high = vertex_at(1., 0.525),
            far_low = its.add_vertex({1.3, 0.475}), far_high = its.add_vertex({1.3, 0.525});
  its.add_triangle(low, far_low, vertex_at(1., 0.5), 0);
  its.add_triangle(vertex_at(1., 0.5), far_low, far_high, 0);
  its.add_triangle(vertex_at(1., 0.5), far_high, high, 0);
  const DrawnCell drawn;
  EXPECT_TRUE(drawn.read(mesh, {}, "set Lattice vectors = 1 0; 0 1\n").is_whole);
  const CellReading reading = drawn.read(its.mesh, {}, "set Lattice vectors = 1 0; 0 1\n");
  EXPECT_FALSE(reading.is_whole) << tests::texts_of(reading);
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

TEST(long_drawn_cells, full_cells_nets_and_faults)
{
  expect_no_holes_in_full_cells(1, 1000);
  expect_nets_to_be_those_of_their_frame(2, 300);
  expect_faults_to_be_noticed(3, 500);
}
