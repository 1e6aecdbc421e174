// SPDX-License-Identifier: MIT
// The convergence studies, each a list of cases. What every case must show is written beside it,
// before any number is known.
//
// mesh          uniform refinement of the cell, P1 and P2: cell_refinement.h. C^H falls in the
//               Loewner order (nested spaces). A laminate has its closed form on every level. At
//               corners the energy converges with twice their exponents, which are computed; the
//               limits of P1 and P2 agree.
// adaptive      the bracket on C^H with meshes refined where it is wide: relative width ~ DoFs^-1
//               with P1 and DoFs^-2 with P2, as on smooth solutions (order 2p in DoFs^-1/2); in the
//               limit narrower than on uniform meshes. A laminate's bracket closes to round-off at
//               once.
// scale         cells per sheet. What `affine` lacks is a fluctuation of the size of a cell: order
//               1 per sheet side. `localized` has at least that order, and at most 2.
// coarse        coarse triangles per cell side at a fixed sheet. The energy falls (nested). Where a
//               clamped edge meets a free one the exponent lies above ½: orders between 1 and 2.
// edges         cells per sheet with all terms of the method `full`, the macro problem resolved. On
//               a sheet that closes along one axis: order 1 per cell side. Corners between clamped
//               and free edges leave 2 lambda − 1, lambda their exponent.
// bending       cells per sheet, bent, in linear theory. What D^H alone lacks is of order 1 in the
//               sheet side; with w3 of the cell and the terms of edges it is of order 2, but for
//               corners between clamped and free edges, which leave 2 lambda. Not run by default.
// strain        periodic loads under the cell's default law: the linear characteristic
//               displacements err by strain squared, `affine` by strain.
// time          the coarse cloth swings down from one edge, linearly implicit and implicit Euler:
//               order 1.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "meshes/plain/homogenized_cell.h"
#include "verification/converge/converge_record.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace homespun::verification
{
/// Sizes of the studies.
struct ConvergenceSizes
{
  std::vector<int> refinements_p1, refinements_p2;
  unsigned adaptive_dofs = 400000; ///< of the larger of the two problems of a bracket
  std::vector<int> cells_per_sheet;
  std::vector<int> cells_of_edges;   ///< per side of the sheets of the study of edges
  std::vector<int> cells_of_bending; ///< per side of the sheets that are bent
  int cells_of_coarse_study = 8;
  std::vector<double> coarse_per_cell; ///< coarse parallelograms per cell side
  std::vector<double> strains;         ///< descending
  std::vector<int> time_steps;         ///< of one motion
};

/// Sizes by default, or for seconds.
ConvergenceSizes convergence_sizes(bool quick);

/// The names of the studies, in their order.
const std::vector<std::string> &convergence_studies();

/// The exponent of the corners between clamped and free edges of a sheet, the least of them.
/// @param stiffness of the sheet @param clamped the lattice axis at whose ends it is clamped
double corner_exponent(const meshes::Lattice &lattice, const Eigen::Matrix3d &stiffness,
                       int clamped);

std::vector<ConvergenceCase> mesh_cases(const homogenization::UnitCell &cell,
                                        const ConvergenceSizes &sizes, MPI_Comm communicator);
std::vector<ConvergenceCase> adaptive_cases(const homogenization::UnitCell &cell,
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
/// @param homogenized as above
std::vector<ConvergenceCase> edge_cases(const homogenization::UnitCell &cell,
                                        const meshes::HomogenizedCell &homogenized,
                                        const ConvergenceSizes &sizes, MPI_Comm communicator);
std::vector<ConvergenceCase> bending_cases(const homogenization::UnitCell &cell,
                                           const ConvergenceSizes &sizes);
std::vector<ConvergenceCase> time_cases(const homogenization::UnitCell &cell,
                                        const meshes::HomogenizedCell &homogenized,
                                        const ConvergenceSizes &sizes);
} // namespace homespun::verification
