// SPDX-License-Identifier: MIT
// The convergence studies, each a list of cases. What every case must show is written beside it, before any
// number is known.
//
// mesh          uniform refinement of the cell, P1 and P2. C^H falls in the Loewner order (nested spaces). Its
//               energy converges with order 2p where no phase has a corner; at corners with 2 lambda, lambda > 0
//               unknown and below 1: an order between 0 and 2p. The limits of P1 and P2 agree.
// scale         cells per sheet. What `affine` lacks is a fluctuation of the size of a cell: order 1 per
//               sheet side. `localized` has at least that order, and at most 2.
// coarse        coarse triangles per cell side at a fixed sheet. The energy falls (nested). Where a clamped
//               edge meets a free one the exponent lies above ½: orders between 1 and 2.
// strain        periodic loads under biot: the linear characteristic displacements err by strain squared, `affine`
//               by strain.
// time          the coarse cloth swings down from one edge, linearly implicit and implicit Euler: order 1.
// manufactured  manufactured_cases.h: L2 order p + 1, H1 order p; steps in time order 1.
#pragma once

#include "homogenization/unit_cell.h"
#include "meshes/homogenized_cell.h"
#include "verification/converge_record.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace homespun::verification
{
/// Sizes of the studies.
struct ConvergenceSizes
{
  std::vector<int> refinements_p1, refinements_p2;
  std::vector<int> cells_per_sheet;
  int cells_of_coarse_study = 8;
  std::vector<double> coarse_per_cell; ///< coarse parallelograms per cell side
  std::vector<double> strains;         ///< descending
  std::vector<int> time_steps;         ///< of one motion
};

/// Sizes by default, or for seconds.
ConvergenceSizes convergence_sizes(bool quick);

/// The names of the studies, in their order.
const std::vector<std::string> &convergence_studies();

/// Whether phases meet in corners: an interface, or the edge of a hole, that bends in a vertex or branches.
/// There the solution is singular.
bool has_corners(const homogenization::UnitCell &cell);

std::vector<ConvergenceCase> mesh_cases(const homogenization::UnitCell &cell,
                                        const ConvergenceSizes &sizes, MPI_Comm communicator);
/// @param homogenized P1 on the given mesh, the discretization of the reference
std::vector<ConvergenceCase> strain_cases(const homogenization::UnitCell &cell,
                                          const meshes::HomogenizedCell &homogenized,
                                          const ConvergenceSizes &sizes, MPI_Comm communicator);
std::vector<ConvergenceCase> scale_cases(const homogenization::UnitCell &cell,
                                         const meshes::HomogenizedCell &homogenized,
                                         const ConvergenceSizes &sizes, MPI_Comm communicator);
std::vector<ConvergenceCase> coarse_cases(const homogenization::UnitCell &cell,
                                          const meshes::HomogenizedCell &homogenized,
                                          const ConvergenceSizes &sizes, MPI_Comm communicator);
std::vector<ConvergenceCase> time_cases(const homogenization::UnitCell &cell,
                                        const meshes::HomogenizedCell &homogenized,
                                        const ConvergenceSizes &sizes);
/// No cell: "none" stands in its place.
std::vector<ConvergenceCase> manufactured_study_cases(MPI_Comm communicator);
} // namespace homespun::verification
