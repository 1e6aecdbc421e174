// SPDX-License-Identifier: MIT
// The stress cases: the unit cell, the cloth in motion and the up-sampling. Limits come from
// theory: a cell that is moved keeps its C^H, damped energy never grows, a free cloth keeps the
// momenta that its integrator keeps, a cloth at rest stays, a uniform strain is up-sampled exactly;
// where theory is silent, that every number is finite.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "meshes/plain/homogenized_cell.h"
#include "verification/extremes/stress_case.h"
#include "verification/extremes/stress_sheet.h"

#include <vector>

namespace homespun::verification
{
/// Steps of 1e-5 to 1 s from rest and from a disturbed state; rest.
std::vector<StressCase> time_step_cases(const std::vector<SheetStiffness> &stiffnesses);

/// 1e-2 to 1e8 N/m times 0.01 to 10 kg/m^2.
std::vector<StressCase> stiffness_cases();

/// Positions that no cloth should begin with.
std::vector<StressCase> start_cases(const std::vector<SheetStiffness> &stiffnesses);

/// Free sheets that spin, up to five turns per step: what each integrator keeps, and that they
/// turn.
std::vector<StressCase> spin_cases(const std::vector<SheetStiffness> &stiffnesses);

/// Free fall, clamped, hung, pulled.
std::vector<StressCase> motion_cases(const std::vector<SheetStiffness> &stiffnesses);

enum class Sphere
{
  there,
  missing
};

/// Bending, wind and an obstacle at the steps of scenes, 0.1 to 50 ms.
/// @param sphere that its cases must notice where it is missing
std::vector<StressCase> scene_cases(const SheetStiffness &stiffness, Sphere sphere = Sphere::there);

/// Up-sampling of violent coarse motions.
std::vector<StressCase> localization_cases(const std::vector<meshes::HomogenizedCell> &cells,
                                           const std::vector<std::string> &names);

/// What the cell cases move where no cell is given, and beside given ones: stripes; a square of
/// yarns of 1e4 to 1.
std::vector<homogenization::UnitCell> built_in_cells();

/// Homogenization against contrast, Poisson's ratio, anisotropy, slivers, symmetry, units, size and
/// ranks. Linear elements on one rank, whatever the number of ranks that call.
/// @param cells the user's: shifted, repeated, turned, mirrored, in other units, and their moduli
///   spread
/// @param by_all_ranks C^H of the built-in cells and then of `cells` by all ranks; none: no cases
///   of ranks
/// @param most_triangles of the largest cell
std::vector<StressCase> cell_cases(const std::vector<homogenization::UnitCell> &cells,
                                   const std::vector<Eigen::Matrix3d> &by_all_ranks, int n_ranks,
                                   int most_triangles);

/// A cell with a smooth periodic chi of a tenth of its side, zero at its lattice points: for where
/// none is given.
meshes::HomogenizedCell smooth_cell();
} // namespace homespun::verification
