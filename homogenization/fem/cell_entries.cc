// SPDX-License-Identifier: MIT
#include "homogenization/fem/cell_entries.h"

#include <deal.II/lac/full_matrix.h>

#include <algorithm>

namespace homespun::homogenization
{
using namespace dealii;

CellEntries::CellEntries(const Discretization &discretization,
                         const AffineConstraints<double> &constraints, ElasticSolver &solver)
    : discretization(discretization)
    , constraints(constraints)
    , matrix(solver.matrix)
{
  matrix.trilinos_matrix().ExtractCrsDataPointers(first_of_row, columns, values_of_matrix);
  const auto n_owned =
    static_cast<Eigen::Index>(discretization.triangulation.n_locally_owned_active_cells());
  const auto n_nodes =
    static_cast<Eigen::Index>(discretization.element.base_element(0).n_dofs_per_cell());
  first_dofs.resize(n_owned, n_nodes);
  with_ghosts_at.resize(n_owned, n_nodes);
  owned_at.resize(n_owned, n_nodes);
  entries.resize(n_owned, n_nodes * n_nodes);

  const Vector owned = solver.owned_vector(), ghosted = with_ghosts(owned);
  const auto &owned_places   = owned.trilinos_partitioner();
  const auto &ghosted_places = ghosted.trilinos_partitioner();
  discretization.for_owned_cells(
    [&](const auto &cell, const std::vector<types::global_dof_index> &dofs)
    {
      const int k = n_cells();
      triangles.push_back(static_cast<int>(cell->active_cell_index()));
      for (int node = 0; node < n_nodes; ++node)
      {
        const auto dof      = dofs[static_cast<std::size_t>(node) * discretization.n_components];
        first_dofs(k, node) = dof;
        with_ghosts_at(k, node) = ghosted_places.LID(static_cast<int>(dof));
        owned_at(k, node)       = owned_places.LID(static_cast<int>(dof)); // -1 of other ranks
      }
      find_entries(k);
    });
}

/// The components of a node follow each other in a row, and its rows are laid out alike; where they
/// are not, the cell is not plain.
void CellEntries::find_entries(const int cell)
{
  const auto n_components = static_cast<int>(discretization.n_components);
  const auto n_nodes      = static_cast<int>(owned_at.cols());
  const auto all          = dofs(cell);
  bool is_plain           = std::all_of(all.begin(), all.end(),
                                        [&](const types::global_dof_index dof) {
                                return discretization.locally_owned.is_element(dof) &&
                                       !constraints.is_constrained(dof);
                              });
  for (int i = 0; is_plain && i < n_nodes; ++i)
    for (int j = 0; is_plain && j < n_nodes; ++j)
    {
      const auto row = [&](const int component)
      { return columns + first_of_row[owned_at(cell, i) + component]; };
      const int column = matrix.trilinos_matrix().LCID(static_cast<int>(first_dofs(cell, j)));
      const auto place = std::lower_bound(row(0), row(1), column) - row(0);
      for (int a = 0; a < n_components; ++a)
        for (int b = 0; b < n_components; ++b)
          is_plain = is_plain && row(a) + place + b < row(a + 1) && row(a)[place + b] == column + b;
      entries(cell, i * n_nodes + j) = static_cast<int>(place);
    }
  if (!is_plain)
    entries.row(cell) = not_plain;
}

std::vector<types::global_dof_index> CellEntries::dofs(const int cell) const
{
  std::vector<types::global_dof_index> all;
  for (Eigen::Index node = 0; node < first_dofs.cols(); ++node)
    for (unsigned int c = 0; c < discretization.n_components; ++c)
      all.push_back(first_dofs(cell, node) + c);
  return all;
}

CellEntries::Vector CellEntries::with_ghosts(const Vector &owned) const
{
  Vector all(discretization.locally_owned, discretization.locally_active,
             discretization.communicator);
  all = owned;
  return all;
}

void CellEntries::distribute(const double *const forces, const int cell, Vector &sum) const
{
  const std::vector<types::global_dof_index> at = dofs(cell);
  constraints.distribute_local_to_global(dealii::Vector<double>(forces, forces + at.size()), at,
                                         sum);
}

void CellEntries::distribute(const double *const stiffness, const int cell) const
{
  const std::vector<types::global_dof_index> at = dofs(cell);
  constraints.distribute_local_to_global(FullMatrix<double>(static_cast<unsigned int>(at.size()),
                                                            static_cast<unsigned int>(at.size()),
                                                            stiffness),
                                         at, matrix);
}
} // namespace homespun::homogenization
