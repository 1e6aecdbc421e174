// SPDX-License-Identifier: MIT
#include "verification/record/verdict.h"

#include <algorithm>

namespace homespun::verification
{
namespace
{
constexpr int worst_first[] = {exit_status::program_fault, exit_status::bad_input,
                               exit_status::not_converged, exit_status::claim_failed,
                               exit_status::claim_open,    exit_status::good};

constexpr int worse_of(const int one, const int other)
{
  for (const int status : worst_first)
    if (status == one || status == other)
      return status;
  return one;
}

// A script that asks only for the status must not take a failed claim for an open one, or an open
// one for a good one.
static_assert(worse_of(exit_status::good, exit_status::claim_open) == exit_status::claim_open);
static_assert(worse_of(exit_status::claim_open, exit_status::claim_failed) ==
              exit_status::claim_failed);
static_assert(worse_of(exit_status::claim_failed, exit_status::not_converged) ==
              exit_status::not_converged);
static_assert(worse_of(exit_status::not_converged, exit_status::bad_input) ==
              exit_status::bad_input);
} // namespace

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
  return worse_of(one, other);
}

int status_of(const std::vector<Verdict> &verdicts)
{
  return any_failed(verdicts)                   ? exit_status::claim_failed
         : any(verdicts, Outcome::inconclusive) ? exit_status::claim_open
                                                : exit_status::good;
}
} // namespace homespun::verification
