// SPDX-License-Identifier: MIT
// Modes that a study fits to its cell, over the strains that it asks for.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "meshes/plain/fitted_modes.h"
#include "meshes/plain/homogenized_cell.h"
#include "verification/strain/strain_options.h"
#include "verification/strain/strain_output.h"

#include <map>

namespace homespun::verification
{
/// Fits modes under the laws of the references, over a box up to the largest strain of the study,
/// where a method asks for them; notes what they leave, or why there are none; and adds them to the
/// file of the cell, for whoever up-samples a motion of his own. First rank.
/// @return by law
std::map<Law, meshes::FittedModes> modes_of_study(const StrainStudyOptions &options,
                                                  const homogenization::UnitCell &cell,
                                                  const meshes::HomogenizedCell &homogenized,
                                                  StrainOutput &output);
} // namespace homespun::verification
