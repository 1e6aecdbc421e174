// SPDX-License-Identifier: MIT
// Error budget (METHOD 5): the distance of the up-sampled sheet from the resolved one, split into parts. Each part is
// a field at the fine vertices, the difference of two solutions in which one thing is turned; none is what the others
// leave over, so that their sum can miss the measured total.
//
// Solutions. M: the method (given coarse mesh H, cell and C^H from P1 on the given cell mesh h). T: the resolved
// reference, P1 on the same mesh h. *: P2 on the cell mesh h. u_H, u: homogenized sheet on the coarse mesh, and
// on one refined so far that it counts as resolved. E, R: its strain U − I and rotation; <.>: their means over each
// coarse triangle, averaged to the coarse vertices, linear in between (what the method does). w(E) = −chi : E.
//
//  1 scale         [u + w*(E) with the best constant of chi*] − T*, all in linear theory: what separation of scales
//                  and the boundary layers at free and held edges cost
//  2 nonlinearity  [u + R w(E)] − [û + R^ ŵ(Ê)], û in equilibrium with the stress of the cell at finite strain, ŵ its
//                  fluctuation (nonlinear_cell.h): small-strain stiffness and modes in place of those at finite strain
//  3 coarse-mesh   [u_H + R_H w(<E_H>)] − [u + R w(<E>)]: solving and interpolating on the coarse mesh
//  4 cell          M − M with chi* and C^H*: the cell's discretization
//  5 blending      [R w(<E>)] − [R w(E)] at the resolved solution: averaging and blending of the strain
//  6 time-step     0: the loads are static
//  7 solver        [M − M with tight tolerances] − [T − T with a tight tolerance]
//  8 precision     [M in float] − M
//  9 convention    [R w(E)] with chi anchored at the lattice − the same with its best constant, at the resolved solution. The
//                  best constant (per unit strain) is the one of part 1: it brings u + w* nearest to T* in least squares.
//                  The rotation lift needs no part: for a frame indifferent law it is exact in an infinite cloth
// and, because T shares the mesh of the cell,
//    reference     T* − T, linear theory: the reference's own discretization. What parts 4 and it have in common cancels.
//
// With these  M − T = 1 + 2 + 3 + 4 + 5 + 7 + 9 + reference + products of parts.  Part 8 stands beside the sum: M is
// computed in double.
#pragma once

#include "meshes/homogenized_cell.h"
#include "verification/homogenized_sheet.h"
#include "verification/lightweight_cloth.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace homespun::verification
{
/// One cell homogenized in the ways that the budget compares.
struct BudgetCells
{
  meshes::HomogenizedCell given; ///< P1 on the given mesh, as the method uses it
  meshes::HomogenizedCell best;  ///< P2
  meshes::HomogenizedCell tight; ///< P1 with a tighter solver
  std::vector<Eigen::Matrix3d> stiffness_of_phase;
};

/// The names of the parts in the order of METHOD 5, then `reference`.
const std::vector<std::string> &budget_parts();

/// Parts of the error at one strain, fields (n,2) at the fine vertices [m].
struct ErrorBudget
{
  std::map<std::string, meshes::Points> parts;
  meshes::Points total;               ///< M − T as measured
  double misfit_of_localization = 0.; ///< NonlinearLocalization::misfit()

  /// Sum of the parts that make the total: all but `precision`.
  meshes::Points sum() const;
};

/// The solutions at one strain that others have computed.
struct SolvedLevel
{
  double strain = 0.;
  const shell::Positions<2> &coarse;     ///< u_H
  const meshes::Points &upsampled;       ///< M, double precision
  const meshes::Points &reference;       ///< T
  const meshes::Points &tight_reference; ///< T with a tight tolerance
};

/// The budget of one sheet under one load. Linear theory is solved once, what depends on strain per level.
class LoadBudget
{
public:
  /// @param linear, linear_best T and T* of the law `linear` at strain `linear_strain` (n,2) [m]
  /// @param refinement of the coarse mesh that counts as resolved, quads into refinement²
  LoadBudget(const BudgetCells &cells, const meshes::Sheet &sheet, const Load &load,
             const meshes::Points &linear, const meshes::Points &linear_best, double linear_strain,
             int refinement);

  /// @throws NotConverged where a solution of a part cannot be found
  ErrorBudget measure(Law law, const SolvedLevel &level);

private:
  meshes::Points nonlinearity(Law law, const shell::Positions<2> &u,
                              const meshes::Points &with_exact, ErrorBudget &budget) const;

  const BudgetCells &cells;
  const meshes::Sheet &sheet;
  const Load load;
  HomogenizedSheet coarse, coarse_best, coarse_tight, resolved;
  meshes::Points scale, reference;       ///< per unit strain [m]
  Eigen::Matrix<double, 3, 2> constant;  ///< of w, per unit strain [m]
  shell::Positions<2> last_displacement; ///< of the resolved sheet, per strain
};

/// 8 where the sheet is small, else what brings the refined mesh to about 160 quads per side, at least 4.
int budget_refinement(const meshes::Sheet &sheet);
} // namespace homespun::verification
