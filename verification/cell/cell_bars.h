// SPDX-License-Identifier: MIT
// How far the stiffness and the moduli of a cell may be from those of C^H, and what is shown of
// them.
#pragma once

#include "verification/cell/assessed_cell.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace homespun::verification
{
/// How far each entry of the C that is written may be from C^H [N/m]: guaranteed where there is a
/// bracket, whose mesh or drawing may differ from the mesh of the cell problems.
std::optional<Eigen::Matrix3d> bars_of_stiffness(const AssessedCell &assessed);

/// The same for the moduli; without a bracket to first order, |S| bars |S|.
std::optional<homogenization::EngineeringConstants> bars_of_moduli(const AssessedCell &assessed);

/// C^H and its moduli as they are printed, with their bars. A drawing's C^H is known from its
/// bracket alone, whose middle is shown: C is that of the straight triangles.
struct Shown
{
  Eigen::Matrix3d stiffness; ///< [N/m]
  std::optional<Eigen::Matrix3d> bars;
  std::optional<homogenization::EngineeringConstants> moduli_bars;
};
Shown shown(const AssessedCell &assessed);

/// One line on polygons in the place of arcs, of whose C^H no bar knows; empty where there are
/// none.
std::string geometry_text(const homogenization::UnitCell &cell,
                          const homogenization::Homogenization &result);
} // namespace homespun::verification
