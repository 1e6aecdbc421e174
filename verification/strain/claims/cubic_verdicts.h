// SPDX-License-Identifier: MIT
// The cubic energy of a cell, which the homogenizer has by perturbation, held against the stress of
// the resolved infinite cloth: two programs for one coefficient.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "meshes/plain/homogenized_cell.h"
#include "verification/record/verdict.h"
#include "verification/strain/strain_options.h"
#include "verification/strain/strain_tables.h"

#include <vector>

namespace homespun::verification
{
/// Whether a study asks for the claim below: the load gives the motion of an infinite cloth,
/// methods have the cubic energy W3 of the law, and two strains up to 1 % lie apart by a factor
/// of 2.
bool has_cubic_claim(const StrainStudyOptions &options, const Load &load, Law law);

/// forces.csv: the stress that the references of a cell have beyond that of C^H,
///   (P_resolved − P_coarse) : dF/ds = 3 W3(e) s² + O(s³),   E = e s + O(s²),
/// at the smallest strain s1, over s1². The term of third order is what extrapolation from s1 and
/// the next strain s2 >= 2 s1 to zero finds, times the factor of safety of two levels. Open where
/// that is more than a tenth of the stiffness, where the law is lost up to s2, or where a strain
/// was not reached. What the references leave counts, too, left_in_stress().
std::vector<Verdict> cubic_verdicts(const std::vector<ForceRow> &rows,
                                    const std::vector<LevelRow> &levels,
                                    const StrainStudyOptions &options,
                                    const homogenization::UnitCell &cell,
                                    const meshes::HomogenizedCell &homogenized);
} // namespace homespun::verification
