// SPDX-License-Identifier: MIT
// What the steps of a run took: a mean and a tail beside the median, which says nothing of the few
// steps that factor again and again.
#pragma once

#include "verification/record/timing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace homespun::verification
{
struct StepTimes
{
  static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

  double median = not_a_number, mean = not_a_number; ///< [s]
  /// The least time that 95 of 100 steps do not exceed [s].
  double percentile_95 = not_a_number;
};

/// @param seconds of every step; of none, nothing is a number
inline StepTimes step_times(std::vector<double> seconds)
{
  if (seconds.empty())
    return {};
  std::sort(seconds.begin(), seconds.end());
  const auto n    = static_cast<double>(seconds.size());
  const auto rank = static_cast<std::size_t>(std::ceil(0.95 * n - 1e-9));
  return {median(seconds), std::accumulate(seconds.begin(), seconds.end(), 0.) / n,
          seconds[std::max<std::size_t>(rank, 1) - 1]};
}
} // namespace homespun::verification
