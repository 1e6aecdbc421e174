// SPDX-License-Identifier: MIT
// Where the vertices of a cell lie in a coarse mesh that cuts each cell into r x r quads of two
// triangles: the same in every cell of a sheet. Private to upsampler.
#pragma once

#include "meshes/plain/sheet.h"
#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::localization
{
struct CellGroups
{
  /// Vertices of a block that lie in one coarse triangle.
  struct Group
  {
    int i, j;       ///< quad of the cell
    bool is_above;  ///< its diagonal
    int first_slot; ///< of the table: groups begin with whole blocks of lanes
    std::vector<int> vertices;
    std::vector<Eigen::Vector3d> weights;
  };

  int r = 0; ///< 0: the coarse mesh is none of these
  std::vector<Group> groups;

  /// The coarse triangle of a group in cell (i, j) of a sheet of n1 cells along axis 1.
  int triangle(const Group &group, const int n1, const int i, const int j) const
  {
    return 2 * ((r * j + group.j) * r * n1 + r * i + group.i) + group.is_above;
  }
};

/// How often a coarse mesh cuts the lattice of a sheet: it is meshes::coarse_sheet() with r quads
/// per side of a cell; 0 where it is not.
int quads_per_cell(const meshes::Sheet &sheet, const meshes::TriangleMesh &coarse);

/// @param r quads per cell
CellGroups cell_groups(const meshes::Sheet &sheet, int r);
} // namespace homespun::localization
