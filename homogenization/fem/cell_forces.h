// SPDX-License-Identifier: MIT
// The cell problems with a force in the cell, which makes chi a field that is known: what tells
// whether assembly, constraints and solver of homogenize() give chi with the order of its elements.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "homogenization/fem/elastic_solver.h"
#include "meshes/plain/homogenized_cell.h"

#include <mpi.h>

#include <functional>

namespace homespun::homogenization
{
struct HomogenizationOptions;

/// What a manufactured solution adds to the cell problems, and how it looks at their fields. Both
/// are called on every rank, for each load a = 0, 1, 2 in turn.
struct CellForces
{
  /// Integral of f_a N_i for every shape, held and tied nodes as the constraints say [N].
  std::function<ElasticSolver::Vector(int load, const Discretization &,
                                      const dealii::AffineConstraints<double> &)>
    load_vector;
  /// @param chi of the nodes that this rank owns [m]
  std::function<void(int load, const Discretization &, const ElasticSolver::Vector &chi)> look;
};

/// Solves the cell problems of homogenize() with a force f_a per area [N/m^2] beside each unit
/// strain,
///   integral eps(v) : c : eps(chi_a) = integral eps(v) : c : e_a + v . f_a   for all periodic v,
/// by the same assembly, constraints and solver.
/// @param options whose pieces are empty
/// @return chi (n,6) at the vertices of the given mesh [m]
/// @throws as homogenize()
meshes::Chi chi_under_forces(const UnitCell &cell, const HomogenizationOptions &options,
                             const CellForces &forces, MPI_Comm communicator);
} // namespace homespun::homogenization
