// SPDX-License-Identifier: MIT
#include "homogenization/lint/cell_reading.h"
#include "verification/strain/claims/self_checks.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::verification;

TEST(derivative_self_checks,
     laws_axes_and_interpolation_pass_for_stripes_a_weave_and_a_slanted_cell)
{
  for (const char *name : {"three-stiffness", "plain-weave", "hexagonal-dots"})
  {
    const homogenization::UnitCell cell =
      homogenization::read_unit_cell(std::string(CELLS) + name + ".prm");
    const std::vector<Verdict> all = self_checks(cell, all_laws(), 0.2);
    ASSERT_EQ(all.size(), all_laws().size() + 2);
    for (const Verdict &verdict : all)
    {
      EXPECT_EQ(verdict.outcome, Outcome::pass) << verdict.claim << " " << verdict.value;
      EXPECT_LT(verdict.value, 1e-8) << verdict.claim; // a hundredth of the limit
    }
  }
}
