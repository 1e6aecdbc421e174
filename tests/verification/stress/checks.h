// SPDX-License-Identifier: MIT
// Cases that test the program and no limit of a cell or a cloth, each a step of a test.
#pragma once

#include "tests/refusal.h"
#include "verification/stress/stress_axis.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace homespun::tests
{
enum class Repeats
{
  same_bits, ///< the same again gives the same numbers to the last bit
  with_seeds ///< seeds differ, and so may the numbers
};

/// Two repetitions end finite and within a limit.
inline void expect_within(const std::string &name, const double limit,
                          const std::function<verification::StressAnswer(unsigned int seed)> &run,
                          const Repeats repeats = Repeats::same_bits)
{
  Eigen::MatrixXd first;
  for (const unsigned int seed : {0u, 1u})
  {
    const verification::StressAnswer answer = run(seed);
    EXPECT_TRUE(answer.values.allFinite()) << name;
    EXPECT_LE(answer.error, limit) << name;
    if (seed == 0)
      first = answer.values;
    else if (repeats == Repeats::same_bits)
    {
      EXPECT_TRUE(answer.values == first) << name << ": the same again gave other numbers";
    }
  }
}

/// The message of a refusal names the fault.
template <typename Action>
void expect_refused(const std::string &name, const std::string &names, const Action &action)
{
  const std::string message = refusal(action);
  EXPECT_NE(message.find(names), std::string::npos) << name << ": " << message;
}

/// No axis ends before theory allows. @return where each ended
inline std::vector<verification::LimitRow>
expect_no_promise_broken(const std::vector<verification::StressAxis> &axes)
{
  EXPECT_FALSE(axes.empty());
  std::vector<verification::LimitRow> rows;
  for (const verification::StressAxis &axis : axes)
  {
    rows.push_back(verification::climb(axis, 0., 10., [](const verification::StressRow &) {}));
    if (const auto verdict =
          verification::verdict_of(axis, rows.back(), verification::owed_value(axis, nullptr)))
    {
      EXPECT_EQ(verdict->outcome, verification::Outcome::pass)
        << verdict->claim << ": " << rows.back().why;
    }
  }
  return rows;
}
} // namespace homespun::tests
