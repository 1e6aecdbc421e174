// SPDX-License-Identifier: MIT
// Times of work that may be shorter than a clock can see.
#pragma once

#include "verification/record/timing.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace homespun::verification
{
/// Times of a call [s], after one that is not counted. Each is the mean of as many calls as take a
/// millisecond or so.
template <typename Work>
std::vector<double> repeated_seconds(Work &&work, const int n_runs)
{
  constexpr double visible = 1e-3;
  work();
  const double first = seconds_of(work);
  const int calls    = static_cast<int>(std::clamp(std::ceil(visible / first), 1., 1e6));
  std::vector<double> seconds;
  for (int run = 0; run < n_runs; ++run)
    seconds.push_back(seconds_of(
                        [&]()
                        {
                          for (int call = 0; call < calls; ++call)
                            work();
                        }) /
                      calls);
  return seconds;
}
} // namespace homespun::verification
