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
  std::string length_unit = "0.01";
  std::string young, poisson, thickness, density, orthotropic;
  std::string lattice = "auto";

  /// Adds all keys; their values go here.
  void declare(ParameterKeys &keys);
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
