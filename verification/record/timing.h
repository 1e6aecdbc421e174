// SPDX-License-Identifier: MIT
// Times of repeated work, by their median: the one figure that neither a cold start nor a busy
// machine decides.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <limits>
#include <vector>

namespace homespun::verification
{
/// Middle value; of an even number the mean of the two in the middle; not a number of none.
inline double median(std::vector<double> values)
{
  if (values.empty())
    return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// Half of the distance between the medians of the lower and the upper half; not a number of less
/// than two.
inline double half_of_interquartile_range(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const auto half = static_cast<std::ptrdiff_t>(values.size() / 2);
  return 0.5 * (median({values.end() - half, values.end()}) -
                median({values.begin(), values.begin() + half}));
}

/// Wall time of some work [s].
template <typename Work>
double seconds_of(Work &&work)
{
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Median time of some runs [s].
template <typename Work>
double median_seconds(Work &&work, const int n_runs = 5)
{
  std::vector<double> seconds;
  for (int run = 0; run < n_runs; ++run)
    seconds.push_back(seconds_of(work));
  return median(seconds);
}
} // namespace homespun::verification
