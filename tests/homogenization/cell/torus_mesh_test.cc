// SPDX-License-Identifier: MIT
#include "homogenization/cell/torus_mesh.h"
#include "tests/homogenization/bracket/bracket_cells.h"
#include "tests/homogenization/cell/unfolded.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

using namespace homespun;
using namespace homespun::homogenization;

namespace
{
/// Bisects random parts of the mesh and the corner at the origin, which lies on its outline.
TorusMesh randomly_bisected(TorusMesh mesh, const int rounds)
{
  std::mt19937 generator(11);
  std::bernoulli_distribution coin(0.2);
  for (int round = 0; round < rounds; ++round)
  {
    std::vector<char> is_marked(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    {
      const auto &vertices = mesh.triangles[t].vertices;
      is_marked[t] =
        coin(generator) || std::find(vertices.begin(), vertices.end(), 0) != vertices.end();
    }
    mesh = bisected(mesh, is_marked);
  }
  return mesh;
}

double smallest_angle(const TorusMesh &mesh)
{
  double smallest = M_PI;
  for (const TorusTriangle &triangle : mesh.triangles)
  {
    const auto shape = triangle.shape(mesh.edges);
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Eigen::Vector2d a = shape[(k + 1) % 3] - shape[k], b = shape[(k + 2) % 3] - shape[k];
      smallest = std::min(smallest, std::atan2(a(0) * b(1) - a(1) * b(0), a.dot(b)));
    }
  }
  return smallest;
}
} // namespace

TEST(invariant_torus_mesh, bisection_keeps_the_mesh_conforming_periodic_and_its_area)
{
  tests::BracketCell cell =
    tests::bracket_cell(tests::skewed_lattice(), 5, 4, tests::contrasting(10.),
                        [](double f1, double f2) { return f1 < 0.4 && f2 > 0.5 ? 1 : 0; });
  tests::shake(cell.mesh, cell.lattice, 3e-4);
  const TorusMesh coarse = glued(cell.mesh, cell.lattice);
  EXPECT_EQ(coarse.n_vertices, 20);
  EXPECT_EQ(coarse.n_edges(), 60);
  const TorusMesh fine = randomly_bisected(coarse, 5);
  // Euler's formula for the torus: a hanging node or an edge without its partner would break it.
  EXPECT_EQ(fine.n_vertices - fine.n_edges() + fine.n_triangles(), 0);
  EXPECT_TRUE(rim_edges(fine).empty());
  const meshes::TriangleMesh plane = tests::unfolded(fine);
  EXPECT_TRUE(meshes::faults_of(plane, "fine").empty());
  for (const std::string &fault : meshes::periodicity_faults(plane, cell.lattice, "fine"))
    ADD_FAILURE() << fault;
  EXPECT_NEAR(meshes::signed_areas(plane).sum(), cell.lattice.area(), 1e-14 * cell.lattice.area());
  // The given vertices stay where they are.
  const auto classes = meshes::match_images(plane.vertices, cell.lattice);
  EXPECT_EQ(fine.vertex_of_original, coarse.vertex_of_original);
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
  {
    double nearest = 1.;
    for (int w = 0; w < plane.n_vertices(); ++w)
      nearest = std::min(nearest, (plane.vertices.row(w) - cell.mesh.vertices.row(v)).norm());
    EXPECT_LT(nearest, 1e-16);
  }
}

TEST(invariant_torus_mesh, children_inherit_the_material_of_the_place)
{
  const auto material_at = [](double f1, double f2) { return f1 + f2 < 0.9 ? 1 : 0; };
  const tests::BracketCell cell =
    tests::bracket_cell(tests::square_lattice(1.), 8, 8, tests::contrasting(10.), material_at);
  const meshes::TriangleMesh plane =
    tests::unfolded(randomly_bisected(glued(cell.mesh, cell.lattice), 4));
  double area = 0., coarse_area = 0.;
  const Eigen::VectorXd areas = meshes::signed_areas(plane);
  for (int t = 0; t < plane.n_triangles(); ++t)
  {
    Eigen::RowVector2d centre = Eigen::RowVector2d::Zero();
    for (int k = 0; k < 3; ++k)
      centre += plane.vertices.row(plane.triangles(t, k)) / 3.;
    const auto middle = [](const double x)
    { return (std::floor(8. * (x - std::floor(x))) + 0.5) / 8.; };
    EXPECT_EQ(plane.material(t), material_at(middle(centre(0)), middle(centre(1))));
    area += areas(t) * plane.material(t);
  }
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    coarse_area += meshes::signed_areas(cell.mesh)(t) * cell.mesh.material(t);
  EXPECT_NEAR(area, coarse_area, 1e-13);
}

TEST(bound_torus_mesh, angles_stay_above_half_of_the_smallest_however_deep_the_mesh)
{
  tests::BracketCell cell = tests::bracket_cell(
    tests::skewed_lattice(), 3, 3, tests::contrasting(10.), [](double, double) { return 0; });
  tests::shake(cell.mesh, cell.lattice, 5e-4);
  TorusMesh mesh     = glued(cell.mesh, cell.lattice);
  const double first = smallest_angle(mesh);
  std::set<long> shapes;
  for (int round = 0; round < 120; ++round)
  {
    std::vector<char> is_marked(mesh.triangles.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (const int v : mesh.triangles[t].vertices)
        is_marked[t] |= v == 0;
    mesh = bisected(mesh, is_marked);
    EXPECT_GE(smallest_angle(mesh), 0.5 * first) << round;
  }
  EXPECT_LT(relative_resolution(mesh), 1e-34);
  EXPECT_LT(mesh.n_triangles(), 12000);
}

TEST(exact_torus_mesh, a_cell_of_two_triangles_has_one_vertex_and_three_edges)
{
  const tests::BracketCell cell = tests::bracket_cell(
    tests::skewed_lattice(), 1, 1, tests::contrasting(10.), [](double, double) { return 0; });
  const TorusMesh mesh = glued(cell.mesh, cell.lattice);
  EXPECT_EQ(mesh.n_vertices, 1);
  EXPECT_EQ(mesh.n_edges(), 3);
  const TorusMesh fine = bisected(mesh, {1, 0});
  EXPECT_EQ(fine.n_vertices - fine.n_edges() + fine.n_triangles(), 0);
}
