// SPDX-License-Identifier: MIT
// Gmsh's .msh as a plain list of triangles and quadrilaterals. It is read here, and not by
// deal.II's GridIn, because that knows no names of groups and no angles, and throws away meshes
// that are broken, of which the linter shows where. Other formats are converted to it
// (converted_mesh.h).
#pragma once

#include "homogenization/mesh_files/mesh_text.h"

#include <Eigen/Core>

#include <array>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace homespun::homogenization
{
/// What a file says, in its order and its unit.
struct RawMesh
{
  struct Cell
  {
    std::array<int, 4> corners; ///< indices of points; the last is unused in a triangle
    int n_corners;              ///< 3 or 4
    int group = 0;
    /// Points in the middles of the sides of a six-node triangle, the first between the corners 0
    /// and 1; else −1.
    std::array<int, 3> middles = {-1, -1, -1};
  };

  std::vector<Eigen::Vector3d> points;
  std::vector<Cell> cells;
  std::map<std::string, int> number_of_name; ///< names of groups, where the file has them
  std::vector<double> angles;                ///< cell data `angle` [deg], one per cell, or none
  DecimalDigits digits;                      ///< of the coordinates
  std::vector<std::string> other_data;       ///< names of other cell data, which nobody reads
};

/// Gmsh's text format 1, 2, 4.0 and 4.1. The group is the first physical number, 0 where there is
/// none; $ElementData called `angle` gives the angles.
RawMesh read_msh(MeshText &text);

/// Points by the numbers that a file gives them.
class PointNumbers
{
public:
  void add(MeshText &text, RawMesh &mesh, long number, const Eigen::Vector3d &point);
  int index(MeshText &text, long number) const;

private:
  std::unordered_map<long, int> index_of;
};

/// A group number, whole and not too large.
int group_number(const MeshText &text, double value);

/// What to do about elements with nodes on their sides, or solid ones.
extern const char *const straight_and_flat;
} // namespace homespun::homogenization
