// SPDX-License-Identifier: MIT
#include "verification/strain/claims/second_order_checks.h"

#include "homogenization/fem/homogenize.h"
#include "tests/homogenization/cell/cells.h"

#include <gtest/gtest.h>

#include <utility>

using namespace homespun;
using namespace homespun::verification;

namespace
{
/// On a lattice that is neither square nor rectangular, so that all ten numbers differ.
homogenization::UnitCell askew()
{
  return tests::cell_of(tests::skewed_lattice(), 8, 8, tests::soft_and_hard(),
                        tests::square_inclusion);
}

meshes::HomogenizedCell with_second_order(const homogenization::UnitCell &cell)
{
  homogenization::HomogenizationOptions options;
  options.order        = 1;
  options.second_order = {meshes::Law::biot, meshes::Law::green};
  return homogenization::homogenized_cell(
    cell, homogenization::homogenize(cell, options, MPI_COMM_SELF), "");
}

Outcome outcome_of(const std::vector<Verdict> &checks, const std::string &id,
                   const std::string &law)
{
  for (const Verdict &check : checks)
    if (check.id == id && check.claim.find(", " + law + ":") != std::string::npos)
      return check.outcome;
  ADD_FAILURE() << "no claim " << id << " under " << law;
  return Outcome::inconclusive;
}
} // namespace

TEST(exact_second_order_checks, a_cell_does_what_it_does_at_finite_strain)
{
  const homogenization::UnitCell cell = askew();
  const std::vector<Verdict> checks   = second_order_checks(cell, with_second_order(cell));
  ASSERT_EQ(checks.size(), 4u);
  for (const Verdict &check : checks)
  {
    EXPECT_EQ(check.outcome, Outcome::pass) << check.claim << check.value;
    EXPECT_TRUE(check.id != "second-order" || check.value < 1e-7) << check.value;
  }
}

// Two numbers exchanged that strains of one component do not tell apart, the displacement under two
// strains counted twice: each under the law that it belongs to.
TEST(exact_second_order_checks, what_is_wrong_in_any_number_is_noticed)
{
  const homogenization::UnitCell cell = askew();
  meshes::HomogenizedCell wrong       = with_second_order(cell);
  auto &numbers                       = wrong.second_order.at("biot").energy.derivatives;
  ASSERT_GT(std::abs(numbers(1) - numbers(3)), 1e-3 * numbers.norm());
  std::swap(numbers(1), numbers(3)); // 112 and 122
  wrong.second_order.at("green").chi.middleCols<2>(4) *= 2.;
  const std::vector<Verdict> checks = second_order_checks(cell, wrong);
  EXPECT_EQ(outcome_of(checks, "second-order", "biot"), Outcome::fail);
  EXPECT_EQ(outcome_of(checks, "second-order", "green"), Outcome::fail);
}
