// SPDX-License-Identifier: MIT
#include "homogenization/fem/discretization.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <algorithm>

namespace homespun::homogenization
{
using namespace dealii;

namespace
{
using Cell = DoFHandler<2>::active_cell_iterator;

void create(const meshes::TriangleMesh &mesh, Triangulation<2> &triangulation)
{
  std::vector<Point<2>> vertices;
  for (const auto &vertex : mesh.vertices.rowwise())
    vertices.emplace_back(vertex(0), vertex(1));
  std::vector<CellData<2>> cells(static_cast<std::size_t>(mesh.n_triangles()), CellData<2>(3));
  for (std::size_t t = 0; t < cells.size(); ++t)
  {
    const auto row = static_cast<Eigen::Index>(t);
    for (int k = 0; k < 3; ++k)
      cells[t].vertices[static_cast<std::size_t>(k)] =
        static_cast<unsigned int>(mesh.triangles(row, k));
    cells[t].material_id = static_cast<types::material_id>(mesh.material(row));
  }
  triangulation.create_triangulation(vertices, cells, SubCellData());
}

/// Node k of a cell: its corners, then the midpoints of its sides.
Node node_of(const Cell &cell, const unsigned int k,
             const std::vector<types::global_dof_index> &dofs)
{
  const Point<2> point = k < 3 ? cell->vertex(k) : cell->face(k - 3)->center();
  const auto first     = dofs[k * cell->get_fe().n_components()];
  return {first, first + 1, {point[0], point[1]}};
}

std::vector<Node> sorted_once(std::vector<Node> nodes)
{
  std::sort(nodes.begin(), nodes.end(),
            [](const Node &a, const Node &b) { return a.first_dof < b.first_dof; });
  const auto is_same = [](const Node &a, const Node &b) { return a.first_dof == b.first_dof; };
  nodes.erase(std::unique(nodes.begin(), nodes.end(), is_same), nodes.end());
  return nodes;
}
} // namespace

Discretization::Discretization(const meshes::TriangleMesh &mesh, const unsigned int order,
                               const MPI_Comm communicator, const unsigned int n_components)
    : mesh(mesh)
    , order(order)
    , n_components(n_components)
    , communicator(communicator)
    , element(FE_SimplexP<2>(order), n_components)
    , mapping(FE_SimplexP<2>(1))
    , stiffness_quadrature(QGaussSimplex<2>(order))
    , nonlinear_quadrature(QWitherdenVincentSimplex<2>(order))
    , triangulation(communicator, Triangulation<2>::none, false, // no cell is artificial
                    parallel::shared::Triangulation<2>::Settings::partition_metis)
    , dof_handler(triangulation)
{
  create(mesh, triangulation);
  dof_handler.distribute_dofs(element);
  locally_owned  = dof_handler.locally_owned_dofs();
  locally_active = DoFTools::extract_locally_active_dofs(dof_handler);
}

FEValues<2> Discretization::fe_values(const Quadrature<2> &quadrature,
                                      const UpdateFlags flags) const
{
  return {mapping, element, quadrature, flags};
}

std::vector<Node> Discretization::nodes() const
{
  std::vector<Node> of_cells;
  for_owned_cells(
    [&](const Cell &cell, const std::vector<types::global_dof_index> &dofs)
    {
      for (unsigned int k = 0; k < dofs.size() / n_components; ++k)
        of_cells.push_back(node_of(cell, k, dofs));
    });
  return sorted_once(std::move(of_cells));
}

std::vector<Node> Discretization::boundary_nodes() const
{
  std::vector<Node> nodes;
  std::vector<types::global_dof_index> dofs(element.n_dofs_per_cell());
  for (const auto &cell : dof_handler.active_cell_iterators())
    for (const unsigned int side : cell->face_indices())
      if (cell->face(side)->at_boundary())
      {
        cell->get_dof_indices(dofs);
        nodes.push_back(node_of(cell, side, dofs));
        nodes.push_back(node_of(cell, (side + 1) % 3, dofs));
        if (order == 2)
          nodes.push_back(node_of(cell, 3 + side, dofs));
      }
  return sorted_once(std::move(nodes));
}

DofTable Discretization::vertex_dofs() const
{
  DofTable of_vertex =
    DofTable::Constant(mesh.n_vertices(), n_components, numbers::invalid_dof_index);
  for (const auto &cell : dof_handler.active_cell_iterators())
    for (const unsigned int k : cell->vertex_indices())
      for (unsigned int c = 0; c < n_components; ++c)
        of_vertex(static_cast<Eigen::Index>(cell->vertex_index(k)), c) =
          cell->vertex_dof_index(k, c);
  return of_vertex;
}
} // namespace homespun::homogenization
