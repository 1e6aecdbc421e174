// SPDX-License-Identifier: MIT
// The table of `homespun benchmark`: a row per part of the work, and per limit of the machine.
#pragma once

#include "verification/record/table.h"

#include <limits>
#include <string>

namespace homespun::verification
{
struct BenchmarkRow
{
  static constexpr const char *file    = "benchmark.csv";
  static constexpr std::size_t n_keys  = 1;
  static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

  std::string part;
  int runs       = 0;
  double seconds = 0., mean = 0., percentile_95 = 0.; ///< of one run: the median, ... [s]
  double work = 0.;                                   ///< of one run, in `unit`
  std::string unit;
  std::string limit;              ///< the row that says how fast the machine is; or nothing
  double of_limit = not_a_number; ///< work per median, relative to that of the limit [-]
  int ranks = 1, threads = 1;     ///< threads of each rank

  /// Work in a second.
  double rate() const
  {
    return work / seconds;
  }

  template <typename Column>
  static void columns(Column &&column)
  {
    column("part", &BenchmarkRow::part, Domain::name);
    column("runs", &BenchmarkRow::runs, Domain::positive);
    column("seconds", &BenchmarkRow::seconds, Domain::positive);
    column("seconds_mean", &BenchmarkRow::mean, Domain::positive);
    column("seconds_95", &BenchmarkRow::percentile_95, Domain::positive);
    column("work", &BenchmarkRow::work, Domain::positive);
    column("unit", &BenchmarkRow::unit, Domain::name);
    column("limit", &BenchmarkRow::limit, Domain::text);
    column("of_limit", &BenchmarkRow::of_limit, Domain::not_negative);
    column("ranks", &BenchmarkRow::ranks, Domain::positive);
    column("threads_per_rank", &BenchmarkRow::threads, Domain::positive);
  }
};
} // namespace homespun::verification
