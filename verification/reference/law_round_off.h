// SPDX-License-Identifier: MIT
// What rounding makes of the stress of a law.
#pragma once

#include "verification/reference/laws.h"

#include <limits>

namespace homespun::verification
{
/// As a part of the stiffness: under yarn-tension, which finds its stress by Newton's method and
/// counts less pressure than this as none (yarns/tension_field.cc), more than of laws that are
/// formulas.
inline double round_off_of(const Law law)
{
  return law == Law::yarn_tension ? 1e-13 : std::numeric_limits<double>::epsilon();
}
} // namespace homespun::verification
