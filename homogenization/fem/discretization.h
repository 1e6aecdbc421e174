// SPDX-License-Identifier: MIT
// Displacement finite elements on a plane triangle mesh, distributed over MPI ranks: the ground on
// which the cell problems and the fine-scale references stand. Displacements have two components in
// the plane, or three for a sheet that moves in space above its flat rest mesh.
#pragma once

#include "homogenization/fem/mesh_parts.h"
#include "meshes/plain/triangle_mesh.h"

#include <deal.II/base/index_set.h>
#include <deal.II/base/types.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <vector>

namespace homespun::homogenization
{
/// Gradients of the scalar shape functions on the reference triangle, at the quadrature points.
/// Triangles are affine: the physical gradient is J^-T times these, exactly.
struct ReferenceElement
{
  unsigned int n_shapes = 0;                           ///< 3 for P1, 6 for P2
  std::vector<double> weights;                         ///< (q) of the reference triangle, sum ½
  std::vector<std::vector<Eigen::Vector2d>> gradients; ///< (q, shape)
};

/// A point that carries the displacement components of one node: component c has the DoF
/// first_dof + c.
struct Node
{
  dealii::types::global_dof_index first_dof;
  dealii::types::global_dof_index second_dof; ///< of component 2
  Eigen::RowVector2d point;                   ///< [m]
};

/// The DoFs of vertices, (n, components).
using DofTable =
  Eigen::Matrix<dealii::types::global_dof_index, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// P1 or P2 displacements on a mesh: each rank, which knows the mesh, takes its part (mesh_parts.h)
/// and numbers its nodes without asking another.
class Discretization
{
public:
  /// @param mesh read by every rank
  /// @param order 1 or 2
  /// @param n_components of the displacement: 2 in the plane, 3 in space
  Discretization(const meshes::TriangleMesh &mesh, unsigned int order, MPI_Comm communicator,
                 unsigned int n_components = 2);

  /// On all ranks together.
  dealii::types::global_dof_index n_dofs() const
  {
    return locally_owned.size();
  }

  /// The point of a shape of a triangle: a corner, then the midpoints of its sides (P2).
  Eigen::RowVector2d point_of(unsigned int triangle, unsigned int shape) const;

  /// Calls work(t, dofs, is_owned) for each triangle t of the mesh that this rank owns or that
  /// shares a vertex with one of those, with the DoFs of its shapes, node after node.
  template <typename Work>
  void for_near_triangles(const Work &work) const
  {
    const std::size_t n_shapes = n_dofs_per_triangle / n_components;
    std::vector<dealii::types::global_dof_index> dofs(n_dofs_per_triangle);
    for (std::size_t k = 0; k < near_triangles.size(); ++k)
    {
      for (std::size_t i = 0; i < dofs.size(); ++i)
        dofs[i] = first_dofs[k * n_shapes + i / n_components] +
                  static_cast<dealii::types::global_dof_index>(i % n_components);
      work(near_triangles[k], dofs, is_owned[k] != 0);
    }
  }

  /// Calls work(t, dofs) for those that it owns.
  template <typename Work>
  void for_owned_triangles(const Work &work) const
  {
    for_near_triangles(
      [&](const unsigned int t, const std::vector<dealii::types::global_dof_index> &dofs,
          const bool is_own)
      {
        if (is_own)
          work(t, dofs);
      });
  }

  /// The nodes that this rank owns.
  std::vector<Node> owned_nodes() const;

  /// The nodes on the boundary of the mesh, of all ranks, sorted by DoF.
  const std::vector<Node> &boundary_nodes() const
  {
    return on_boundary;
  }

  /// The DoFs of all mesh vertices, (n, n_components), on every rank.
  DofTable vertex_dofs() const;

  const meshes::TriangleMesh mesh;
  const unsigned int order;
  const unsigned int n_components;
  const MPI_Comm communicator;

  const dealii::FE_SimplexP<2> shapes; ///< of one component
  const unsigned int n_dofs_per_triangle;
  dealii::IndexSet locally_owned;
  dealii::IndexSet locally_relevant; ///< of all near triangles
  /// Exact for the quadratic form of a linear law: 1 point for P1, 3 for P2.
  ReferenceElement stiffness_quadrature;
  /// For laws that are not quadratic: 1 point for P1 (F is constant), 6 (degree 4) for P2.
  ReferenceElement nonlinear_quadrature;

private:
  dealii::types::global_dof_index first_dof(unsigned int number) const;
  void find_near_triangles(const std::vector<unsigned int> &parts, unsigned int rank);
  void list_dofs(const meshes::TriangleSides &sides, const NodeNumbers &numbers, unsigned int rank);
  void list_boundary_nodes(const meshes::TriangleSides &sides, const NodeNumbers &numbers);

  std::vector<unsigned int> near_triangles;                ///< ascending
  std::vector<char> is_owned;                              ///< each of these
  std::vector<dealii::types::global_dof_index> first_dofs; ///< (near triangle, shape) of its node
  std::vector<dealii::types::global_dof_index> first_dof_of_vertex;
  std::vector<Node> on_boundary;
};

/// The Jacobian [x1 − x0, x2 − x0] of an affine triangle, as J^-T and det J = twice the area.
struct AffineTriangle
{
  AffineTriangle(const meshes::TriangleMesh &mesh, unsigned int triangle);

  Eigen::Matrix2d inverse_transpose;
  double determinant; ///< [m^2]
};
} // namespace homespun::homogenization
