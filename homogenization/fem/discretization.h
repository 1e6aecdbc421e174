// SPDX-License-Identifier: MIT
// Displacement finite elements on a plane triangle mesh, distributed over MPI ranks: the ground on
// which the cell problems and the fine-scale references stand. Displacements have two components in
// the plane, or three for a sheet that moves in space above its flat rest mesh.
#pragma once

#include "meshes/plain/triangle_mesh.h"

#include <deal.II/base/index_set.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/tria.h>

#include <memory>
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

/// A point that carries the displacement components of one node. Component c has the DoF
/// first_dof + c, which the constructor of Discretization audits.
struct Node
{
  dealii::types::global_dof_index first_dof;
  dealii::types::global_dof_index second_dof; ///< of component 2
  Eigen::RowVector2d point;                   ///< [m]
};

/// The DoFs of vertices, (n, components).
using DofTable =
  Eigen::Matrix<dealii::types::global_dof_index, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// P1 or P2 displacements on a mesh. With one rank the triangulation is serial; with more it is
/// fully distributed: each rank, which knows the mesh, takes its part (parts_of()) and the
/// triangles that touch it, and asks no other.
class Discretization
{
public:
  /// @param mesh read by every rank; triangle t of it is cell t
  /// @param order 1 or 2
  /// @param n_components of the displacement: 2 in the plane, 3 in space
  Discretization(const meshes::TriangleMesh &mesh, unsigned int order, MPI_Comm communicator,
                 unsigned int n_components = 2);

  /// The index in the mesh of the triangle that a cell is.
  static unsigned int triangle_of(const dealii::DoFHandler<2>::active_cell_iterator &cell);

  /// The point of a shape of a cell: a vertex of the triangle, then the midpoints of its edges
  /// (P2).
  Eigen::RowVector2d point_of(const dealii::DoFHandler<2>::active_cell_iterator &cell,
                              unsigned int shape) const;

  /// Calls work(t, dofs) for each triangle t of the mesh that this rank owns, with the DoFs of its
  /// shapes, node after node.
  template <typename Work>
  void for_owned_triangles(const Work &work) const
  {
    const std::size_t n_shapes = stiffness_quadrature.n_shapes;
    std::vector<dealii::types::global_dof_index> dofs(n_components * n_shapes);
    for (std::size_t k = 0; k < owned_triangles.size(); ++k)
    {
      for (std::size_t i = 0; i < dofs.size(); ++i)
        dofs[i] = first_dofs[k * n_shapes + i / n_components] +
                  static_cast<dealii::types::global_dof_index>(i % n_components);
      work(owned_triangles[k], dofs);
    }
  }

  /// Frees triangulation and dof_handler, of which nothing may be asked afterwards. They take more
  /// memory than the matrix of P1, and owned_nodes(), for_owned_triangles() and vertex_dofs() need
  /// neither.
  void forget_triangulation();

  /// The nodes that this rank owns.
  std::vector<Node> owned_nodes() const;

  /// The nodes on the boundary of the mesh, of all ranks, sorted by DoF.
  std::vector<Node> boundary_nodes() const;

  /// The DoFs of all mesh vertices, (n, n_components), on every rank.
  DofTable vertex_dofs() const;

  const meshes::TriangleMesh mesh;
  const unsigned int order;
  const unsigned int n_components;
  const MPI_Comm communicator;

  std::unique_ptr<dealii::Triangulation<2>> triangulation;
  const dealii::Triangulation<2> nothing; ///< of a dof_handler whose triangulation is forgotten
  const dealii::FESystem<2> element;
  dealii::DoFHandler<2> dof_handler;
  dealii::IndexSet locally_owned;
  dealii::IndexSet locally_relevant;
  /// Exact for the quadratic form of a linear law: 1 point for P1, 3 for P2.
  ReferenceElement stiffness_quadrature;
  /// For laws that are not quadratic: 1 point for P1 (F is constant), 6 (degree 4) for P2.
  ReferenceElement nonlinear_quadrature;

private:
  std::vector<unsigned int> owned_triangles;               ///< in the order of the cells
  std::vector<dealii::types::global_dof_index> first_dofs; ///< (triangle, shape) of its node
};

/// The part of each triangle: as many parts as ranks, of equal size to one triangle, by cuts across
/// the longer side of the box of their centres. The same on every rank.
std::vector<unsigned int> parts_of(const meshes::TriangleMesh &mesh, unsigned int n_parts);

/// The Jacobian [x1 − x0, x2 − x0] of an affine triangle, as J^-T and det J = twice the area.
struct AffineTriangle
{
  AffineTriangle(const meshes::TriangleMesh &mesh, unsigned int triangle);

  Eigen::Matrix2d inverse_transpose;
  double determinant; ///< [m^2]
};
} // namespace homespun::homogenization
