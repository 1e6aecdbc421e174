// SPDX-License-Identifier: MIT
#include "homogenization/lint/cell_reading.h"
#include "verification/strain/law_verdicts.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::verification;

TEST(derivative_law_verdicts, every_law_passes_for_stripes_and_for_a_weave)
{
  for (const char *name : {"three-stiffness", "plain-weave"})
  {
    const homogenization::UnitCell cell =
      homogenization::read_unit_cell(std::string(CELLS) + name + ".prm");
    const std::vector<Verdict> all = law_verdicts(cell, all_laws(), 0.2);
    ASSERT_EQ(all.size(), all_laws().size());
    for (const Verdict &verdict : all)
    {
      EXPECT_EQ(verdict.outcome, Outcome::pass) << verdict.claim << " " << verdict.value;
      EXPECT_LT(verdict.value, 1e-8) << verdict.claim; // a hundredth of the limit
    }
  }
}
