// SPDX-License-Identifier: MIT
// The resolved sheet by a second code: the element of the moving cloth at full resolution, with its
// own assembly, its own solver (direct) and its own reading of which triangle has which phase. It
// minimises the same discrete energy as FineReference with P1, and shares with it the mesh of the
// sheet, the stiffness of the phases and what a load prescribes.
#pragma once

#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/sheet.h"
#include "shell/solver/equilibrium.h"
#include "verification/law/laws.h"
#include "verification/reference/loads.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

namespace homespun::verification
{
/// The phase of every triangle of a sheet, read off the cell at the image of its centroid.
/// @throws std::logic_error where no triangle of the cell has a centroid there
Eigen::VectorXi phases_of_sheet(const meshes::HomogenizedCell &cell, const meshes::Sheet &sheet);

/// How far two codes that solve one discrete problem may be apart, mean over the vertices in strain
/// x cell side: both leave 1e-11 of the forces or less, times 1e5 for the condition of a sheet.
constexpr double agreement = 1e-6;

/// Whether the second code has a law: `linear`, `biot` and `yarn`, those of the moving cloth.
bool second_code_has(Law law);

/// The resolved sheet under one load.
class SecondSheet
{
public:
  /// @param cell whose mesh, lattice and phases are used, not its chi; cell and sheet are looked at
  ///   as long as this lives
  SecondSheet(const meshes::HomogenizedCell &cell, std::vector<Eigen::Matrix3d> stiffness_of_phase,
              const meshes::Sheet &sheet, const Load &load);

  /// In linear theory: of periodic loads the affine motion and the chi of the direct solver on the
  /// glued cell.
  /// @return (n,2) positions of the fine vertices [m]
  meshes::Points linear(double strain) const;

  /// Under `biot` or `yarn` at a strain, from its own answer in linear theory until round-off; of
  /// periodic loads the cell at finite strain (nonlinear_cell.h), whose laws are those of the
  /// reference.
  /// @return (n,2) positions of the fine vertices [m]
  /// @throws NotConverged
  meshes::Points nonlinear(Law law, double strain) const;

private:
  const shell::MembraneSolver<> &solver_under(Law law) const;

  const meshes::HomogenizedCell &cell;
  const std::vector<Eigen::Matrix3d> stiffness_of_phase;
  const meshes::Sheet &sheet;
  const Load load;
  /// With yarns and without, where they were asked for: numbered and ordered once.
  mutable std::array<std::unique_ptr<shell::MembraneSolver<>>, 2> solvers;
};

/// C^H of P2 on the cell's mesh by the direct solver on the glued mesh [N/m].
Eigen::Matrix3d second_p2_stiffness(const meshes::HomogenizedCell &cell,
                                    const std::vector<Eigen::Matrix3d> &stiffness_of_phase);
} // namespace homespun::verification
