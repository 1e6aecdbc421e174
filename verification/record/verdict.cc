// SPDX-License-Identifier: MIT
#include "verification/record/verdict.h"

#include <algorithm>
#include <array>

namespace homespun::verification
{
std::string name_of(const Outcome outcome)
{
  return outcome == Outcome::pass ? "PASS" : outcome == Outcome::fail ? "FAIL" : "INCONCLUSIVE";
}

std::string name_of(const Kind kind)
{
  return kind == Kind::program ? "program" : kind == Kind::input ? "input" : "method";
}

bool any(const std::vector<Verdict> &verdicts, const Outcome outcome)
{
  return std::any_of(verdicts.begin(), verdicts.end(),
                     [&](const Verdict &verdict) { return verdict.outcome == outcome; });
}

bool any_failed(const std::vector<Verdict> &verdicts)
{
  return any(verdicts, Outcome::fail);
}

int worse(const int one, const int other)
{
  constexpr std::array<int, 5> worst_first = {exit_status::bad_input, exit_status::not_converged,
                                              exit_status::claim_failed, exit_status::claim_open,
                                              exit_status::good};
  return *std::find_if(worst_first.begin(), worst_first.end(),
                       [&](const int status) { return status == one || status == other; });
}

int status_of(const std::vector<Verdict> &verdicts)
{
  return any_failed(verdicts)                   ? exit_status::claim_failed
         : any(verdicts, Outcome::inconclusive) ? exit_status::claim_open
                                                : exit_status::good;
}
} // namespace homespun::verification
