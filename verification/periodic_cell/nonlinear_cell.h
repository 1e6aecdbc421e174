// SPDX-License-Identifier: MIT
// The cell problem at finite strain, and a table of its answers over the strains that occur in a
// sheet: what an infinite cloth under the stretch U does beyond the linear theory of
// homogenization. Eigen alone, written apart from the resolved reference, which it must equal on
// one cell.
//
//   find periodic w, zero at the anchor, that makes  1/|Y| integral W(U + grad w)  stationary;
//   S(e) = derivative of that minimum by e = (U11 − 1, U22 − 1, 2 U12), the mean stress
//     (Hill-Mandel).
// For small strain S = C^H e and w = −(e11 chi_11 + e22 chi_22 + gamma12 chi_12).
#pragma once

#include "meshes/plain/homogenized_cell.h"
#include "verification/law/laws.h"
#include "verification/periodic_cell/cell_assembly.h"
#include "verification/periodic_cell/cell_equilibrium.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::verification
{
/// An infinite cloth under one macroscopic stretch.
struct CellState
{
  meshes::Points fluctuation; ///< w (n,2) at the vertices of the cell, zero at the anchor [m]
  Eigen::Vector3d stress;     ///< S [N/m]
};

/// P1 displacements on the cell's mesh under one law.
class NonlinearCell
{
public:
  /// @param cell whose mesh, lattice and anchor are used
  /// @param stiffness_of_phase (3,3) [N/m]
  NonlinearCell(const meshes::HomogenizedCell &cell,
                std::vector<Eigen::Matrix3d> stiffness_of_phase, Law law);

  /// Newton's method with a line search on the energy, from the linear answer.
  /// @param strain e = (U11 − 1, U22 − 1, 2 U12)
  /// @throws NotConverged with the residual history
  CellState solve(const Eigen::Vector3d &strain) const;

private:
  const CellAssembly assembly;
};

/// What the linear theory misses, S(e) − C^H e and w(e) + chi : e, as polynomials of degree three
/// fitted to cell problems at points of the box that holds a given share of the strains; beyond the
/// box the value at its edge.
class NonlinearLocalization
{
public:
  /// @param strains (m,3) that occur, of which the box leaves out `outside` at either end of each
  ///   component
  /// @throws NotConverged where a cell problem has no answer
  NonlinearLocalization(const NonlinearCell &nonlinear, const meshes::HomogenizedCell &cell,
                        const Eigen::Matrix<double, Eigen::Dynamic, 3> &strains,
                        double outside = 0.005);

  /// S(e) − C^H e [N/m].
  Eigen::Vector3d excess_stress(const Eigen::Vector3d &strain) const;

  /// w(e) + chi : e at a vertex of the cell [m].
  Eigen::RowVector2d excess_fluctuation(int cell_vertex, const Eigen::Vector3d &strain) const;

  /// Largest misfit of the polynomials at cell problems that they were not fitted to, over the size
  /// of what they stand for: of the stress, of the fluctuation [-].
  double misfit() const
  {
    return largest_misfit;
  }

private:
  static constexpr int n_terms = 20; ///< monomials up to degree three of three variables
  Eigen::Matrix<double, 1, n_terms> monomials(const Eigen::Vector3d &strain) const;

  Eigen::Vector3d middle, half; ///< of the box
  Eigen::MatrixXd coefficients; ///< (n_terms, 3 + 2 n)
  double largest_misfit = 0.;
};
} // namespace homespun::verification
