// SPDX-License-Identifier: MIT
#include "homogenization/fem/discretization.h"
#include "tests/meshes/plain/shapes.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/tria.h>

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

// Each node belongs to the first part that has a triangle with it, and those of a part follow one
// another.
TEST(exact_discretization, nodes_are_numbered_part_after_part)
{
  const meshes::TriangleMesh mesh = tests::parallelogram(tests::skewed_lattice(), 7, 5);
  const meshes::TriangleSides sides(mesh);
  for (const unsigned int order : {1u, 2u})
    for (const unsigned int n_parts : {1u, 2u, 3u, 70u})
    {
      const std::vector<unsigned int> parts = parts_of(mesh, n_parts);
      const NodeNumbers numbers(mesh, sides, order, parts, n_parts);
      ASSERT_EQ(numbers.begin_of_part.size(), n_parts + 1);
      std::vector<unsigned int> first_part(numbers.n(), n_parts);
      std::vector<int> is_taken(numbers.n(), 0);
      for (const auto *const of_nodes : {&numbers.of_vertex, &numbers.of_side})
        for (const unsigned int number : *of_nodes)
          ++is_taken.at(number);
      EXPECT_EQ(is_taken, std::vector<int>(numbers.n(), 1));
      for (int t = 0; t < mesh.n_triangles(); ++t)
        for (int k = 0; k < 3; ++k)
        {
          const auto vertex       = static_cast<std::size_t>(mesh.triangles(t, k)),
                     side         = static_cast<std::size_t>(sides.of_triangle(t, k));
          unsigned int &of_vertex = first_part.at(numbers.of_vertex.at(vertex));
          of_vertex               = std::min(of_vertex, parts[static_cast<std::size_t>(t)]);
          if (order == 1)
            continue;
          unsigned int &of_side = first_part.at(numbers.of_side.at(side));
          of_side               = std::min(of_side, parts[static_cast<std::size_t>(t)]);
        }
      for (unsigned int node = 0; node < numbers.n(); ++node)
      {
        EXPECT_GE(node, numbers.begin_of_part[first_part[node]]);
        EXPECT_LT(node, numbers.begin_of_part[first_part[node] + 1]);
      }
    }
}

// A second code: on one rank DoFs are those that deal.II gives a triangulation.
TEST(exact_discretization, on_one_rank_numbers_are_those_of_a_dof_handler)
{
  const meshes::TriangleMesh mesh = tests::parallelogram(tests::skewed_lattice(), 4, 3);
  std::vector<dealii::Point<2>> points;
  for (const auto &vertex : mesh.vertices.rowwise())
    points.emplace_back(vertex(0), vertex(1));
  std::vector<dealii::CellData<2>> cells(static_cast<std::size_t>(mesh.n_triangles()),
                                         dealii::CellData<2>(3));
  for (std::size_t t = 0; t < cells.size(); ++t)
    for (int k = 0; k < 3; ++k)
      cells[t].vertices[static_cast<std::size_t>(k)] =
        static_cast<unsigned int>(mesh.triangles(static_cast<Eigen::Index>(t), k));
  dealii::Triangulation<2> triangulation;
  triangulation.create_triangulation(points, cells, dealii::SubCellData());
  for (const unsigned int order : {1u, 2u})
    for (const unsigned int n_components : {2u, 3u})
    {
      const dealii::FESystem<2> element(dealii::FE_SimplexP<2>(order), n_components);
      dealii::DoFHandler<2> handler(triangulation);
      handler.distribute_dofs(element);
      const Discretization discretization(mesh, order, MPI_COMM_SELF, n_components);
      EXPECT_EQ(discretization.n_dofs(), handler.n_dofs());
      EXPECT_EQ(discretization.locally_relevant, discretization.locally_owned);
      auto cell             = handler.begin_active();
      unsigned int n_walked = 0;
      discretization.for_near_triangles(
        [&](const unsigned int t, const std::vector<dealii::types::global_dof_index> &its,
            const bool is_owned)
        {
          EXPECT_TRUE(is_owned);
          EXPECT_EQ(t, n_walked++);
          std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_cell());
          cell->get_dof_indices(dofs);
          EXPECT_EQ(its, dofs);
          ++cell;
        });
      EXPECT_EQ(n_walked, mesh.n_triangles());
      const auto boundary =
        dealii::DoFTools::extract_boundary_dofs(handler, dealii::ComponentMask(n_components, true));
      EXPECT_EQ(discretization.boundary_nodes().size() * n_components, boundary.n_elements());
      for (const Node &node : discretization.boundary_nodes())
        EXPECT_TRUE(boundary.is_element(node.first_dof));
    }
}
