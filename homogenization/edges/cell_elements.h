// SPDX-License-Identifier: MIT
// Displacement elements on one cell whose outline is the parallelogram of its lattice, with the
// nodes that are lattice images of each other in one class, those of the glued cell: the ground of
// the half strips at edges.
#pragma once

#include "homogenization/cell/torus_mesh.h"
#include "homogenization/cell/unit_cell.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::homogenization
{
/// A point of quadrature in a triangle.
struct ElementPoint
{
  Eigen::Matrix<double, 3, Eigen::Dynamic> strains; ///< (3,2n) of the DoFs, x y x y ... [1/m]
  Eigen::VectorXd values;                           ///< (n) of the shapes [-]
  double weight = 0.;                               ///< [m^2]
};

/// P1 or P2 on the straight triangles of a cell, exact for products of a stress and a displacement.
class CellElements
{
public:
  /// @param order 1 or 2
  /// @throws BadInput where the outline is not the parallelogram of the lattice: then no edge of
  ///   a sheet is a lattice line
  CellElements(const UnitCell &cell, unsigned int order);

  /// Points of quadrature of a triangle.
  std::vector<ElementPoint> points_of(int triangle) const;

  /// Membrane stiffness of a triangle (3,3) [N/m].
  const Eigen::Matrix3d &stiffness_of(int triangle) const;

  /// Lattice coordinates of a point, 0 to 1 from one edge of the cell to the other.
  Eigen::RowVector2d fraction(const Eigen::RowVector2d &point) const;

  /// Of each node the length along the edge of the cell where lattice coordinate `axis` is 0, of
  /// its class: integral of its shape along that edge (n_classes) [m].
  Eigen::VectorXd lengths_on_edge(int axis) const;

  int n_triangles() const
  {
    return static_cast<int>(nodes.rows());
  }

  int n_shapes() const
  {
    return static_cast<int>(nodes.cols());
  }

  const UnitCell &cell;
  const TorusMesh torus; ///< the cell, glued
  meshes::Points points; ///< of the nodes; those of the mesh come first [m]
  Eigen::MatrixXi nodes; ///< (m,shapes) of each triangle
  std::vector<int>
    class_of; ///< of each node: a vertex of the torus, or one of its edges after them
  const int n_classes;
  const std::vector<Eigen::Matrix3d> stiffness_of_phase;

private:
  Eigen::RowVector2d origin;
};

/// The cell problem in these elements.
struct ElementCellProblem
{
  Eigen::MatrixXd w;         ///< (2 n_classes,3), mean zero over the cell [m]
  Eigen::Matrix3d stiffness; ///< C^H, the mean stress [N/m]
};

/// The fluctuations w_a = −chi_a of the unit macro strains, as brackets solve for them
/// (bracket/compatible_strain.h): on one rank, to round-off.
/// The mean that is taken off is that of their values at the vertices, linear in the triangles.
/// @throws NotConverged where a part of the cell moves freely
ElementCellProblem solve_cell(const CellElements &elements);
} // namespace homespun::homogenization
