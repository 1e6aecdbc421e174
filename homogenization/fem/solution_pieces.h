// SPDX-License-Identifier: MIT
// The characteristic displacements on the mesh on which they were solved, for ParaView: a piece
// from each rank.
#pragma once

#include <array>
#include <string>

namespace dealii::TrilinosWrappers::MPI
{
class Vector;
}

namespace homespun::homogenization
{
class Discretization;

/// Writes NAME-RANK.vtu of the triangles that a rank owns, with chi_11, chi_22, chi_12 [m] at their
/// vertices, material and rank, and NAME.pvtu, which names the pieces, by deal.II's DataOutBase.
/// Midpoints of P2 are left out. All ranks must call this.
/// @param name path without ending, in a folder that exists
/// @param solutions with the ghosts of the rank's triangles
/// @throws BadInput, on all ranks, where a file cannot be written
void write_pieces(const std::string &name, const Discretization &discretization,
                  const std::array<dealii::TrilinosWrappers::MPI::Vector, 3> &solutions);

/// Removes what write_pieces() left under a name, on any number of ranks. One rank calls this.
void remove_pieces(const std::string &name);
} // namespace homespun::homogenization
