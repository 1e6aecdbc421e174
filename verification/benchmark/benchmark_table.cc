// SPDX-License-Identifier: MIT
#include "verification/benchmark/benchmark_study.h"

#include <cstdio>
#include <utility>

namespace homespun::verification
{
namespace
{
/// A time or an amount with three digits and a prefix of its unit.
std::string with_prefix(double value, const std::string &unit)
{
  static const std::pair<double, const char *> prefixes[] = {
    {1e12, "T"}, {1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1., ""}, {1e-3, "m"}, {1e-6, "u"}};
  for (const auto &[factor, prefix] : prefixes)
    if (value >= factor * 0.9995 || factor == 1e-6)
    {
      char text[32];
      std::snprintf(text, sizeof(text), "%.3g ", value / factor);
      return text + std::string(prefix) + unit;
    }
  return "";
}
} // namespace

std::string table_of(const std::vector<BenchmarkRow> &rows)
{
  char line[200];
  std::snprintf(line, sizeof(line), "%-32s %6s %10s %10s %10s %16s %9s  %s\n", "part", "ranks",
                "median", "mean", "95 %", "in a second", "of limit", "limit");
  std::string text = line;
  for (const BenchmarkRow &row : rows)
  {
    char share[16] = "-";
    if (row.of_limit == row.of_limit)
      std::snprintf(share, sizeof(share), "%.2g", row.of_limit);
    std::snprintf(line, sizeof(line), "%-32s %6d %10s %10s %10s %16s %9s  %s\n", row.part.c_str(),
                  row.ranks, with_prefix(row.seconds, "s").c_str(),
                  with_prefix(row.mean, "s").c_str(), with_prefix(row.percentile_95, "s").c_str(),
                  with_prefix(row.rate(), row.unit).c_str(), share,
                  row.limit.empty() ? "-" : row.limit.c_str());
    text += line;
  }
  return text;
}
} // namespace homespun::verification
