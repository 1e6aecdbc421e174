// SPDX-License-Identifier: MIT
#include "homogenization/fem/discretization.h"
#include "tests/meshes/plain/shapes.h"

#include <deal.II/dofs/dof_tools.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace homespun;
using namespace homespun::homogenization;

// What chi.h5 and the references rely on: cell t is triangle t, its corners in their order, its
// material id the phase, its shapes node after node.
TEST(exact_discretization, cells_are_the_triangles_of_the_mesh)
{
  meshes::TriangleMesh mesh = tests::parallelogram(tests::skewed_lattice(), 4, 3);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    mesh.material(t) = t % 3;
  for (const unsigned int order : {1u, 2u})
    for (const unsigned int n_components : {2u, 3u})
    {
      const Discretization discretization(mesh, order, MPI_COMM_SELF, n_components);
      // Euler: vertices − edges + triangles = 1.
      const int n_edges = mesh.n_vertices() + mesh.n_triangles() - 1;
      EXPECT_EQ(discretization.n_dofs(),
                n_components * (mesh.n_vertices() + (order == 2 ? n_edges : 0)));
      EXPECT_EQ(discretization.locally_active, discretization.locally_owned);
      const DofTable of_vertex = discretization.vertex_dofs();
      int n_walked             = 0;
      discretization.for_owned_cells(
        [&](const auto &cell, const std::vector<dealii::types::global_dof_index> &dofs)
        {
          const int t = n_walked++;
          EXPECT_EQ(static_cast<int>(cell->active_cell_index()), t);
          EXPECT_EQ(static_cast<int>(cell->material_id()), mesh.material(t));
          for (unsigned int k = 0; k < 3; ++k)
          {
            const int vertex = mesh.triangles(t, static_cast<int>(k));
            EXPECT_EQ(cell->vertex(k)[0], mesh.vertices(vertex, 0));
            EXPECT_EQ(cell->vertex(k)[1], mesh.vertices(vertex, 1));
            for (unsigned int c = 0; c < n_components; ++c)
              EXPECT_EQ(of_vertex(vertex, c), dofs[k * n_components + c]);
          }
          for (std::size_t i = 0; i < dofs.size();
               ++i) // the components of a node follow each other
            EXPECT_EQ(dofs[i], dofs[i - i % n_components] + i % n_components);
        });
      EXPECT_EQ(n_walked, mesh.n_triangles());
    }
}

TEST(exact_discretization, nodes_of_the_boundary_are_those_that_deal_ii_finds)
{
  const meshes::TriangleMesh mesh = tests::parallelogram(tests::skewed_lattice(), 4, 3);
  for (const unsigned int order : {1u, 2u})
  {
    const Discretization discretization(mesh, order, MPI_COMM_SELF);
    const auto boundary = dealii::DoFTools::extract_boundary_dofs(discretization.dof_handler,
                                                                  dealii::ComponentMask(2, true));
    const std::vector<Node> nodes = discretization.boundary_nodes();
    EXPECT_EQ(nodes.size() * 2, boundary.n_elements());
    for (const Node &node : nodes)
      EXPECT_TRUE(boundary.is_element(node.first_dof));
    EXPECT_EQ(discretization.nodes().size() * 2, discretization.n_dofs());
  }
}

// Fields of the order of the elements are theirs: the area integral of x^p, by FEValues on straight
// triangles, is that of Gauss.
TEST(exact_discretization, both_quadratures_are_exact_where_they_are_used)
{
  const meshes::TriangleMesh mesh = tests::parallelogram(tests::square_lattice(1.), 3, 3);
  for (const unsigned int order : {1u, 2u})
  {
    const Discretization discretization(mesh, order, MPI_COMM_SELF);
    const auto integral = [&](const dealii::Quadrature<2> &quadrature, const unsigned int degree)
    {
      auto fe_values = discretization.fe_values(quadrature, dealii::update_quadrature_points |
                                                              dealii::update_JxW_values);
      double sum     = 0.;
      discretization.for_owned_cells(
        [&](const auto &cell, const auto &)
        {
          fe_values.reinit(cell);
          for (const unsigned int q : fe_values.quadrature_point_indices())
            sum += fe_values.JxW(q) * std::pow(fe_values.quadrature_point(q)[0], degree);
        });
      return sum;
    };
    const unsigned int linear = 2 * (order - 1), nonlinear = order == 1 ? 1 : 4;
    EXPECT_NEAR(integral(discretization.stiffness_quadrature, linear), 1. / (linear + 1), 1e-14);
    EXPECT_NEAR(integral(discretization.nonlinear_quadrature, nonlinear), 1. / (nonlinear + 1),
                1e-14);
  }
}
