// SPDX-License-Identifier: MIT
// One cell of a strip that is periodic along one lattice vector, condensed onto its two sides along
// the other: what a row of cells of any length is put together from, and what tells by which factor
// fields decay along it.
#pragma once

#include "homogenization/algebra/cholesky_factor.h"
#include "homogenization/edges/cell_elements.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <functional>
#include <memory>
#include <vector>

namespace homespun::homogenization
{
/// Stiffness between the DoFs of the first side of a cell and of its second, in one order.
struct SideStiffness
{
  Eigen::MatrixXd first, across, second; ///< D_11, D_12, D_22; D_21 is D_12^T

  /// The same seen from the other end.
  SideStiffness turned() const
  {
    return {second, across.transpose(), first};
  }
};

/// How fields decay along a row of cells. The Floquet problem D_12 l² + (D_11 + D_22) l + D_21 = 0
/// says it: u in cell k is l^k u. Four roots lie at 1: in a membrane two translations and two
/// uniform tractions, in a plate a translation, a turn, a moment and a shear force; the others come
/// in pairs l and 1/l. The matrix X that takes the first side of a cell to its second in an endless
/// row solves D_12 X² + (D_11 + D_22) X + D_21 = 0 and has the rigid motions and all |l| < 1.
struct Decay
{
  double factor   = 0.; ///< the largest |l| < 1
  double residual = 0.; ///< of the equation of X, relative
};

class CondensedCell;

/// A stiffness of a side without what rounding makes of it: it is symmetric, and rigid motions feel
/// nothing.
/// @param rigid orthonormal (n_side_dofs,2)
Eigen::MatrixXd rounded_off(const Eigen::MatrixXd &stiffness, const Eigen::MatrixXd &rigid);

/// @throws NotConverged where the factor is 0.999 or above, or a part of the cell moves freely
Decay decay_of(const CondensedCell &cell);

/// What the triangles of a strip are: P1 or P2 of a membrane, or a plate's.
struct StripElements
{
  /// Of a node of each shape of CellElements. The DoFs of a triangle are those of its nodes, those
  /// of the glued cell those of its classes, in their order.
  std::vector<int> dofs_of_shape;
  std::function<Eigen::MatrixXd(int)> stiffness; ///< of a triangle, between its DoFs
  /// How a side moves that is rigid and periodic along the strip (n_side_dofs,2), any basis.
  std::function<Eigen::MatrixXd(const CondensedCell &)> rigid;
};

/// The cell in a strip along lattice vector 1 − axis, which is cut across lattice vector `axis`.
/// Its DoFs are those of the glued cell, then those of its second side.
class CondensedCell
{
public:
  /// @throws NotConverged where a part of the cell hangs on neither side
  CondensedCell(const CellElements &elements, int axis, const StripElements &of);

  /// Fields of the whole cell from those of its sides, forces within being zero.
  /// @param first, second (n_side_dofs,loads)
  /// @return (n_dofs,loads)
  Eigen::MatrixXd expanded(const Eigen::MatrixXd &first, const Eigen::MatrixXd &second) const;

  /// A linear functional of the fields of the cell as one of its sides', for expanded fields.
  /// @param functional (n_dofs)
  /// @return (2 n_side_dofs): first side, then second
  Eigen::VectorXd condensed(const Eigen::VectorXd &functional) const;

  /// Those of a triangle, as its stiffness has them.
  std::vector<int> dofs_of(int triangle) const;

  /// The first of a point of the mesh or of its elements; the others follow.
  int first_dof(const int node) const
  {
    return first_dof_of[static_cast<std::size_t>(node)];
  }

  int n_side_dofs() const
  {
    return static_cast<int>(side.size());
  }

  int n_dofs() const
  {
    return n_glued + n_side_dofs();
  }

  const CellElements &elements;
  const int axis;
  std::vector<int> side; ///< DoFs of the glued cell that lie on the sides
  Eigen::MatrixXd rigid; ///< motions of a side, orthonormal (n_side_dofs,2)
  SideStiffness stiffness;

private:
  void number_dofs();
  void condense(const std::vector<Eigen::Triplet<double>> &entries);

  const std::vector<int> dofs_of_shape;
  int n_glued = 0;               ///< DoFs of the glued cell
  std::vector<int> first_dof_of; ///< of each node
  /// Of each DoF of expanded() its row among those within, or −1 − its row among those of the
  /// sides, first then second.
  std::vector<int> place;
  int n_inner = 0;
  std::unique_ptr<CholeskyFactor> factor; ///< of the DoFs within
  Eigen::SparseMatrix<double> coupling;   ///< (within, sides)
};
} // namespace homespun::homogenization
