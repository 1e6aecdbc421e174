// SPDX-License-Identifier: MIT
// Claims of paths on which nothing was reached.
#include "verification/periodic/periodic_verdicts.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::verification;

namespace
{
StabilityRow row_of(const char *kind, const char *mesh, const char *outcome)
{
  StabilityRow row;
  row.kind    = kind;
  row.cell    = "honeycomb";
  row.law     = "biot";
  row.load    = "uniaxial-1";
  row.way     = "pressed";
  row.mesh    = mesh;
  row.outcome = outcome;
  if (row.kind == "level")
    row.strain = -0.1;
  return row;
}
} // namespace

TEST(exact_periodic_verdicts, where_no_level_was_reached_every_claim_is_open)
{
  const std::vector<Verdict> verdicts = verdicts_on_margins(
    {row_of("level", "given", "not-reached"), row_of("level", "refined", "not-reached"),
     row_of("loss", "given", "ended"), row_of("loss", "refined", "ended")});
  EXPECT_EQ(verdicts.size(), 4u); // sides, long waves, levels, meshes
  for (const Verdict &verdict : verdicts)
    EXPECT_EQ(verdict.outcome, Outcome::inconclusive) << verdict.claim;
}

TEST(exact_periodic_verdicts, a_level_that_was_reached_is_judged)
{
  StabilityRow given = row_of("level", "given", "stable-up-to-mesh"), refined = given;
  refined.mesh = "refined";
  for (StabilityRow *row : {&given, &refined})
  {
    row->beta       = 0.5;
    row->lower      = 0.5;
    row->acoustic   = 0.4;
    row->long_waves = "stable";
  }
  const auto verdicts = [&]
  {
    return verdicts_on_margins(
      {given, refined, row_of("loss", "given", "held"), row_of("loss", "refined", "held")});
  };
  for (const Verdict &verdict : verdicts())
    EXPECT_EQ(verdict.outcome, Outcome::pass) << verdict.claim;
  given.long_waves = "unstable"; // where the acoustic tensor says they are not
  refined.outcome  = "unstable-proved";
  int n_failed = 0, n_open = 0;
  for (const Verdict &verdict : verdicts())
  {
    n_failed += verdict.outcome == Outcome::fail;
    n_open += verdict.outcome == Outcome::inconclusive;
  }
  EXPECT_EQ(n_failed, 1);
  EXPECT_EQ(n_open, 1);
}
