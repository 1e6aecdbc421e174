// SPDX-License-Identifier: MIT
#include "verification/converge/converge_cases.h"

namespace homespun::verification
{
const std::vector<std::string> &convergence_studies()
{
  static const std::vector<std::string> all = {"mesh",  "adaptive", "scale",  "coarse",
                                               "edges", "bending",  "strain", "time"};
  return all;
}
} // namespace homespun::verification
