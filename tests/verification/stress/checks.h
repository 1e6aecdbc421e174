// SPDX-License-Identifier: MIT
// Cases that test the program and no limit of a cell or a cloth, each a step of a test.
#pragma once

#include "tests/refusal.h"
#include "verification/stress/stress_case.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace homespun::tests
{
/// Two repetitions end finite and within a limit.
inline void expect_within(const std::string &name, const double limit,
                          const verification::StressCase::Run &run,
                          const verification::Repeats repeats = verification::Repeats::same_bits)
{
  const verification::StressRow row = verification::run_case(
    {"program", name, "finite", {limit, "", "a limit of this test"}, repeats, run}, 2);
  EXPECT_EQ(row.verdict, verification::Outcome::pass)
    << name << ": " << row.outcome << ", " << row.figure << " (" << limit << ")";
}

/// The message of a refusal names the fault.
template <typename Action>
void expect_refused(const std::string &name, const std::string &names, const Action &action)
{
  const std::string message = refusal(action);
  EXPECT_NE(message.find(names), std::string::npos) << name << ": " << message;
}

inline void expect_all_pass(const std::vector<verification::StressCase> &cases)
{
  EXPECT_FALSE(cases.empty());
  for (const verification::StressCase &one : cases)
  {
    const verification::StressRow row = verification::run_case(one, 2);
    EXPECT_EQ(row.verdict, verification::Outcome::pass)
      << row.group << ": " << row.name << ": " << row.outcome << ", " << row.figure << ", "
      << row.limit;
  }
}
} // namespace homespun::tests
