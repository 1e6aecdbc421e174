// SPDX-License-Identifier: MIT
// A fault of a drawn mesh is refused, told by its place, or changes nothing.
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

TEST(tripwire_drawn_cells, a_fault_of_the_mesh_is_refused_or_told_by_its_place)
{
  expect_faults_to_be_noticed(1729, 60);
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

TEST(tripwire_drawn_cells, sides_in_single_precision_are_told_the_tolerance_that_matches_them)
{
  const meshes::Lattice lattice{(Eigen::Matrix2d() << 1., 0.1, 0.37, 0.9).finished()};
  const DrawnCell drawn;
  for (const double far : {20., 300.})
    for (const char *given : {"", "set Lattice vectors = 1 0.1; 0.37 0.9\n"})
    {
      meshes::TriangleMesh mesh = tests::parallelogram(lattice, 8, 8);
      mesh.vertices             = (mesh.vertices.array() + far).cast<float>().cast<double>();
      const std::string said    = tests::texts_of(drawn.read(mesh, {}, given));
      const std::size_t first   = said.find("set Matching tolerance");
      ASSERT_NE(first, std::string::npos) << said;
      EXPECT_EQ(said.find("Lattice vectors"), std::string::npos) << said;
      const std::string line = said.substr(first, said.find('`', first) - first) + "\n";
      EXPECT_TRUE(drawn.read(mesh, {}, given + line).is_whole) << said;
    }
}

TEST(tripwire_drawn_cells, a_line_of_the_lattice_goes_before_a_tolerance)
{
  meshes::TriangleMesh mesh = tests::parallelogram(tests::square_lattice(1.), 8, 8);
  for (int v = 0; v < mesh.n_vertices(); ++v)
    mesh.vertices(v, 0) += 3e-4 * std::sin(2. * M_PI * mesh.vertices(v, 1));
  const std::string said = tests::texts_of(DrawnCell().read(mesh, {8, false}));
  EXPECT_NE(said.find("set Lattice vectors = 1 0; 0 1"), std::string::npos) << said;
  EXPECT_EQ(said.find("Matching tolerance"), std::string::npos) << said;
}

TEST(long_drawn_cells, faults)
{
  expect_faults_to_be_noticed(3, 500);
}
