// SPDX-License-Identifier: MIT
#include "homogenization/fem/discretization.h"
#include "tests/meshes/plain/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

using namespace homespun;
using namespace homespun::homogenization;

namespace
{
/// Edges whose triangles belong to different parts.
int n_cut_edges(const meshes::TriangleMesh &mesh, const std::vector<unsigned int> &part)
{
  std::map<std::array<int, 2>, unsigned int> first;
  int n = 0;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int a = mesh.triangles(t, k), b = mesh.triangles(t, (k + 1) % 3);
      const unsigned int its  = part[static_cast<std::size_t>(t)];
      const auto [at, is_new] = first.insert({{std::min(a, b), std::max(a, b)}, its});
      n += !is_new && at->second != its;
    }
  return n;
}
} // namespace

TEST(exact_discretization, parts_are_of_equal_size_to_one_triangle)
{
  const meshes::TriangleMesh mesh = tests::parallelogram(tests::skewed_lattice(), 7, 5);
  for (const unsigned int n_parts : {1u, 2u, 3u, 5u, 8u, 70u})
  {
    std::vector<int> size(n_parts, 0);
    for (const unsigned int part : parts_of(mesh, n_parts))
      ++size.at(part);
    const auto [least, most] = std::minmax_element(size.begin(), size.end());
    EXPECT_LE(*most - *least, n_parts < 8u ? 1 : 2) << n_parts; // of halves of halves
  }
}

// A cut across a square of n x n squares meets n edges, and one more per square where it runs
// between the triangles of a square.
TEST(bound_discretization, parts_meet_along_short_lines)
{
  constexpr int n                 = 32;
  const meshes::TriangleMesh mesh = tests::parallelogram(tests::square_lattice(1.), n, n);
  EXPECT_EQ(n_cut_edges(mesh, parts_of(mesh, 1)), 0);
  EXPECT_LE(n_cut_edges(mesh, parts_of(mesh, 2)), 2 * n);
  EXPECT_LE(n_cut_edges(mesh, parts_of(mesh, 4)), 4 * n);
  EXPECT_LE(n_cut_edges(mesh, parts_of(mesh, 16)), 12 * n);
}

TEST(invariant_discretization, numbers_of_vertices_and_triangles_outlive_the_triangulation)
{
  for (const unsigned int order : {1u, 2u})
  {
    Discretization discretization(tests::parallelogram(tests::skewed_lattice(), 4, 3), order,
                                  MPI_COMM_SELF);
    const DofTable before = discretization.vertex_dofs();
    std::vector<dealii::types::global_dof_index> of_cells, of_triangles;
    std::vector<dealii::types::global_dof_index> dofs(discretization.element.n_dofs_per_cell());
    for (const auto &cell : discretization.dof_handler.active_cell_iterators())
    {
      cell->get_dof_indices(dofs);
      of_cells.push_back(Discretization::triangle_of(cell));
      of_cells.insert(of_cells.end(), dofs.begin(), dofs.end());
    }
    discretization.forget_triangulation();
    discretization.for_owned_triangles(
      [&](const unsigned int t, const std::vector<dealii::types::global_dof_index> &its)
      {
        of_triangles.push_back(t);
        of_triangles.insert(of_triangles.end(), its.begin(), its.end());
      });
    EXPECT_EQ(discretization.vertex_dofs(), before);
    EXPECT_EQ(of_triangles, of_cells);
  }
}
