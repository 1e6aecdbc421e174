// SPDX-License-Identifier: MIT
// A cell file read as far as it can be, with all that is wrong: what read_unit_cell() refuses, and
// what the linter shows.
#pragma once

#include "homogenization/cell/finding.h"
#include "homogenization/cell/unit_cell.h"

#include <mpi.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace homespun::homogenization
{
struct CellReading
{
  UnitCell
    cell; ///< [m]; where its phases could not be given, material holds the numbers of the mesh file
  double metres_per_unit = 1.;    ///< of the mesh file
  bool has_mesh          = false; ///< the mesh file was read
  bool has_phases = false; ///< its groups have their phases, and material holds their indices
  bool is_whole   = false; ///< mesh, phases and lattice are sound: a UnitCell
  std::vector<Finding> findings;
};

/// Reads a cell; parts that move freely and contrasts that leave no digit are errors here already,
/// because no solver could answer.
/// @param communicator reads together: its first rank converts a mesh of another format than .msh
///   for all, which must all call this; MPI_COMM_NULL: this process reads alone
CellReading read_unit_cell_with_findings(const std::string &prm_file, MPI_Comm communicator);

/// Reads a cell alone and adds the findings of the linter, as many as the state of the cell allows.
CellReading inspect_cell(const std::string &prm_file);

/// Reads and validates a cell file.
/// @param communicator as of read_unit_cell_with_findings()
/// @param warnings where it says, a line each, what it did to the drawing and what else that may
/// be:
///   points that were moved, a second cloth, a missing triangle, why there are no sheets; or null
/// @throws BadInput with one message per fault, each naming the file and the key, group or element
UnitCell read_unit_cell(const std::string &prm_file, MPI_Comm communicator = MPI_COMM_NULL,
                        std::ostream *warnings = nullptr);
} // namespace homespun::homogenization
