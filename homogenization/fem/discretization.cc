// SPDX-License-Identifier: MIT
#include "homogenization/fem/discretization.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>

#include <Eigen/LU>

#include <algorithm>

namespace homespun::homogenization
{
using namespace dealii;

namespace
{
void make_serial(const meshes::TriangleMesh &mesh, Triangulation<2> &triangulation)
{
  std::vector<Point<2>> points(static_cast<std::size_t>(mesh.n_vertices()));
  for (std::size_t v = 0; v < points.size(); ++v)
    points[v] = {mesh.vertices(static_cast<Eigen::Index>(v), 0),
                 mesh.vertices(static_cast<Eigen::Index>(v), 1)};
  std::vector<CellData<2>> cells(static_cast<std::size_t>(mesh.n_triangles()), CellData<2>(3));
  for (std::size_t t = 0; t < cells.size(); ++t)
    for (int k = 0; k < 3; ++k)
      cells[t].vertices[static_cast<std::size_t>(k)] =
        static_cast<unsigned int>(mesh.triangles(static_cast<Eigen::Index>(t), k));
  triangulation.create_triangulation(points, cells, SubCellData());
}

/// Ranks to which one of them hands out the parts of the mesh: of so many one holds the whole, and
/// goes through it once for each of the others.
constexpr int ranks_per_group = 8;

std::unique_ptr<Triangulation<2>> make_triangulation(const meshes::TriangleMesh &mesh,
                                                     const MPI_Comm communicator)
{
  if (Utilities::MPI::n_mpi_processes(communicator) == 1)
  {
    auto serial = std::make_unique<Triangulation<2>>();
    make_serial(mesh, *serial);
    return serial;
  }
  // One rank of each group makes the whole triangulation, cuts it, hands out the parts and forgets
  // it.
  const auto description =
    TriangulationDescription::Utilities::create_description_from_triangulation_in_groups<2, 2>(
      [&mesh](Triangulation<2> &serial) { make_serial(mesh, serial); },
      [](Triangulation<2> &serial, const MPI_Comm &ranks, const unsigned int)
      { GridTools::partition_triangulation(Utilities::MPI::n_mpi_processes(ranks), serial); },
      communicator, ranks_per_group);
  auto distributed = std::make_unique<parallel::fullydistributed::Triangulation<2>>(communicator);
  distributed->create_triangulation(description);
  return distributed;
}

ReferenceElement reference_element(const FiniteElement<2> &element, const Quadrature<2> &quadrature)
{
  ReferenceElement reference;
  reference.n_shapes = element.n_dofs_per_cell();
  reference.weights  = quadrature.get_weights();
  for (const Point<2> &point : quadrature.get_points())
  {
    std::vector<Eigen::Vector2d> gradients;
    for (unsigned int i = 0; i < reference.n_shapes; ++i)
    {
      const Tensor<1, 2> gradient = element.shape_grad(i, point);
      gradients.emplace_back(gradient[0], gradient[1]);
    }
    reference.gradients.push_back(std::move(gradients));
  }
  return reference;
}
} // namespace

Discretization::Discretization(const meshes::TriangleMesh &mesh, const unsigned int order,
                               const MPI_Comm communicator, const unsigned int n_components)
    : mesh(mesh)
    , order(order)
    , n_components(n_components)
    , communicator(communicator)
    , triangulation(make_triangulation(mesh, communicator))
    , element(FE_SimplexP<2>(order), n_components)
    , dof_handler(*triangulation)
{
  dof_handler.distribute_dofs(element);
  locally_owned = dof_handler.locally_owned_dofs();
  DoFTools::extract_locally_relevant_dofs(dof_handler, locally_relevant);

  // The assembly counts on node-wise numbering inside an element, DoF n_components i + c being
  // component c of shape i, and in the whole: the components of a node follow one another.
  for (unsigned int i = 0; i < element.n_dofs_per_cell(); ++i)
    AssertThrow(element.system_to_component_index(i) ==
                  std::make_pair(i % n_components, i / n_components),
                ExcInternalError());
  std::vector<types::global_dof_index> dofs(element.n_dofs_per_cell());
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (!cell->is_artificial())
    {
      cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        AssertThrow(dofs[i] == dofs[i - i % n_components] + i % n_components, ExcInternalError());
    }
  const FE_SimplexP<2> scalar(order);
  const Quadrature<2> three_points({{1. / 6., 1. / 6.}, {2. / 3., 1. / 6.}, {1. / 6., 2. / 3.}},
                                   {1. / 6., 1. / 6., 1. / 6.});
  const Quadrature<2> one_point = QWitherdenVincentSimplex<2>(1);
  stiffness_quadrature          = reference_element(scalar, order == 1 ? one_point : three_points);
  nonlinear_quadrature =
    reference_element(scalar, order == 1 ? one_point : QWitherdenVincentSimplex<2>(2));
}

unsigned int Discretization::triangle_of(const DoFHandler<2>::active_cell_iterator &cell)
{
  return static_cast<unsigned int>(cell->id().get_coarse_cell_id());
}

Eigen::RowVector2d Discretization::point_of(const DoFHandler<2>::active_cell_iterator &cell,
                                            const unsigned int shape) const
{
  const auto triangle            = mesh.triangles.row(triangle_of(cell));
  const Eigen::RowVector2d point = mesh.vertices.row(triangle(shape % 3));
  if (shape < 3)
    return point;
  return 0.5 * (point + mesh.vertices.row(triangle((shape + 1) % 3))); // of edge (k, k + 1)
}

std::vector<Node> Discretization::owned_nodes() const
{
  std::vector<Node> nodes;
  nodes.reserve(locally_owned.n_elements() / n_components);
  std::vector<char> is_listed(locally_owned.n_elements(), 0);
  std::vector<types::global_dof_index> dofs(element.n_dofs_per_cell());
  for (const auto &cell : dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    cell->get_dof_indices(dofs);
    for (unsigned int shape = 0; shape < dofs.size() / n_components; ++shape)
    {
      const types::global_dof_index dof = dofs[n_components * shape];
      if (!locally_owned.is_element(dof) || is_listed[locally_owned.index_within_set(dof)])
        continue;
      is_listed[locally_owned.index_within_set(dof)] = 1;
      nodes.push_back({dof, dof + 1, point_of(cell, shape)});
    }
  }
  return nodes;
}

std::vector<Node> Discretization::boundary_nodes() const
{
  // Doubles carry the DoF indices through one gather; they are exact up to 2^53.
  std::vector<double> mine;
  std::vector<types::global_dof_index> dofs(element.n_dofs_per_cell());
  const auto emit = [&](const unsigned int shape, const Eigen::RowVector2d &point)
  {
    const types::global_dof_index dof = dofs[n_components * shape];
    if (locally_owned.is_element(dof))
      mine.insert(mine.end(), {static_cast<double>(dof), point(0), point(1)});
  };
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (!cell->is_artificial() && cell->at_boundary())
    {
      cell->get_dof_indices(dofs);
      for (const unsigned int face : cell->face_indices())
        if (cell->face(face)->at_boundary())
        {
          // Face k of a triangle runs from vertex k to vertex k + 1.
          emit(face, point_of(cell, face));
          emit((face + 1) % 3, point_of(cell, (face + 1) % 3));
          if (order == 2)
            emit(3 + face, point_of(cell, 3 + face));
        }
    }

  std::vector<Node> nodes;
  for (const std::vector<double> &part : Utilities::MPI::all_gather(communicator, mine))
    for (std::size_t k = 0; k < part.size(); k += 3)
    {
      const auto dof = static_cast<types::global_dof_index>(part[k]);
      nodes.push_back({dof, dof + 1, {part[k + 1], part[k + 2]}});
    }
  std::sort(nodes.begin(), nodes.end(),
            [](const Node &a, const Node &b) { return a.first_dof < b.first_dof; });
  nodes.erase(std::unique(nodes.begin(), nodes.end(),
                          [](const Node &a, const Node &b) { return a.first_dof == b.first_dof; }),
              nodes.end());
  return nodes;
}

DofTable Discretization::vertex_dofs() const
{
  DofTable of_vertex;
  of_vertex.setZero(mesh.n_vertices(), n_components);
  std::vector<types::global_dof_index> dofs(element.n_dofs_per_cell());
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      cell->get_dof_indices(dofs);
      for (int k = 0; k < 3; ++k)
        for (unsigned int c = 0; c < n_components; ++c)
          of_vertex(mesh.triangles(triangle_of(cell), k), c) =
            dofs[n_components * static_cast<unsigned int>(k) + c];
    }
  // Ranks that share a vertex agree on its DoF; the others hold zero.
  MPI_Allreduce(MPI_IN_PLACE, of_vertex.data(), static_cast<int>(of_vertex.size()),
                DEAL_II_DOF_INDEX_MPI_TYPE, MPI_MAX, communicator);
  return of_vertex;
}

AffineTriangle::AffineTriangle(const meshes::TriangleMesh &mesh, const unsigned int triangle)
{
  const Eigen::RowVector2d x0 = mesh.vertices.row(mesh.triangles(triangle, 0));
  Eigen::Matrix2d jacobian;
  jacobian.col(0)   = (mesh.vertices.row(mesh.triangles(triangle, 1)) - x0).transpose();
  jacobian.col(1)   = (mesh.vertices.row(mesh.triangles(triangle, 2)) - x0).transpose();
  determinant       = jacobian.determinant();
  inverse_transpose = jacobian.inverse().transpose();
}
} // namespace homespun::homogenization
