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
#include "homogenization/edges/condensed_cell.h"
#include "meshes/plain/cell_edges.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::homogenization
{
struct EdgeOptions
{
  unsigned int order = 1;     ///< 1 or 2, of the displacement elements
  int most_cells     = 400;   ///< that a half strip may take
  double left_at_end = 1e-13; ///< of the slowest mode at the end of its half strip
  double kept        = 1e-3;  ///< fields below this part of the largest |w_a| are not kept
};

/// A row of cells that begins at an edge, and its two problems.
class HalfStrip
{
public:
  /// @param cell condensed along the axis of the edge
  /// @param side of the sheet, one of the two of that axis, see meshes::CellEdges
  HalfStrip(const CondensedCell &cell, const ElementCellProblem &problem, int side);

  /// Displacements on the lines between cells, edge first, one matrix (2 n_side,3) each [m].
  using Lines = std::vector<Eigen::MatrixXd>;

  /// phi_a of the clamped edge with no force on the other end, where it has come to d_a.
  Lines clamped(int n_cells) const;

  /// phi_a of the free edge with the other end held.
  Lines free(int n_cells) const;

  /// d_a, the mean of the last line (2,3) [m].
  Eigen::Matrix<double, 2, 3> slip(const Lines &clamped) const;

  /// Tension of a free edge, rows: T_a . t, and T_a . n, which is zero (2,3) [N].
  Eigen::Matrix<double, 2, 3> tension(const Lines &free) const;

  /// The fields at the vertices of the first cells.
  /// @param far what they come to, taken off (2,3) [m]
  meshes::EdgeModes at_vertices(const Lines &lines, const Eigen::Matrix<double, 2, 3> &far,
                                int n_cells) const;

private:
  Lines followed(Eigen::MatrixXd first, const std::vector<Eigen::MatrixXd> &steps) const;

  const CondensedCell &cell;
  const ElementCellProblem &problem;
  const bool is_far;   ///< the edge is where the lattice coordinate is largest
  SideStiffness sides; ///< the first towards the edge
};

/// M_abc of a cell.
/// @return entry (a, c) of element b [N]
std::array<Eigen::Matrix3d, 2> bulk_term(const CellElements &elements,
                                         const ElementCellProblem &problem);

/// Everything that a cell does at the four edges of a sheet of whole cells.
/// @throws BadInput where its edges are no lattice lines, or a mode decays too slowly for the cells
///   that it may take, with the factor; NotConverged where a part of the cell moves freely
meshes::CellEdges edges_of(const UnitCell &cell, const EdgeOptions &options);

/// The edges of the cell's plate: those of its analogous membrane (bracket/bending_bracket.h),
/// whose strains E = P^-1 M stand for the moments M = D^H kappa(w0) of the plate, and whose free
/// edges for clamped ones of the plate, its clamped ones for free ones. The deflection is w0 + w1,
///   clamped:  w1 = 0, dw1/dn = T_a E_a, n inwards: the cloth turns at a clamp
///   and for all v that are clamped there, with s along free edges, the sheet on the left,
///   integral kappa(v).D^H.kappa(w1) = integral M_abc d_b E_a (P^-1 D^H kappa(v))_c
///                                     + sum over free edges integral (d_a E_a).d/ds(v,2, -v,1) ds
/// Units: E_a [N], slip d_a [m], tension T_a and M_abc [1/N].
/// They are those of displacements, D^H of a plate of deflections: on a mesh where the two sides of
/// D^H are a part apart, the terms of edges are off by as much.
/// The derivation is the membrane's: w is Airy's function of the analogous membrane, whose line
/// tension is a kink of w, and whose displacements are the potential of the moments.
/// @throws BadInput as above, and where the cell has holes, which are rigid in the analogous
///   membrane; NotConverged as above
meshes::CellEdges edges_of_plate(const UnitCell &cell, const EdgeOptions &options);
} // namespace homespun::homogenization
