// SPDX-License-Identifier: MIT
// Displacement finite elements on a plane triangle mesh: the ground on which the cell problems and
// the fine-scale references stand. It is deal.II's: a triangulation that every rank knows, whose
// triangles METIS deals out, and Lagrange elements of each displacement component. Displacements
// have two components in the plane, or three for a sheet that moves in space above its flat rest
// mesh.
#pragma once

#include "meshes/plain/triangle_mesh.h"

#include <deal.II/base/index_set.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/base/types.h>
#include <deal.II/distributed/shared_tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>

#include <vector>

namespace homespun::homogenization
{
/// A point that carries the displacement components of one node: component c, from 0, has the DoF
/// first_dof + c.
struct Node
{
  dealii::types::global_dof_index first_dof;
  dealii::types::global_dof_index second_dof; ///< of component 1
  Eigen::RowVector2d point;                   ///< [m]
};

/// The DoFs of vertices, (n, components).
using DofTable =
  Eigen::Matrix<dealii::types::global_dof_index, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// P1 or P2 displacements on a mesh. Cell t of the triangulation is triangle t of the mesh, its
/// material id the phase; shapes of a cell go node after node, corners first, then the midpoints of
/// sides (0,1), (1,2), (2,0) of P2, each with all its components.
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
    return dof_handler.n_dofs();
  }

  /// Values of the cells that this rank owns.
  dealii::FEValues<2> fe_values(const dealii::Quadrature<2> &quadrature,
                                dealii::UpdateFlags flags = dealii::update_gradients |
                                                            dealii::update_JxW_values) const;

  /// Calls work(cell, dofs) for each cell that this rank owns, with the DoFs of its shapes.
  template <typename Work>
  void for_owned_cells(const Work &work) const
  {
    std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        cell->get_dof_indices(dofs);
        work(cell, dofs);
      }
  }

  /// The nodes of the cells that this rank owns, some of which another rank owns, sorted by DoF.
  std::vector<Node> nodes() const;

  /// The nodes on the boundary of the mesh, of all ranks, sorted by DoF.
  std::vector<Node> boundary_nodes() const;

  /// The DoFs of all mesh vertices, (n, n_components), on every rank.
  DofTable vertex_dofs() const;

  const meshes::TriangleMesh mesh;
  const unsigned int order;
  const unsigned int n_components;
  const MPI_Comm communicator;

  const dealii::FESystem<2> element;
  const dealii::MappingFE<2> mapping; ///< of straight triangles
  /// Exact for the quadratic form of a linear law: of degree 0 for P1, 2 for P2.
  const dealii::Quadrature<2> stiffness_quadrature;
  /// For laws that are not quadratic: 1 point for P1 (F is constant), 6 (degree 4) for P2.
  const dealii::Quadrature<2> nonlinear_quadrature;
  dealii::parallel::shared::Triangulation<2> triangulation;
  dealii::DoFHandler<2> dof_handler;
  dealii::IndexSet locally_owned;
  dealii::IndexSet locally_active; ///< those of the cells that this rank owns
};
} // namespace homespun::homogenization
