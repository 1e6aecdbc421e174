// SPDX-License-Identifier: MIT
// Meshes of other formats than Gmsh's, converted to it by Python: meshio reads what it knows, Gmsh
// .unv (convert_mesh.py).
#pragma once

#include <mpi.h>

#include <string>

namespace homespun::homogenization
{
/// A mesh as the text of a .msh of format 2.2, with its groups, their names, and cell data `angle`.
/// @param file a mesh of any other format
/// @param communicator its first rank converts and hands the text to the others: all of its ranks
///   must call this. With MPI_COMM_NULL this process converts for itself, and MPI need not run.
/// @throws BadInput on every rank: what was found, what was expected, which package is missing
std::string converted_to_msh(const std::string &file, MPI_Comm communicator);
} // namespace homespun::homogenization
