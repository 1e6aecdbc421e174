// SPDX-License-Identifier: MIT
// Meshes of unit cells from files: whatever deal.II's GridIn reads, as a plain mesh.
#pragma once

#include "meshes/triangle_mesh.h"

#include <exception>
#include <map>
#include <string>

namespace homespun::homogenization
{
/// A mesh file as it stands: coordinates in the file's own unit, material numbers as written.
struct CellMeshFile
{
  meshes::TriangleMesh mesh;                 ///< mesh.material holds the file's numbers
  std::map<std::string, int> number_of_name; ///< physical names of a .msh file
};

/// Reads a mesh; quadrilaterals are cut in two along a diagonal.
/// @throws BadInput naming the file and deal.II's reason
CellMeshFile read_cell_mesh(const std::string &file);

/// The sentence of a deal.II exception, without its frame of dashes and source lines.
std::string reason_of(const std::exception &exception);
} // namespace homespun::homogenization
