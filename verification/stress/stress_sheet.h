// SPDX-License-Identifier: MIT
// The sheet that stress cases torment: small, irregular, of some stiffness, and what is measured on
// it.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "meshes/cloth/irregular_sheet.h"
#include "meshes/plain/law.h"
#include "shell/solver/cloth.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace homespun::verification
{
/// Of the sheet along a side, but where cases say another number.
constexpr int cells_per_side = 8;
constexpr double sheet_side  = 0.2; ///< [m]

/// A membrane stiffness by name.
struct SheetStiffness
{
  std::string name;
  Eigen::Matrix3d D;                        ///< Voigt 11, 22, 12, engineering shear [N/m]
  double areal_density = 0.2;               ///< [kg/m^2]
  meshes::Law law      = meshes::Law::biot; ///< or yarn
  /// Of the second phase of a mesh that has two, over the first: thickness and density [-].
  double thicker = 1., denser = 1.;
};

/// The same, and a twin under the law `yarn`, named so, of each that loses ellipticity under the
/// corotational law, pulled along its yarns, before 20 %.
std::vector<SheetStiffness> with_twins_of_yarn(const std::vector<SheetStiffness> &stiffnesses);

/// E t = young, plane stress.
SheetStiffness isotropic_sheet(double young, double poisson);

/// What the cases take where no cell is given: isotropic (1000 N/m, 0.3), a laminate (C11, C12,
/// C22, C66 of the stripe cell, 2840, 300, 999, 350 N/m), one whose eigenvalues are 10,000, 30 and
/// 1 N/m, off its axes.
std::vector<SheetStiffness> built_in_stiffnesses();

/// A square sheet in the xz plane, upper edge at z = side: as it would hang. Vertex j (n + 1) + i.
meshes::ClothMesh hanging_mesh(int n = cells_per_side);

/// The same in the xy plane.
meshes::ClothMesh lying_mesh(int n = cells_per_side);

/// Both upper corners of a sheet of n x n.
std::vector<int> upper_corners(int n = cells_per_side);

/// How a sheet moves.
struct SheetPhysics
{
  double viscosity            = 1e-3; ///< of the membrane [s]
  double damping              = 0.5;  ///< against the air at rest [1/s]
  Eigen::RowVector3d gravity  = Eigen::RowVector3d(0., 0., -9.81); ///< [m/s^2]; zero: no such term
  shell::ClothOptions options = {};
};

/// A cloth with membrane, and the terms that the physics asks for.
shell::Cloth sheet_cloth(const meshes::ClothMesh &mesh, const SheetStiffness &stiffness,
                         const std::vector<int> &held, const SheetPhysics &physics = {});

/// Positions and velocities side by side (n,6): what a user gets.
Eigen::MatrixXd state_of(const shell::Cloth &cloth);

/// Takes steps. The growth of kinetic and stored energy, the largest within one step, over the
/// largest energy met [-]; zero where there is none.
double largest_energy_growth(shell::Cloth &cloth, double h, int n_steps);

/// Growth of energy that round-off explains, over the largest energy: the cloth's own slack
/// (shell/solver/cloth.cc), 1e-12 of the energy before and of what is stored, in up to five parts
/// of a step that was cut.
constexpr double energy_round_off = 1e-11;
} // namespace homespun::verification
