// SPDX-License-Identifier: MIT
#include "homogenization/fem/discretization.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <Eigen/LU>

#include <algorithm>

namespace homespun::homogenization
{
using namespace dealii;

namespace
{
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
    , shapes(order)
    , n_dofs_per_triangle(n_components * shapes.n_dofs_per_cell())
{
  const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator),
                     rank    = Utilities::MPI::this_mpi_process(communicator);
  const meshes::TriangleSides sides(mesh);
  const std::vector<unsigned int> parts = parts_of(mesh, n_ranks);
  const NodeNumbers numbers(mesh, sides, order, parts, n_ranks);
  first_dof_of_vertex.reserve(numbers.of_vertex.size());
  for (const unsigned int number : numbers.of_vertex)
    first_dof_of_vertex.push_back(first_dof(number));
  find_near_triangles(parts, rank);
  list_dofs(sides, numbers, rank);
  list_boundary_nodes(sides, numbers);

  const Quadrature<2> three_points({{1. / 6., 1. / 6.}, {2. / 3., 1. / 6.}, {1. / 6., 2. / 3.}},
                                   {1. / 6., 1. / 6., 1. / 6.});
  const Quadrature<2> one_point = QWitherdenVincentSimplex<2>(1);
  stiffness_quadrature          = reference_element(shapes, order == 1 ? one_point : three_points);
  nonlinear_quadrature =
    reference_element(shapes, order == 1 ? one_point : QWitherdenVincentSimplex<2>(2));
}

types::global_dof_index Discretization::first_dof(const unsigned int number) const
{
  return static_cast<types::global_dof_index>(n_components) * number;
}

/// The triangles of a rank's part, and those that share a vertex with them.
void Discretization::find_near_triangles(const std::vector<unsigned int> &parts,
                                         const unsigned int rank)
{
  std::vector<char> is_touched(static_cast<std::size_t>(mesh.n_vertices()), 0);
  for (std::size_t t = 0; t < parts.size(); ++t)
    if (parts[t] == rank)
      for (const int vertex : mesh.triangles.row(static_cast<Eigen::Index>(t)))
        is_touched[static_cast<std::size_t>(vertex)] = 1;
  for (std::size_t t = 0; t < parts.size(); ++t)
  {
    const auto corners = mesh.triangles.row(static_cast<Eigen::Index>(t));
    if (std::none_of(corners.begin(), corners.end(),
                     [&](const int vertex)
                     { return is_touched[static_cast<std::size_t>(vertex)]; }))
      continue;
    near_triangles.push_back(static_cast<unsigned int>(t));
    is_owned.push_back(parts[t] == rank);
  }
}

/// DoFs of the triangles that are near, of the rank, and of those triangles.
void Discretization::list_dofs(const meshes::TriangleSides &sides, const NodeNumbers &numbers,
                               const unsigned int rank)
{
  const unsigned int begin = numbers.begin_of_part[rank], end = numbers.begin_of_part[rank + 1];
  std::vector<unsigned int> foreign;
  const auto add = [&](const unsigned int number)
  {
    first_dofs.push_back(first_dof(number));
    if (number < begin || number >= end)
      foreign.push_back(number);
  };
  first_dofs.reserve(near_triangles.size() * shapes.n_dofs_per_cell());
  for (const unsigned int t : near_triangles)
  {
    for (const int vertex : mesh.triangles.row(t))
      add(numbers.of_vertex[static_cast<std::size_t>(vertex)]);
    if (order == 2)
      for (const int side : sides.of_triangle.row(t))
        add(numbers.of_side[static_cast<std::size_t>(side)]);
  }
  locally_owned.set_size(first_dof(numbers.n()));
  locally_owned.add_range(first_dof(begin), first_dof(end));
  locally_owned.compress();
  locally_relevant = locally_owned;
  std::sort(foreign.begin(), foreign.end());
  foreign.erase(std::unique(foreign.begin(), foreign.end()), foreign.end());
  for (const unsigned int number : foreign)
    locally_relevant.add_range(first_dof(number), first_dof(number + 1));
  locally_relevant.compress();
}

void Discretization::list_boundary_nodes(const meshes::TriangleSides &sides,
                                         const NodeNumbers &numbers)
{
  const auto add = [&](const unsigned int number, const int triangle, const int shape)
  {
    const types::global_dof_index dof = first_dof(number);
    on_boundary.push_back(
      {dof, dof + 1,
       point_of(static_cast<unsigned int>(triangle), static_cast<unsigned int>(shape))});
  };
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const auto side = static_cast<std::size_t>(sides.of_triangle(t, k));
      if (sides.n_triangles[side] > 1)
        continue;
      for (const int corner : {k, (k + 1) % 3})
        add(numbers.of_vertex[static_cast<std::size_t>(mesh.triangles(t, corner))], t, corner);
      if (order == 2)
        add(numbers.of_side[side], t, 3 + k);
    }
  std::sort(on_boundary.begin(), on_boundary.end(),
            [](const Node &a, const Node &b) { return a.first_dof < b.first_dof; });
  on_boundary.erase(std::unique(on_boundary.begin(), on_boundary.end(),
                                [](const Node &a, const Node &b)
                                { return a.first_dof == b.first_dof; }),
                    on_boundary.end());
}

Eigen::RowVector2d Discretization::point_of(const unsigned int triangle,
                                            const unsigned int shape) const
{
  const auto corners             = mesh.triangles.row(triangle);
  const Eigen::RowVector2d point = mesh.vertices.row(corners(shape % 3));
  if (shape < 3)
    return point;
  return 0.5 * (point + mesh.vertices.row(corners((shape + 1) % 3))); // of side (k, k + 1)
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
        nodes.push_back({dof, dof + 1, point_of(t, shape)});
      }
    });
  return nodes;
}

DofTable Discretization::vertex_dofs() const
{
  DofTable of_vertex(mesh.n_vertices(), n_components);
  for (Eigen::Index v = 0; v < of_vertex.rows(); ++v)
    for (unsigned int c = 0; c < n_components; ++c)
      of_vertex(v, c) = first_dof_of_vertex[static_cast<std::size_t>(v)] + c;
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
