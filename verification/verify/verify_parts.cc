// SPDX-License-Identifier: MIT
// What of `homespun verify` solves nothing: the names of its parts, and its first line.
#include "verification/verify/verify_study.h"

#include <algorithm>
#include <cstdio>

namespace homespun::verification
{
const std::vector<std::string> &verify_parts()
{
  static const std::vector<std::string> parts = {"homogenize", "strain",   "bend",   "load",
                                                 "stability",  "converge", "stress", "drape"};
  return parts;
}

std::vector<std::string> default_parts(const std::vector<std::string> &cell_files)
{
  if (!cell_files.empty())
    return verify_parts();
  return {"stress"};
}

std::string outcome_line(const std::vector<Verdict> &verdicts)
{
  const auto count = [&](const Outcome outcome)
  {
    return std::count_if(verdicts.begin(), verdicts.end(),
                         [&](const Verdict &verdict) { return verdict.outcome == outcome; });
  };
  const auto n_failed = count(Outcome::fail), n_open = count(Outcome::inconclusive),
             n_held      = count(Outcome::pass);
  const std::string open = n_open == 0 ? "" : ", " + std::to_string(n_open) + " cannot be judged";
  if (n_failed == 0)
    return (n_open == 0 && n_held > 0 ? "PASS: " : "INCONCLUSIVE: ") + std::to_string(n_held) +
           " of " + std::to_string(verdicts.size()) + " claims hold" + open;
  const auto first =
    std::find_if(verdicts.begin(), verdicts.end(),
                 [](const Verdict &verdict) { return verdict.outcome == Outcome::fail; });
  char value[32];
  std::snprintf(value, sizeof(value), "%.3g", first->value);
  return "FAIL (" + name_of(first->kind) + "): " + first->claim + ": " + value + " (" +
         first->limit + "); " + std::to_string(n_failed) + " of " +
         std::to_string(verdicts.size()) + " claims failed" + open;
}
} // namespace homespun::verification
