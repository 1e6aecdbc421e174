// SPDX-License-Identifier: MIT
// What stands in a cell file: its keys, and what becomes of their text.
#pragma once

#include "homogenization/cell/cell_mesh_file.h"
#include "homogenization/cell/material.h"
#include "homogenization/cell/parameter_keys.h"
#include "meshes/plain/lattice.h"

#include <optional>
#include <string>
#include <vector>

namespace homespun::homogenization
{
/// The keys of a cell file; every key is said here once.
struct CellKeys
{
  std::string mesh;
  std::string length_unit;
  std::string young, poisson, thickness, density, orthotropic, layers;
  std::string lattice = "auto", tolerance = "auto", slits = "refused";

  /// Adds all keys; their values go here.
  void declare(ParameterKeys &keys);
};

/// The lattice in metres that the key `Lattice vectors` names; nothing where it is `auto`, or where
/// faults were added.
std::optional<meshes::Lattice> lattice_from(const std::string &file, const CellKeys &keys,
                                            double length_unit, Faults &faults);

/// What gaps are that are much thinner than the triangles around them.
enum class Slits
{
  refused, ///< faults of the mesh
  real     ///< meant
};

/// What counts as the same point, and as a hole.
struct SideRules
{
  std::optional<double> tolerance; ///< of images, in units of the shorter lattice vector
  double rounding = 0.; ///< of the coordinates [m]; it sets the tolerance where none is given
  Slits slits     = Slits::refused;
  double metres_per_unit = 1.; ///< of the mesh file, in whose unit lattices are written
};

/// How sides are matched: the keys `Matching tolerance` and `Slits`.
/// @param rounding of the coordinates, in the unit of the mesh
SideRules side_rules(const std::string &file, const CellKeys &keys, double length_unit,
                     double rounding, Faults &faults);

/// Gives every group of the mesh its phase, an orthotropic one a phase per angle where the mesh has
/// an angle per triangle; renumbers mesh.material to indices into the phases.
std::vector<Phase> assign_phases(const std::string &file, const CellKeys &keys,
                                 CellMeshFile &mesh_file, Faults &faults);

/// The documented keys of a cell file, in deal.II's .prm syntax.
std::string unit_cell_keys();
} // namespace homespun::homogenization
