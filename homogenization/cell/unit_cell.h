// SPDX-License-Identifier: MIT
// A periodic unit cell: its mesh, its lattice, the materials of its phases.
#pragma once

#include "homogenization/cell/curved_sides.h"
#include "homogenization/cell/material.h"
#include "homogenization/cell/shifted_cell.h"
#include "meshes/plain/lattice.h"
#include "meshes/plain/triangle_mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace homespun::homogenization
{
/// A periodic cell in SI units. mesh.material holds indices into phases.
struct UnitCell
{
  std::string name;          ///< the file's name without its ending
  std::string file;          ///< the .prm file
  meshes::TriangleMesh mesh; ///< [m]
  meshes::Lattice lattice;
  std::vector<Phase> phases;
  std::vector<CurvedSide> curved_sides; ///< of the mesh, where the drawing has arcs
  std::optional<CellShift> shift;       ///< where the cell is cut from another place than drawn

  /// Membrane stiffness of each phase, (3,3) [N/m].
  std::vector<Eigen::Matrix3d> stiffness_of_phase() const;

  /// Bending stiffness of each phase, (3,3) [N m].
  std::vector<Eigen::Matrix3d> bending_stiffness_of_phase() const;

  /// The group of each phase, 0, 1, ... as they first appear. Phases of one name differ in their
  /// angle alone, where the mesh has an angle per triangle; else each is a group of its own.
  std::vector<int> group_of_phase() const;

  /// The first phase of each group.
  std::vector<int> phase_of_group() const;

  /// Mass per area of the cell, sum over triangles of area x thickness x density / |Y| [kg/m^2].
  /// @param areas of its triangles, drawn_areas() where it is not that of the straight ones [m^2]
  double areal_density(const Eigen::VectorXd &areas) const;
  double areal_density() const;
};
} // namespace homespun::homogenization
