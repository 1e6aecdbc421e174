// SPDX-License-Identifier: MIT
// Meshes of unit cells from files, whatever their format, as a plain mesh of triangles.
#pragma once

#include "homogenization/cell/curved_sides.h"
#include "meshes/plain/triangle_mesh.h"

#include <mpi.h>

#include <map>
#include <string>
#include <vector>

namespace homespun::homogenization
{
/// A mesh file as it stands: coordinates in the file's own unit, material numbers as written.
struct CellMeshFile
{
  meshes::TriangleMesh mesh; ///< mesh.material holds the file's numbers
  /// Names of groups, where the file has them; 0, where no triangle has it: of all of them.
  std::map<std::string, int> number_of_name;
  Eigen::VectorXd angle;                ///< (m) cell data `angle` of the file [deg], or empty
  std::vector<std::string> other_data;  ///< names of cell data that nobody reads
  std::vector<CurvedSide> curved_sides; ///< of six-node triangles, in the file's unit
  /// To what coordinates are rounded, in the file's unit; 0 where they have all digits.
  double rounding = 0.;
};

/// Reads a mesh. Quadrilaterals are cut in two along their shorter diagonal (along the one that
/// lies inside, where they are not convex); elements are turned counter-clockwise; points that no
/// element has as a corner are left out, the middle nodes of six-node triangles among them. Text
/// .msh 1, 2 and 4 and .obj are read here, any other format converted to .msh first.
/// @param communicator as of converted_to_msh()
/// @throws BadInput naming the file, the line, what was found and what was expected
CellMeshFile read_cell_mesh(const std::string &file, MPI_Comm communicator = MPI_COMM_NULL);
} // namespace homespun::homogenization
