// SPDX-License-Identifier: MIT
// Edges of a periodic cloth on lattice lines, clamped or free, to first order in the cell: half
// strips 0 < y_n that are periodic along the edge, t along it and n inwards, for each unit macro
// strain, with w_a = −chi_a of mean zero, sigma_a = c : (e_a + eps(w_a)) and Sigma_a = C^H e_a.
//
//   clamped:  div sigma(phi_a) = 0, phi_a = −w_a on the edge              =>  phi_a -> d_a far away
//   free:     div sigma(phi_a) = 0, sigma(phi_a) n = −(sigma_a − Sigma_a) n on the edge
//                                                                         =>  phi_a -> 0
//   T_a = mean over K in [k, k+1] p of integral_0^K <t.(sigma_a + sigma(phi_a) − Sigma_a) t>_t dy_n
//   M_abc = <(sigma_c e_b).w_a> − <(sigma_a e_b).w_c>
//
// p is the period along n, |Y| over the length of the edge of a cell. The slip d_a is how far off
// its drawing a clamped edge lies, the tension T_a a cable sewn on a free one, M_abc what a strain
// gradient does: the homogenized displacement u0 + u1 has
//   u1 = d_a E_a(u0) on clamped edges, and for all v that vanish there
//   integral C^H E(u1) : E(v) = − integral M_abc d_b E_a(u0) E_c(v)
//                               − sum over free edges integral T_a E_a(u0) t . dv/ds ds
// and the cloth lies at U + (w_a + phi_a − d_a near its clamped edge) E_a(U), U = u0 + u1.
// Source: Neuss-Radu 2001; Gérard-Varet and Masmoudi 2012 (boundary layers of homogenization).
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "homogenization/edges/half_strip.h"
#include "meshes/plain/cell_edges.h"

#include <Eigen/Core>

#include <array>

namespace homespun::homogenization
{
/// What the cell problem makes of a row of cells at an edge: a membrane's.
class MembraneStrip : public HalfStrip
{
public:
  /// @param cell condensed with elements_of_membrane()
  MembraneStrip(const CondensedCell &cell, const ElementCellProblem &problem, int side);

  /// phi_a of the clamped edge with no force on the other end, where it has come to d_a [m].
  Lines clamped(int n_cells) const;

  /// phi_a of the free edge with the other end held [m].
  Lines free(int n_cells) const;

  /// d_a, the mean of the last line (2,3) [m].
  Eigen::Matrix<double, 2, 3> slip(const Lines &clamped) const;

  /// Tension of a free edge, rows: T_a . t, and T_a . n, which is zero (2,3) [N].
  Eigen::Matrix<double, 2, 3> tension(const Lines &free) const;

private:
  const ElementCellProblem &problem;
};

/// P1 or P2 of the cell's membrane, for CondensedCell [N/m].
StripElements elements_of_membrane(const CellElements &elements);

/// M_abc of a cell.
/// @return entry (a, c) of element b [N]
std::array<Eigen::Matrix3d, 2> bulk_term(const CellElements &elements,
                                         const ElementCellProblem &problem);

/// Everything that a cell does at the four edges of a sheet of whole cells.
/// @throws BadInput where its edges are no lattice lines, or a mode decays too slowly for the cells
///   that it may take, with the factor; NotConverged where a part of the cell moves freely
meshes::CellEdges edges_of(const UnitCell &cell, const EdgeOptions &options);
} // namespace homespun::homogenization
