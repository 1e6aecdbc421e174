// SPDX-License-Identifier: MIT
// What one thread of this machine can do, measured on the spot, and fractions of it as counters.
// Google Benchmark prints a rate with "/s"; a fraction has no unit, so the seconds of the loop are
// taken here.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <ctime>
#include <map>
#include <vector>

namespace homespun::benchmarks
{
/// Processor time of this thread [s]: what others do on the machine counts little.
inline double seconds()
{
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Bytes per second that a copy of so many bytes writes, the best of several; it reads as many.
inline double copy_bandwidth(const std::size_t bytes)
{
  static std::map<std::size_t, double> known;
  if (const auto found = known.find(bytes); found != known.end())
    return found->second;
  std::vector<char> from(bytes, 1), to(bytes, 0);
  double best = 1e9;
  // Small copies are repeated until a clock can see them.
  const int copies = static_cast<int>(1 + 1000000 / (bytes + 1));
  for (int k = 0; k < (bytes > 50000000 ? 5 : 50); ++k)
  {
    const double begin = seconds();
    for (int i = 0; i < copies; ++i)
    {
      std::memcpy(to.data(), from.data(), bytes);
      benchmark::DoNotOptimize(to.data());
      benchmark::ClobberMemory();
    }
    best = std::min(best, (seconds() - begin) / copies);
  }
  return known[bytes] = static_cast<double>(bytes) / best;
}

/// Flops per second of independent multiply-adds in registers, the best of several; two flops each.
inline double multiply_add_peak()
{
  static const double peak = []
  {
    // Twelve chains of the widest vector hide the latency of two units.
    constexpr int chains = 12, turns = 100000;
    using Lanes        = double __attribute__((vector_size(8 * sizeof(double))));
    double best        = 1e9;
    const Lanes factor = Lanes{} + 0.999999, summand = Lanes{} + 1e-6;
    for (int k = 0; k < 30; ++k)
    {
      Lanes sum[chains];
      for (int c = 0; c < chains; ++c)
        sum[c] = Lanes{} + 0.1 * c;
      const double begin = seconds();
      for (int i = 0; i < turns; ++i)
#pragma GCC unroll 12
        for (int c = 0; c < chains; ++c)
          sum[c] = sum[c] * factor + summand;
      best = std::min(best, seconds() - begin);
      benchmark::DoNotOptimize(sum);
    }
    return 2. * chains * turns * 8. / best;
  }();
  return peak;
}

/// The time between construction and report().
class Fractions
{
public:
  explicit Fractions(benchmark::State &state)
      : state(state)
      , begin(seconds())
  {
  }

  /// @param flops of one iteration; zero: not told
  /// @param bytes that one iteration reads and writes at least; zero: not told. Compared with a
  ///   copy that reads and writes as many, which stays in the same cache.
  /// @param times how often an iteration does that
  void report(const double flops, const double bytes, const double times = 1.) const
  {
    const double of_one = (seconds() - begin) / (times * static_cast<double>(state.iterations()));
    const auto here     = [](const double value)
    { return benchmark::Counter(value, benchmark::Counter::kAvgThreads); };
    if (flops > 0.)
    {
      state.counters["flops"]   = here(flops);
      state.counters["of_peak"] = here(flops / of_one / multiply_add_peak());
    }
    if (bytes > 0.)
    {
      state.counters["bytes"] = here(bytes);
      state.counters["of_copy"] =
        here(0.5 * bytes / of_one / copy_bandwidth(static_cast<std::size_t>(0.5 * bytes)));
    }
  }

private:
  benchmark::State &state;
  const double begin;
};
} // namespace homespun::benchmarks
