// SPDX-License-Identifier: MIT
#include "verification/verify/verify_study.h"

#include <gtest/gtest.h>

using namespace homespun::verification;

namespace
{
const Verdict holds  = {"holds", Outcome::pass, 0.5, "< 1"};
const Verdict open   = {"cannot be judged", Outcome::inconclusive, 0., "2 +- 0.1"};
const Verdict fails  = {"strain: the parts add up", Outcome::fail, 1.5, "0.8 to 1.25"};
const Verdict fails2 = {"another", Outcome::fail, 2., "< 1"};
} // namespace

TEST(exact_verify, the_first_line_counts_what_holds_and_what_is_open)
{
  EXPECT_EQ(outcome_line({holds, open, holds}),
            "INCONCLUSIVE: 2 of 3 claims hold, 1 cannot be judged");
  EXPECT_EQ(outcome_line({holds}), "PASS: 1 of 1 claims hold");
}

TEST(tripwire_verify, without_a_claim_that_holds_nothing_passes)
{
  EXPECT_EQ(outcome_line({open, open}), "INCONCLUSIVE: 0 of 2 claims hold, 2 cannot be judged");
  EXPECT_EQ(outcome_line({}), "INCONCLUSIVE: 0 of 0 claims hold");
}

TEST(tripwire_verify, one_claim_that_failed_is_on_the_first_line_with_its_figure_and_limit)
{
  EXPECT_EQ(outcome_line({holds, fails, open, fails2}),
            "FAIL (program): strain: the parts add up: 1.5 (0.8 to 1.25); 2 of 4 claims failed, 1 "
            "cannot be "
            "judged");
}
