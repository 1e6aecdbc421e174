// SPDX-License-Identifier: MIT
// The bending stiffness D^H of a cell as the program makes it: between two guaranteed sides, on the
// mesh as given or adaptively to a width; its bars and its verdicts.
#pragma once

#include "homogenization/bracket/bending_bracket.h"
#include "homogenization/fem/homogenize.h"
#include "verification/cell/cell_bracket.h"
#include "verification/cell/rolled_sheet.h"
#include "verification/record/verdict.h"

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// A bracket on D^H, or the reason why there is none.
struct CellBending
{
  std::optional<homogenization::BendingBracket> bracket; ///< on the last mesh
  std::string remark;       ///< why there is none, or how adaptivity ended
  bool is_left_out = false; ///< the settings allow none on this mesh
  std::vector<BracketStep> history;
  std::optional<KnownRoll> roll = std::nullopt; ///< where somebody asked for it
};

/// Brackets D^H on this process alone.
/// @param report is told of each step, one line
CellBending bending_of(const homogenization::UnitCell &cell, const BracketOptions &options,
                       const std::function<void(const std::string &)> &report);

/// Rolls a cell up, on this process alone.
KnownRoll roll_of(const homogenization::UnitCell &cell, const BracketOptions &options);

/// D_lower <= D <= D_upper, and the width that was asked for; that there is none where neither the
/// settings nor --max-dofs left it out.
std::vector<Verdict> checks_of(const CellBending &bending, const BracketOptions &options);

/// How far each entry of D may be from that of D^H: |D_ij − D^H_ij| <= sqrt(G_ii G_jj), G = upper −
/// lower [N m].
Eigen::Matrix3d bars_of(const homogenization::BendingBracket &bracket);

/// Of narrow strips and their twist, free at their sides: E1 = 1/S11, E2 = 1/S22, G12 = 1/S66 [N m]
/// with S = D^-1, nu12 = −S12/S11, nu21 = −S12/S22. A cantilever along axis 1 measures 1/S11.
homogenization::EngineeringConstants bending_moduli(const homogenization::BendingBracket &bracket);
homogenization::EngineeringConstants
bars_of_bending_moduli(const homogenization::BendingBracket &bracket);

/// The range of cloth [N m]: far outside of all measured fabrics a unit is wrong, or a thickness.
constexpr double softest_cloth = 1e-7, stiffest_cloth = 1e-3;

/// One line where D11 or D22 lies outside of the range of cloth; else empty.
std::string range_text(const Eigen::Matrix3d &bending_stiffness);
} // namespace homespun::verification
