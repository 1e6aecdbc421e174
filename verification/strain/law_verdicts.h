// SPDX-License-Identifier: MIT
// Whether stress and tangent of the references' laws are the derivatives of their energies, for the
// stiffnesses of a cell and up to the strains of a study.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/record/verdict.h"
#include "verification/reference/laws.h"

#include <vector>

namespace homespun::verification
{
/// One claim per law: for every phase of the cell, along stretches, shear and a mixed path,
/// P = dW/dF and dP/dF by central differences.
/// @param strain the largest of the study
std::vector<Verdict> law_verdicts(const homogenization::UnitCell &cell,
                                  const std::vector<Law> &laws, double strain);
} // namespace homespun::verification
