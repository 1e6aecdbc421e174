// SPDX-License-Identifier: MIT
// One cell of a strip that is periodic along one lattice vector, condensed onto its two sides along
// the other: what a row of cells of any length is put together from, and what tells by which factor
// fields decay along it.
#pragma once

#include "homogenization/algebra/cholesky_factor.h"
#include "homogenization/edges/cell_elements.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <memory>
#include <vector>

namespace homespun::homogenization
{
/// Stiffness between the DoFs of the first side of a cell and of its second, in one order [N/m].
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
/// says it: u in cell k is l^k u. Four roots lie at 1, two translations and two uniform tractions;
/// the others come in pairs l and 1/l. The matrix X that takes the first side of a cell to its
/// second in an endless row solves D_12 X² + (D_11 + D_22) X + D_21 = 0 and has the translations
/// and all |l| < 1.
struct Decay
{
  double factor   = 0.; ///< the largest |l| < 1
  double residual = 0.; ///< of the equation of X, relative
};

/// @throws NotConverged where it is 0.999 or above, or a part of the cell moves freely
Decay decay_of(const SideStiffness &sides);

/// The cell in a strip along lattice vector 1 − axis, which is cut across lattice vector `axis`.
class CondensedCell
{
public:
  /// @throws NotConverged where a part of the cell hangs on neither side
  CondensedCell(const CellElements &elements, int axis);

  /// Fields of the whole cell from those of its sides, forces within being zero.
  /// @param first, second (2 n_side,loads) [m]
  /// @return (2 (n_classes + n_side),loads): nodes of each class, then those of the second side
  Eigen::MatrixXd expanded(const Eigen::MatrixXd &first, const Eigen::MatrixXd &second) const;

  /// A linear functional of the fields of the cell as one of its sides', for expanded fields.
  /// @param functional (2 (n_classes + n_side)) as a row of expanded()
  /// @return (4 n_side): first side, then second
  Eigen::VectorXd condensed(const Eigen::VectorXd &functional) const;

  /// Node of a triangle's shape among those of expanded().
  int strip_node(int triangle, int shape) const
  {
    return strip_node_of[static_cast<std::size_t>(elements.nodes(triangle, shape))];
  }

  /// Node of a point of the mesh or of its elements among those of expanded().
  int strip_node(int node) const
  {
    return strip_node_of[static_cast<std::size_t>(node)];
  }

  int n_side() const
  {
    return static_cast<int>(side.size());
  }

  int n_strip_nodes() const
  {
    return elements.n_classes + n_side();
  }

  const CellElements &elements;
  const int axis;
  std::vector<int> side; ///< classes that lie on the sides
  SideStiffness stiffness;

private:
  void number_nodes();
  void condense(const std::vector<Eigen::Triplet<double>> &entries);

  std::vector<int> strip_node_of; ///< of each node
  /// Of each DoF of expanded() its row among those within, or −1 − its row among those of the
  /// sides, first then second.
  std::vector<int> place;
  int n_inner = 0;
  std::unique_ptr<CholeskyFactor> factor; ///< of the nodes within
  Eigen::SparseMatrix<double> coupling;   ///< (within, sides)
};
} // namespace homespun::homogenization
