// SPDX-License-Identifier: MIT
// What the law `yarn` makes of a cell: which phases have yarns, which keep `biot`, and where those
// of the coarse cloth lie.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/strain/strain_options.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace homespun::verification
{
/// @param references names of laws
/// @throws BadInput where the law `yarn` is asked for of a cell none of whose phases has axes
void check_yarns(const std::vector<homogenization::UnitCell> &cells,
                 const std::vector<std::string> &references);

/// Ready sentences: phases that keep `biot` under the law `yarn`, and the axes of those whose
/// stiffness has others than the orthotropic axes that are given; none of a cell that is not
/// studied under it.
std::vector<std::string> notes_on_yarns(const std::vector<homogenization::UnitCell> &cells,
                                        const StrainStudyOptions &asked);

/// A sentence on the coarse cloth beside a reference of the law `yarn`: where its yarns lie, or
/// that it stays corotational.
/// @param stiffness C^H (3,3) [N/m]
std::string note_on_coarse_yarns(const Eigen::Matrix3d &stiffness);
} // namespace homespun::verification
