// SPDX-License-Identifier: MIT
// What the law `yarn` makes of a cell: which phases have yarns, which keep `biot`, and where those
// of the coarse cloth lie.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/law/laws.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace homespun::verification
{
/// @param option by which the laws are asked for, for the message
/// @param names of laws, and what else the option may name
/// @throws BadInput where a law of yarns is asked for of a cell none of whose phases has axes
void check_yarns(const std::vector<homogenization::UnitCell> &cells, const std::string &option,
                 const std::vector<std::string> &names);

/// Ready sentences: phases that keep `biot` under the laws of yarns, and the axes of those whose
/// stiffness has others than the orthotropic axes that are given.
/// @param references names of the cell's laws; none of yarns: nothing is said
std::vector<std::string> notes_on_yarns(const homogenization::UnitCell &cell,
                                        const std::vector<std::string> &references);

/// What is to be known of a coarse cloth under a law: of yarns, note_on_coarse_yarns(); else
/// note_on_corotational_cloth() (default_law.h). Empty where nothing is.
/// @param stiffness C^H (3,3) [N/m]
std::string note_on_coarse_cloth(Law law, const Eigen::Matrix3d &stiffness);

/// A sentence on the coarse cloth beside a reference of a law of yarns: where its yarns lie, or
/// that it stays corotational.
/// @param stiffness C^H (3,3) [N/m]
std::string note_on_coarse_yarns(Law law, const Eigen::Matrix3d &stiffness);
} // namespace homespun::verification
