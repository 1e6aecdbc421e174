// SPDX-License-Identifier: MIT
// What cell.h5 holds for up-sampling beside chi, all of it optional. Last axis of fields: the mode.
//
// Second order, by the law of the phases:
//   /W3/LAW (10) [N/m], /chi_quadratic/LAW (n,2,6) [m]
// Edges 0 to 3 of a sheet of whole cells: where lattice coordinate 1 is smallest and largest, then
// 2; macro strain 11, 22, 12 (engineering shear). All belong to w = −chi with mean zero.
//   /edges/slip (4,2,3) [m]      d: a clamped edge acts d E off where it is drawn, (x, y)
//   /edges/tension (4,3) [N]     T along a free edge, positive where it pulls
//   /edges/bulk (2,3,3) [N]      M: derivative of the strain by x, y; strain; strain of the test
//   /edges/decay (4)             by which modes shrink from cell to cell, at most
//   /edges/n_cells (4)           that the modes of an edge take
//   /edges/clamped_K, /edges/free_K (n_cells[K],n,2,3) [m], K = 0 ... 3: modes at the vertices of
//                                the cells from the edge inwards, those of a clamped edge without d
// Modes fitted by `homespun strain`, by the law of yarns (meshes/plain/fitted_modes.h):
//   /fitted/LAW/modes (n,2,6) [m], /fitted/LAW/coefficients (27,6), /fitted/LAW/of_strain (27,3)
//   /fitted/LAW/low, high, knees (3): the box of macro strains, and e_1, e_2, e_3
#pragma once

#include "meshes/files/hdf5_reader.h"
#include "meshes/files/hdf5_writer.h"
#include "meshes/plain/homogenized_cell.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace homespun::meshes
{
/// Rows of fields as a file has them, (row, component, mode): in memory column 2 k + c is component
/// c of mode k.
template <typename Rows>
std::vector<double> by_component(const Rows &rows)
{
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(rows.size()));
  for (Eigen::Index row = 0; row < rows.rows(); ++row)
    for (Eigen::Index c = 0; c < 2; ++c)
      for (Eigen::Index k = c; k < rows.cols(); k += 2)
        values.push_back(rows(row, k));
  return values;
}

/// The same backwards.
template <typename Rows>
Rows by_mode(const std::vector<double> &values)
{
  constexpr Eigen::Index n = Rows::ColsAtCompileTime;
  Rows rows(static_cast<Eigen::Index>(values.size()) / n, n);
  auto next = values.begin();
  for (Eigen::Index row = 0; row < rows.rows(); ++row)
    for (Eigen::Index c = 0; c < 2; ++c)
      for (Eigen::Index k = c; k < n; k += 2)
        rows(row, k) = *next++;
  return rows;
}

/// Adds them to a file that is being written.
void write_terms(const HomogenizedCell &cell, Hdf5Writer &file);

/// Reads what there is.
/// @param path for messages @param cell whose vertices are known
/// @throws BadInput naming the file and the dataset
void read_terms(const Hdf5Reader &file, const std::string &path, HomogenizedCell &cell);
} // namespace homespun::meshes
