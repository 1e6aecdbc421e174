// SPDX-License-Identifier: MIT
// By which elements a resolved cloth is solved.
#pragma once

#include "verification/law/laws.h"

namespace homespun::verification
{
struct ClothReferenceOptions
{
  Law law              = Law::biot; ///< biot or green
  unsigned int order   = 1;         ///< P1 or P2
  unsigned int refine  = 0;         ///< uniform refinements of the rest mesh
  bool consistent_mass = false;     ///< else lumped: row sums (P1), scaled diagonal of HRZ (P2)
  double tolerance     = 1e-8;      ///< of |residual| relative to the size of the element forces
};
} // namespace homespun::verification
