// SPDX-License-Identifier: MIT
#include "homogenization/fem/discretization.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/grid/cell_id.h>
#include <deal.II/grid/tria_description.h>

#include <Eigen/LU>

#include <algorithm>
#include <numeric>
#include <utility>

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

using Order = std::vector<unsigned int>::iterator;

/// Gives the triangles of an interval the parts from the first on.
void cut(const Eigen::MatrixX2d &centres, const Order begin, const Order end,
         const unsigned int first_part, const unsigned int n_parts, std::vector<unsigned int> &part)
{
  if (n_parts == 1)
  {
    for (Order t = begin; t != end; ++t)
      part[*t] = first_part;
    return;
  }
  if (begin == end)
    return;
  Eigen::RowVector2d lowest  = centres.row(*begin);
  Eigen::RowVector2d highest = lowest;
  for (Order t = begin; t != end; ++t)
  {
    lowest  = lowest.cwiseMin(centres.row(*t));
    highest = highest.cwiseMax(centres.row(*t));
  }
  Eigen::Index axis = 0;
  (highest - lowest).maxCoeff(&axis);
  const unsigned int n_left = n_parts / 2;
  const Order middle        = begin + (end - begin) * n_left / n_parts;
  std::nth_element(begin, middle, end,
                   [&](const unsigned int one, const unsigned int other) {
                     return std::make_pair(centres(one, axis), one) <
                            std::make_pair(centres(other, axis), other);
                   });
  cut(centres, begin, middle, first_part, n_left, part);
  cut(centres, middle, end, first_part + n_left, n_parts - n_left, part);
}

/// What this rank needs of the mesh: the triangles of its part, and those that share a vertex with
/// them, of whom it learns whose they are. Written here, because deal.II's way goes over the whole
/// triangulation on one rank, once for each of the others.
TriangulationDescription::Description<2, 2> part_of(const meshes::TriangleMesh &mesh,
                                                    const MPI_Comm communicator)
{
  const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
  const std::vector<unsigned int> parts =
    parts_of(mesh, Utilities::MPI::n_mpi_processes(communicator));
  std::vector<char> is_touched(static_cast<std::size_t>(mesh.n_vertices()), 0);
  for (std::size_t t = 0; t < parts.size(); ++t)
    if (parts[t] == rank)
      for (const int vertex : mesh.triangles.row(static_cast<Eigen::Index>(t)))
        is_touched[static_cast<std::size_t>(vertex)] = 1;

  TriangulationDescription::Description<2, 2> part;
  part.comm      = communicator;
  part.settings  = TriangulationDescription::Settings::default_setting;
  part.smoothing = Triangulation<2>::MeshSmoothing::none;
  part.cell_infos.resize(1);
  constexpr unsigned int unknown = numbers::invalid_unsigned_int;
  std::vector<unsigned int> place(static_cast<std::size_t>(mesh.n_vertices()), unknown);
  for (std::size_t t = 0; t < parts.size(); ++t)
  {
    const Eigen::RowVector3i corners = mesh.triangles.row(static_cast<Eigen::Index>(t));
    if (std::none_of(corners.begin(), corners.end(),
                     [&](const int vertex)
                     { return is_touched[static_cast<std::size_t>(vertex)]; }))
      continue;
    dealii::CellData<2> cell(3);
    for (int k = 0; k < 3; ++k)
    {
      unsigned int &its = place[static_cast<std::size_t>(corners(k))];
      if (its == unknown)
      {
        its = static_cast<unsigned int>(part.coarse_cell_vertices.size());
        part.coarse_cell_vertices.emplace_back(mesh.vertices(corners(k), 0),
                                               mesh.vertices(corners(k), 1));
      }
      cell.vertices[static_cast<std::size_t>(k)] = its;
    }
    part.coarse_cells.push_back(cell);
    part.coarse_cell_index_to_coarse_cell_id.push_back(t);
    TriangulationDescription::CellData<2> info;
    info.id                 = CellId(t, std::vector<std::uint8_t>()).to_binary<2>();
    info.subdomain_id       = parts[t];
    info.level_subdomain_id = numbers::artificial_subdomain_id;
    info.manifold_id        = numbers::flat_manifold_id;
    info.manifold_line_ids.fill(numbers::flat_manifold_id);
    info.manifold_quad_ids.fill(numbers::flat_manifold_id);
    part.cell_infos[0].push_back(info);
  }
  return part;
}

std::unique_ptr<Triangulation<2>> make_triangulation(const meshes::TriangleMesh &mesh,
                                                     const MPI_Comm communicator)
{
  if (Utilities::MPI::n_mpi_processes(communicator) == 1)
  {
    auto serial = std::make_unique<Triangulation<2>>();
    make_serial(mesh, *serial);
    return serial;
  }
  auto distributed = std::make_unique<parallel::fullydistributed::Triangulation<2>>(communicator);
  distributed->create_triangulation(part_of(mesh, communicator));
  return distributed;
}

/// The point of a shape of a triangle: a vertex, then the midpoints of its edges (P2).
Eigen::RowVector2d point_in(const meshes::TriangleMesh &mesh, const unsigned int triangle,
                            const unsigned int shape)
{
  const auto corners             = mesh.triangles.row(triangle);
  const Eigen::RowVector2d point = mesh.vertices.row(corners(shape % 3));
  if (shape < 3)
    return point;
  return 0.5 * (point + mesh.vertices.row(corners((shape + 1) % 3))); // of edge (k, k + 1)
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
      if (!cell->is_locally_owned())
        continue;
      owned_triangles.push_back(triangle_of(cell));
      for (unsigned int i = 0; i < dofs.size(); i += n_components)
        first_dofs.push_back(dofs[i]);
    }
  const FE_SimplexP<2> scalar(order);
  const Quadrature<2> three_points({{1. / 6., 1. / 6.}, {2. / 3., 1. / 6.}, {1. / 6., 2. / 3.}},
                                   {1. / 6., 1. / 6., 1. / 6.});
  const Quadrature<2> one_point = QWitherdenVincentSimplex<2>(1);
  stiffness_quadrature          = reference_element(scalar, order == 1 ? one_point : three_points);
  nonlinear_quadrature =
    reference_element(scalar, order == 1 ? one_point : QWitherdenVincentSimplex<2>(2));
}

void Discretization::forget_triangulation()
{
  dof_handler.reinit(nothing);
  triangulation.reset();
}

unsigned int Discretization::triangle_of(const DoFHandler<2>::active_cell_iterator &cell)
{
  return static_cast<unsigned int>(cell->id().get_coarse_cell_id());
}

Eigen::RowVector2d Discretization::point_of(const DoFHandler<2>::active_cell_iterator &cell,
                                            const unsigned int shape) const
{
  return point_in(mesh, triangle_of(cell), shape);
}

std::vector<Node> Discretization::owned_nodes() const
{
  std::vector<Node> nodes;
  nodes.reserve(locally_owned.n_elements() / n_components);
  std::vector<bool> is_listed(locally_owned.n_elements(), false);
  for_owned_triangles(
    [&](const unsigned int t, const std::vector<types::global_dof_index> &dofs)
    {
      for (unsigned int shape = 0; shape < dofs.size() / n_components; ++shape)
      {
        const types::global_dof_index dof = dofs[n_components * shape];
        if (!locally_owned.is_element(dof) || is_listed[locally_owned.index_within_set(dof)])
          continue;
        is_listed[locally_owned.index_within_set(dof)] = true;
        nodes.push_back({dof, dof + 1, point_in(mesh, t, shape)});
      }
    });
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
  for_owned_triangles(
    [&](const unsigned int t, const std::vector<types::global_dof_index> &dofs)
    {
      for (int k = 0; k < 3; ++k)
        for (unsigned int c = 0; c < n_components; ++c)
          of_vertex(mesh.triangles(t, k), c) =
            dofs[n_components * static_cast<unsigned int>(k) + c];
    });
  // Ranks that share a vertex agree on its DoF; the others hold zero.
  MPI_Allreduce(MPI_IN_PLACE, of_vertex.data(), static_cast<int>(of_vertex.size()),
                DEAL_II_DOF_INDEX_MPI_TYPE, MPI_MAX, communicator);
  return of_vertex;
}

std::vector<unsigned int> parts_of(const meshes::TriangleMesh &mesh, const unsigned int n_parts)
{
  const auto n = static_cast<std::size_t>(mesh.n_triangles());
  Eigen::MatrixX2d centres(mesh.n_triangles(), 2);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    centres.row(t) =
      (mesh.vertices.row(mesh.triangles(t, 0)) + mesh.vertices.row(mesh.triangles(t, 1)) +
       mesh.vertices.row(mesh.triangles(t, 2))) /
      3.;
  std::vector<unsigned int> order(n), part(n);
  std::iota(order.begin(), order.end(), 0u);
  cut(centres, order.begin(), order.end(), 0, n_parts, part);
  return part;
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
