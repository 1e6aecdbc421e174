// SPDX-License-Identifier: MIT
// The stiffness of one cell on waves: K(k) = Z(k)* K Z(k), Z ties every vertex to its master with
// the phase of the lattice vectors between them. Vertices without images are eliminated first, once
// for all waves:
//
//   K − beta K0 = [[A, B], [B^T, D]],  A of the vertices without images,  S = D − B^T A^-1 B
//   K(k) − beta K0(k) > 0   <=>   A > 0 and Z(k)* S Z(k) > 0        (Haynsworth's inertia)
//
// so that a wave costs a dense Cholesky factor as large as the outline of the cell, and tells the
// sign of its least eigenvalue less beta without computing any. In the limit of long waves along n
// the field is a (n.y) + w(y) with w periodic: the same with the columns of a added to those of
// k = 0, one vertex held (Geymonat, Müller and Triantafyllidis, Arch. Rational Mech. Anal. 122,
// 1993).
#pragma once

#include "meshes/plain/homogenized_cell.h"
#include "verification/periodic/wave.h"
#include "verification/periodic_cell/cell_assembly.h"

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <complex>
#include <memory>
#include <optional>
#include <vector>

namespace homespun::verification
{
/// A stiffness of all vertices in blocks: those without images, and those with.
struct SplitStiffness
{
  CellAssembly::Sparse inner, coupling; ///< A, B
  Eigen::MatrixXd outer;                ///< D
};

/// A field on the vertices of the mesh, complex, two components a vertex, in the order of
/// CellAssembly::vertex_tangent().
using Mode = Eigen::VectorXcd;

/// What does not change with the state: the elimination, and the stiffness at rest.
class BlochPencil
{
public:
  using Sparse = CellAssembly::Sparse;
  /// Real columns of the outline by complex unknowns of a wave.
  using Ties = Eigen::SparseMatrix<std::complex<double>>;

  /// @param cell whose mesh, lattice and anchor are used
  /// @param at_rest vertex_tangent() at rest
  /// @throws NotConverged where the stiffness at rest is not positive definite with the outline
  /// held
  BlochPencil(const meshes::HomogenizedCell &cell, const Sparse &at_rest);

  SplitStiffness split(const Sparse &stiffness) const;

  /// Z of a wave (vertices with images, unknowns).
  Ties ties(const Wave &wave) const;

  /// K − beta K0 after the vertices without images are eliminated.
  struct Shifted
  {
    double beta = 0.;
    Eigen::MatrixXd schur; ///< S
    std::shared_ptr<const Eigen::SimplicialLLT<Sparse>> inner;
    Sparse coupling;
  };

  /// Nothing where A is not positive definite: then no wave is above beta.
  std::optional<Shifted> shifted(const SplitStiffness &stiffness, double beta) const;

  /// The field of least potential of K − beta K0 whose outline moves as Z x.
  Mode extended(const Shifted &shifted, const Eigen::VectorXcd &outline) const;

  /// v* K v / v* K0 v.
  double quotient(const Sparse &stiffness, const Mode &mode) const;

  /// K0, positive definite on every wave.
  const Shifted &eliminated_at_rest() const
  {
    return *rest_eliminated;
  }

private:
  const Sparse at_rest;
  std::vector<int> inner, outer; ///< vertices without images, with images
  Eigen::Matrix<int, Eigen::Dynamic, 2>
    offset;                ///< of outer ones from their master, in lattice vectors
  std::vector<int> master; ///< of outer ones, counted from 0
  int n_masters     = 0;
  int anchor_master = 0;
  meshes::Points place; ///< of outer ones from the anchor, in sides of the cell [-]
  SplitStiffness rest;
  std::optional<Shifted> rest_eliminated;
};
} // namespace homespun::verification
