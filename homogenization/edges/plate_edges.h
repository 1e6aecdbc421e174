// SPDX-License-Identifier: MIT
// Edges of a plate of whole cells on lattice lines, clamped or free, to first order in the cell:
// half strips 0 < y_n that are periodic along the edge, t along it and n inwards, for each unit
// macro curvature, with w_a the deflection of the cell of mean zero, M_a = D (K_a + kappa(w_a)),
// D^H_a their mean over the cell, holes counting as zero:
//
//   clamped:  div div M(phi_a) = 0, phi_a = −w_a, d phi_a/dn = −dw_a/dn on the edge
//                                                                  =>  phi_a -> c_a + b_a y_n
//   free:     the same, no force on the edge and on rims of holes of M_a + M(phi_a), but the moment
//             D^H_a that the homogenized plate has there         =>  phi_a -> 0
//   m_a = mean over K in [k, k+1] p of integral_0^K <M_a + M(phi_a) − D^H_a>_t dy_n
//   M_abc = 2 <(M_c e_b).grad w_a> − 2 <(M_a e_b).grad w_c>
//
// p is the period along n. The slip b_a is how far a clamp turns the cloth, m_a a beam sewn on a
// free edge, of bending and torsion (no moment nn stays). c_a is of second order in the cell: with
// it the cloth lies at its clamp, whatever constant w_a has. The homogenized deflection w0 + w1 has
//   w1 = c_a K_a(w0), dw1/dn = b_a K_a(w0) on clamped edges, and for all v that are clamped there
//   integral kappa(v).D^H.kappa(w1) = − integral M_abc d_b K_a(w0) kappa_c(v)
//                                     − sum over free edges integral m_a K_a(w0) : kappa(v) ds
// and the plate lies at U + (w_a + phi_a − c_a − b_a y_n near its clamped edge) K_a(U), U = w0 +
// w1. Deflections are those of Clough-Tocher triangles, as D^H and the resolved plate are.
// The derivation is that of edge_layers.h, with 2 grad w_a for w_a. A plate without holes has the
// edges of its analogous membrane (bracket/bending_bracket.h), whose strains are E = P^-1 M: T_a
// E_a = b_a K_a and (d_a E_a).d/ds(v,2, −v,1) = −m_a K_a : kappa(v), s with the sheet on the left.
// Source: Neuss-Radu 2001; Gérard-Varet and Masmoudi 2012 (boundary layers of homogenization).
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "homogenization/edges/half_strip.h"
#include "meshes/plain/cell_edges.h"

#include <Eigen/Core>

#include <array>

namespace homespun::homogenization
{
/// Fields at the vertices of a row of cells that begins at an edge and goes inwards: row k n + v is
/// vertex v (of n) of cell k; columns w, w,1, w,2 of each unit macro curvature [m^2], [m].
using DeflectionModes = Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor>;

/// Deflections that have no curvature: value and slope inwards, at the edge, of each load.
struct AffineDeflection
{
  Eigen::RowVector3d value, slope; ///< [m^2], [m]
};

/// An edge of the plate, per unit macro curvature, a = 11, 22, 12 (2 K12).
struct PlateEdge
{
  AffineDeflection slip;   ///< c_a [m^2] and b_a [m] of a clamped edge
  Eigen::Matrix3d moment;  ///< m_a of a free edge, in columns, rows 11, 22, 12 [N m^2]
  int n_cells = 0;         ///< that the modes take
  DeflectionModes clamped; ///< phi_a − c_a − b_a y_n
  DeflectionModes free;    ///< phi_a
};

/// The four edges of a sheet of whole cells, and what the cell does under gradients of curvature.
struct PlateEdges
{
  std::array<PlateEdge, meshes::CellEdges::n_sides> sides; ///< as in meshes::CellEdges
  std::array<Eigen::Matrix3d, 2> bulk; ///< M_abc [N m^2], entry (a, c) of bulk[b], b = x, y
};

/// Everything that a cell does at the four edges of a plate of whole cells; rims of holes are free.
/// @throws BadInput, NotConverged as edges_of()
PlateEdges edges_of_plate(const UnitCell &cell, const EdgeOptions &options);
} // namespace homespun::homogenization
