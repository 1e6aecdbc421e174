// SPDX-License-Identifier: MIT
// Error against run time: every way to the positions of a sheet under one load at one strain, from
// the resolved solution to the coarsest cloth, with the time that each takes and its distance from
// the best solution there is.
//
//   fine-p1, fine-p2       deal.II, every triangle of the sheet; all ranks
//   fine-corotational      the cloth's own element at full resolution, direct solver; one rank, as
//                          all that follow; beside biot alone
//   affine-Q, localized-Q  coarse cloth of Q x Q quads, Q = 5, 10, 20, 40, coarse motion alone or
//                          localized
//   METHOD-N               the others of --methods, like full-20, on the vertices of one quad per
//                          cell; terms of edges are part of the equilibrium. Those whose
//                          terms the cell or the sheet does not have whole are left out, with a
//                          note
//   voigt, reuss           one quad per cell, localized, with the Voigt or Reuss stiffness in place
//                          of C^H; Reuss not with holes
//   nodal-warping          one quad per cell, localized, with the paper's warped stiffness
//                          (shell/terms/warping.h); beside biot alone
//
// All have one law, that of the study's main reference.
// Every run begins with the affine motion that agrees with what is prescribed; there is no warm
// start from a smaller strain. A time holds the equilibrium and, of coarse cloths, up-sampling in
// single precision; not what is done once per sheet: numbering, location of vertices, symbolic
// factorisation. Errors are those of double precision. Of coarse cloths a step stands beside it,
// the mean over Newton's method: assembly, factor and substitution, as of a linearly implicit step
// of a moving cloth; and up-sampling alone.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "meshes/plain/cell_edges.h"
#include "meshes/plain/fitted_modes.h"
#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/sheet.h"
#include "verification/reference/loads.h"
#include "verification/strain/strain_output.h"
#include "verification/strain/strain_tables.h"

#include <mpi.h>

#include <functional>
#include <string>
#include <vector>

namespace homespun::verification
{
struct RunTimeOptions
{
  double strain                     = 0.1;
  int n_runs                        = 5;         ///< per way, of which the median is taken
  double seconds_of_a_way           = 15.;       ///< no further run of a way begins after this long
  std::vector<std::string> methods  = {};        ///< of which those with own cloths have rows
  Law law                           = Law::biot; ///< of the reference, which coarse cloths follow
  const meshes::CellEdges *edges    = nullptr; ///< of the cell; null: methods that ask have no rows
  const meshes::FittedModes *fitted = nullptr; ///< under the law; null: methods that ask have none
};

/// Stiffness of the cell in other ways than C^H [N/m].
struct StiffnessBounds
{
  Eigen::Matrix3d voigt, reuss;
};

/// What moves: a sheet of a cell under a load.
struct SheetUnderLoad
{
  const homogenization::UnitCell &cell;
  const meshes::HomogenizedCell &homogenized;
  StiffnessBounds bounds;
  const meshes::Sheet &sheet;
  const Load &load;
};

/// Runs every way whose row is not there, and appends their rows.
/// @param uncertainty rows of uncertainty.csv, for the error bar of the best solution
/// @param table runtime.csv on the first rank, elsewhere null
/// @return why there are no rows, empty where there are
std::string run_time_study(const SheetUnderLoad &of, const RunTimeOptions &options,
                           const std::vector<UncertaintyRow> &uncertainty, Table<RunTimeRow> *table,
                           MPI_Comm communicator,
                           const std::function<void(const std::string &)> &tell);

/// The error bar of P2 on the given mesh [m], F |P2 − refined P2| 2^q / (2^q − 1) as in
/// cell/discretization_distance.h: measured on the small sheet, carried over by the ratio of
/// |P1 − P2| at full size and there (linear law), per strain. Where the small sheet was not
/// measured under the law of the level, it counts under another. NaN where a row is missing.
/// @param rows of uncertainty.csv @param order q of P2
double bar_of_p2(const std::vector<UncertaintyRow> &rows, const StrainLevel &level, int n_cells,
                 double order);
} // namespace homespun::verification
