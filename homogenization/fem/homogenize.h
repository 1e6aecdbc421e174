// SPDX-License-Identifier: MIT
// Homogenization of a periodic unit cell (paper Eqs. 1-4): three cell problems, the effective
// stiffness from their energies, and the checks that come for free.
#pragma once

#include "homogenization/cell/quadratic_strain.h"
#include "homogenization/cell/unit_cell.h"
#include "homogenization/fem/constraint_audit.h"
#include "meshes/plain/homogenized_cell.h"

#include <mpi.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace homespun::homogenization
{
/// What solves the linear systems of the cell problems.
enum class CellSolver
{
  fastest,  ///< `direct` up to a measured size, else `multigrid`
  direct,   ///< a factorization: CHOLMOD on one rank, MUMPS on several
  multigrid ///< preconditions conjugate gradients; where these fail, `direct` takes over
};

/// `fastest`, `direct` or `multigrid`.
const char *name_of(CellSolver solver);

struct HomogenizationOptions
{
  unsigned int order  = 2; ///< 1 or 2, of the displacement elements
  unsigned int refine = 0; ///< uniform refinements of the given mesh before the solve
  /// Of |residual|, relative to the root of the sum of squares of the element loads; of the energy
  /// of the error, (100 tolerance)^2 of that of equal stress in all phases.
  double tolerance  = 1e-11;
  CellSolver solver = CellSolver::fastest;
  std::string pieces; ///< path without ending of .pvtu and its pieces (write_pieces()); empty: none
  /// Whose quadratic modes and cubic energy are computed too: six more right-hand sides each.
  std::vector<Law> second_order;
};

/// Seconds of each stage on the slowest rank.
struct HomogenizationSeconds
{
  double setup = 0., assembly = 0., preconditioner = 0., solve = 0., evaluation = 0.,
         second_order = 0.;
};

/// Strains (m,9) of triangles under the unit macro strains 11, 22, 12: of each the components 11,
/// 22, 12 with engineering shear [-].
using UnitStrains = Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor>;

struct Homogenization
{
  meshes::Chi chi;           ///< (n,6) at the vertices of the given mesh [m]
  UnitStrains strains;       ///< means of e_a − eps(chi_a) over the triangles of that mesh
  int anchor;                ///< vertex where chi = 0
  Eigen::Matrix3d stiffness; ///< C^H from the energies [N/m]
  Eigen::Matrix3d stiffness_by_flux; ///< C^H from Eq. 4, the mean stress [N/m]
  Eigen::Matrix3d voigt;             ///< mean of c [N/m]
  Eigen::Matrix3d reuss;             ///< inverse of the mean of c^-1 [N/m]
  unsigned long n_dofs;
  std::array<unsigned int, 3> iterations; ///< of the solver, per load
  CellSolver solver;                      ///< the one that gave the answer
  /// Residuals of conjugate gradients that were given up for the direct solver; empty: none were.
  std::vector<double> abandoned;
  std::map<std::string, meshes::SecondOrder> second_order; ///< by law: those of the options
  ConstraintAudit audit;
  HomogenizationSeconds seconds;
};

/// Solves the cell problems: find periodic chi_a with
///   integral eps(v) : c : eps(chi_a) = integral eps(v) : c : e_a   for all periodic v,
/// for the unit macro strains e_a, a = 11, 22, 12 (engineering shear), with chi_a = 0 at one node
/// of the outline: the loads do no work on a translation, so that this costs nothing. Forms
///   C^H_ab = 1/|Y| integral (e_a − eps(chi_a)) : c : (e_b − eps(chi_b)),
/// the energy form, which is symmetric, approaches the exact C^H from above and differs from
/// Eq. 4, 1/|Y| integral e_a : c : (e_b − eps(chi_b)), by what the solver left undone.
/// Discretization error: O(h^2) for P1, O(h^4) for P2 on smooth solutions; at corners of a phase
/// less.
///
/// @throws NotConverged with the residual history; BadInput where the cell is not periodic;
///   std::logic_error where the audit of the constraints fails
/// Source: the paper, Eqs. 2-4, with I as diag(1,1,1) on strains with engineering shear.
Homogenization homogenize(const UnitCell &cell, const HomogenizationOptions &options,
                          MPI_Comm communicator);

/// What the runtime needs of it.
meshes::HomogenizedCell homogenized_cell(const UnitCell &cell, const Homogenization &result,
                                         const std::string &provenance);

/// Engineering constants of a membrane stiffness, from the compliance S = C^-1:
/// E1 = 1/S11, E2 = 1/S22, G12 = 1/S66 [N/m], nu12 = −S12/S11, nu21 = −S12/S22.
struct EngineeringConstants
{
  double E1, E2, G12, nu12, nu21;
};
EngineeringConstants engineering_constants(const Eigen::Matrix3d &stiffness);
} // namespace homespun::homogenization
