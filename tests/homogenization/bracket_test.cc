// SPDX-License-Identifier: MIT
#include "homogenization/bracket.h"
#include "tests/homogenization/bracket_cells.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::homogenization;

TEST(exact_bracket, laminates_close_to_round_off_because_both_spaces_hold_the_exact_fields)
{
  const tests::BracketCell cell = tests::stripes(8, 8, 10.);
  for (const unsigned order : {1u, 2u})
  {
    const Bracket b = tests::bracketed(cell, order);
    std::printf("P%u width %g round_off %g excess %g dofs %u %u\n", order, b.width, b.round_off,
                b.excess, b.n_displacement_dofs, b.n_stress_dofs);
    EXPECT_LT(b.width, 1e-10);
  }
}
