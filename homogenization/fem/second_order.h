// SPDX-License-Identifier: MIT
// A cell at second order in the macro strain, from its characteristic displacements: the loads of
// the six quadratic modes, which are six more right-hand sides of the matrix of chi, and the cubic
// energy, which asks for no cell problem at all (2n+1 theorem).
//
// With H_a = e_a − grad chi_a, e_3 = [[0, ½], [½, 0]], and A2 of a law (quadratic_strain.h),
//   integral eps(v):c:eps(chi_ab) = integral A2[H_a,H_b]:grad v      for all periodic v
//   W3(E) = 1/6 sum_abc T_abc E_a E_b E_c,   T_abc = 1/|Y| integral A2[H_a,H_b]:H_c
// in the measure E = U − I of the macro strain for every law; the macro rotation enters through the
// lift alone. chi_ab is minus the second derivative of the fluctuation at rest.
#pragma once

#include "homogenization/cell/quadratic_strain.h"
#include "homogenization/cell/unit_cell.h"
#include "homogenization/fem/elastic_solver.h"
#include "meshes/plain/cubic_form.h"

#include <array>
#include <vector>

namespace homespun::homogenization
{
/// What the loads of the cell problems stand on.
struct SolvedCell
{
  const UnitCell &cell;
  const Discretization &discretization;
  const dealii::AffineConstraints<double> &constraints;
  const std::array<ElasticSolver::Vector, 3> &chi; ///< with the values of neighbouring ranks
};

/// When the modes are solved: as the characteristic displacements are.
struct SecondOrderTarget
{
  double tolerance;         ///< of |residual|, as in HomogenizationOptions
  Eigen::Vector3d energies; ///< of the unit strains if all triangles had the same stress [J]
  unsigned int most_iterations;
};

struct SecondOrderFields
{
  std::vector<ElasticSolver::Vector> modes; ///< chi_ab in the order of meshes::strain_pairs [m]
  meshes::CubicForm energy;                 ///< W3 [N/m]
  std::vector<double> abandoned;            ///< as Homogenization::abandoned
};

/// All ranks must call this.
/// @param solver with its preconditioner, as chi was solved with
/// @throws NotConverged with the residual history
SecondOrderFields second_order_fields(const SolvedCell &solved, Law law,
                                      const SecondOrderTarget &target, ElasticSolver &solver);
} // namespace homespun::homogenization
