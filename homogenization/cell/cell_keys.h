// SPDX-License-Identifier: MIT
// What stands in a cell file: its keys, and what becomes of their text.
#pragma once

#include "homogenization/cell/cell_mesh_file.h"
#include "homogenization/cell/material.h"
#include "homogenization/cell/parameter_text.h"
#include "meshes/plain/lattice.h"

#include <deal.II/base/parameter_handler.h>

#include <optional>
#include <string>
#include <vector>

namespace homespun::homogenization
{
/// The keys of a cell file; every key is said here once.
struct CellKeys
{
  std::string mesh;
  std::string length_unit = "0.01";
  std::string young, poisson, thickness, density, orthotropic;
  std::string lattice = "auto";

  void declare(dealii::ParameterHandler &keys)
  {
    keys.add_parameter(
      "Mesh", mesh,
      "Mesh of one periodic cell, a file in the folder of this one or below: .msh, .vtk, .vtu, "
      ".ucd, .inp or .unv, with triangles or quadrilaterals.");
    keys.add_parameter("Length unit", length_unit,
                       "Metres per mesh unit [m], positive; 0.01 for a mesh in centimetres.");
    keys.add_parameter(
      "Young's modulus", young,
      "[Pa] One value per group of the mesh, `group: value, ...`; a group is a physical name "
      "or number.");
    keys.add_parameter("Poisson's ratio", poisson,
                       "[-] One value per group, strictly between -1 and 1.");
    keys.add_parameter("Thickness", thickness, "[m] One value per group.");
    keys.add_parameter("Density", density, "[kg/m^3] One value per group.");
    keys.add_parameter(
      "Orthotropic", orthotropic,
      "`group: E1 E2 nu12 G12 angle, ...` in [Pa], [Pa], [-], [Pa] and [deg] from the x axis to "
      "the first axis of the material; replaces Young's modulus and Poisson's ratio for that "
      "group. Cell data `angle` [deg] of a .vtk or .vtu mesh, one value per triangle, is added.");
    keys.add_parameter(
      "Lattice vectors", lattice,
      "`auto` finds the sides of a parallelogram, or the translations that match any other "
      "outline; or `x1 y1; x2 y2` in mesh units.");
  }
};

/// The lattice in metres that the key `Lattice vectors` names, or that of the outline.
/// @param mesh [m]
/// @return nothing where faults were added
std::optional<meshes::Lattice> lattice_from(const std::string &file, const CellKeys &keys,
                                            double length_unit, const meshes::TriangleMesh &mesh,
                                            Faults &faults);

/// Gives every group of the mesh its phase, an orthotropic one a phase per angle where the mesh has
/// an angle per triangle; renumbers mesh.material to indices into the phases.
std::vector<Phase> assign_phases(const std::string &file, const CellKeys &keys,
                                 CellMeshFile &mesh_file, Faults &faults);

/// The documented keys of a cell file, in deal.II's .prm syntax.
std::string unit_cell_keys();
} // namespace homespun::homogenization
