// SPDX-License-Identifier: MIT
// The mesh formats that cells come in, each read into the same plain list of triangles and
// quadrilaterals. They are read here, and not by deal.II's GridIn, because that knows no triangles
// in .inp, .ucd and .unv, takes .vtu only of its own making and .vtk without the groups that Gmsh
// writes, knows no names of groups and no angles, and throws away meshes that are broken, of which
// the linter shows where.
#pragma once

#include "homogenization/cell/mesh_text.h"

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
  std::map<std::string, int> number_of_name; ///< names of groups, where the format has them
  std::vector<double> angles;                ///< cell data `angle` [deg], one per cell, or none
};

/// Gmsh's text format 1, 2, 4.0 and 4.1. The group is the first physical number, 0 where there is
/// none.
RawMesh read_msh(MeshText &text);

/// Legacy VTK, unstructured grids as text. The group is cell data of one of the names of
/// is_group_array().
RawMesh read_vtk(MeshText &text);

/// VTK's XML format: text, base64 or appended, compressed by zlib or not. Groups as in read_vtk().
RawMesh read_vtu(const std::string &file);

/// AVS UCD: the group is the material number of the element.
RawMesh read_ucd(MeshText &text);

/// Abaqus: groups are element sets, those of *ELSET before those of *ELEMENT.
RawMesh read_abaqus(MeshText &text);

/// I-DEAS universal: groups are permanent groups of elements, else the number of the physical
/// property.
RawMesh read_unv(MeshText &text);

/// Points by the numbers that a file gives them.
class PointNumbers
{
public:
  void add(MeshText &text, RawMesh &mesh, long number, const Eigen::Vector3d &point);
  int index(MeshText &text, long number) const;

private:
  std::unordered_map<long, int> index_of;
};

/// Whether cell data of this name tells groups: material, MaterialID, CellEntityIds, gmsh:physical,
/// group and the like.
bool is_group_array(const std::string &name);

/// A group number, whole and not too large.
int group_number(const MeshText &text, double value);

/// Adds an element of VTK's numbering; vertices and lines are passed over, what is neither flat nor
/// straight refused.
/// @return whether it was added
bool add_vtk_cell(MeshText &text, RawMesh &mesh, long type, const std::vector<long> &corners);

/// What to do about elements with nodes on their sides, or solid ones.
extern const char *const straight_and_flat;
} // namespace homespun::homogenization
