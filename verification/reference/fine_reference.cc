// SPDX-License-Identifier: MIT
#include "verification/reference/fine_reference.h"

#include "verification/record/number_text.h"

namespace homespun::verification
{
std::string name_of(const Stability stability)
{
  switch (stability)
  {
  case Stability::every_triangle:
    return "every triangle";
  case Stability::stable:
    return "stable";
  case Stability::left:
    return "left";
  case Stability::unstable:
    return "unstable";
  case Stability::unknown:
    break;
  }
  return "unknown";
}

std::string note_of_round_off(const ReferenceStep &step)
{
  if (!step.is_at_round_off || !(step.relative_residual > 1e-6))
    return {};
  return "the reference is accepted at round-off: " + short_text(step.relative_residual) +
         " of its forces are left, those of the stiff phases; expected 1e-6 at most: a smaller "
         "contrast, or a larger strain";
}
} // namespace homespun::verification
