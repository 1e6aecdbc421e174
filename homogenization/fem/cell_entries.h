// SPDX-License-Identifier: MIT
// Where the nodal values and the sums of a cell stand in vectors and in the matrix, for loops that
// go over all cells many times.
#pragma once

#include "homogenization/fem/elastic_solver.h"

#include <deal.II/lac/affine_constraints.h>

#include <Eigen/Core>

#include <vector>

namespace homespun::homogenization
{
/// The places of all cells that this rank owns, found once: asking deal.II for the DoFs of a cell,
/// and Trilinos where these stand, takes longer than the integrals of the cell.
///
/// Sums of cells with a DoF that is constrained, or that another rank owns, go the way of all of
/// deal.II, by AffineConstraints::distribute_local_to_global. The others are added in place: on one
/// rank in the same order, so that the sums are the same to the last bit, on several to round-off.
class CellEntries
{
public:
  using Vector = ElasticSolver::Vector;

  /// @param solver whose matrix is laid out for the constraints
  CellEntries(const Discretization &discretization,
              const dealii::AffineConstraints<double> &constraints, ElasticSolver &solver);

  /// Of this rank. A cell is asked for by its number among them, from 0.
  int n_cells() const
  {
    return static_cast<int>(triangles.size());
  }

  /// The cell's number in the mesh.
  int triangle(const int cell) const
  {
    return triangles[static_cast<std::size_t>(cell)];
  }

  /// Whether no DoF of the cell is constrained, and all are this rank's.
  bool is_plain(const int cell) const
  {
    return entries(cell, 0) != not_plain;
  }

  dealii::types::global_dof_index first_dof(const int cell, const int node) const
  {
    return first_dofs(cell, node);
  }

  /// With the values of the cells' nodes that other ranks own.
  Vector with_ghosts(const Vector &owned) const;

  /// Values of a cell's nodes, (node, component).
  /// @param field with_ghosts()
  template <int n_nodes, int n_components>
  Eigen::Matrix<double, n_nodes, n_components, Eigen::RowMajor> values(const Vector &field,
                                                                       const int cell) const
  {
    Eigen::Matrix<double, n_nodes, n_components, Eigen::RowMajor> all;
    for (int k = 0; k < n_nodes; ++k)
      for (int c = 0; c < n_components; ++c)
        all(k, c) = field.begin()[with_ghosts_at(cell, k) + c];
    return all;
  }

  /// Adds the forces on a cell's nodes, (node, component), to a vector of owned DoFs, which is to
  /// be compressed after the last cell.
  template <int n_nodes, int n_components>
  void add(const Eigen::Matrix<double, n_nodes, n_components, Eigen::RowMajor> &forces,
           const int cell, Vector &sum) const
  {
    if (!is_plain(cell))
      return distribute(forces.data(), cell, sum);
    for (int k = 0; k < n_nodes; ++k)
      for (int c = 0; c < n_components; ++c)
        sum.begin()[owned_at(cell, k) + c] += forces(k, c);
  }

  /// Adds a cell's stiffness, node after node, to the solver's matrix, which is to be compressed
  /// after the last cell.
  template <int n_nodes, int n_components>
  void add(const Eigen::Matrix<double, n_nodes * n_components, n_nodes * n_components,
                               Eigen::RowMajor> &stiffness,
           const int cell) const
  {
    if (!is_plain(cell))
      return distribute(stiffness.data(), cell);
    for (int i = 0; i < n_nodes; ++i)
      for (int a = 0; a < n_components; ++a)
      {
        double *const row = values_of_matrix + first_of_row[owned_at(cell, i) + a];
        for (int j = 0; j < n_nodes; ++j)
          for (int b = 0; b < n_components; ++b)
            row[entries(cell, i * n_nodes + j) + b] +=
              stiffness(n_components * i + a, n_components * j + b);
      }
  }

private:
  static constexpr int not_plain = -1;

  void find_entries(int cell);
  std::vector<dealii::types::global_dof_index> dofs(int cell) const;
  void distribute(const double *forces, int cell, Vector &sum) const;
  void distribute(const double *stiffness, int cell) const;

  template <typename Index>
  using Table = Eigen::Array<Index, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  const Discretization &discretization;
  const dealii::AffineConstraints<double> &constraints;
  dealii::TrilinosWrappers::SparseMatrix &matrix;
  double *values_of_matrix = nullptr;
  int *first_of_row        = nullptr; ///< in those, and in the columns
  int *columns             = nullptr;

  std::vector<int> triangles;
  // (cell, node), of its first component:
  Table<dealii::types::global_dof_index> first_dofs;
  Table<int> with_ghosts_at, owned_at;
  /// (cell, node i, node j): where in the rows of i the components of j begin.
  Table<int> entries;
};
} // namespace homespun::homogenization
