// SPDX-License-Identifier: MIT
// What a convergence study leaves on the disk is what it takes up; and its sizes can decide what it
// claims.
#include "tests/homogenization/cell/cells.h"
#include "verification/converge/converge_cases.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

using namespace homespun;
using namespace homespun::verification;

namespace
{
class InFolder : public testing::Test
{
protected:
  void SetUp() override
  {
    folder = testing::TempDir() + "homespun-converge-XXXXXX";
    ASSERT_NE(mkdtemp(folder.data()), nullptr);
  }
  void TearDown() override
  {
    std::filesystem::remove_all(folder);
  }

  std::string folder;
};

using exact_converge_record    = InFolder;
using tripwire_converge_record = InFolder;
} // namespace

TEST_F(tripwire_converge_record, a_case_that_did_not_converge_fails_and_runs_again)
{
  const ConvergenceCase one = {"cell", "mesh", "uniform", {}};
  Series series;
  series.quantity = "C11";
  series.h_unit   = "side";
  ConvergenceResult result;
  for (int level = 0; level < 4; ++level)
    if (!result.solves(
          [&]()
          {
            if (level == 2)
              throw meshes::NotConverged("stalled on level 2", {});
            series.levels.push_back({std::pow(0.5, level), 1, 1., std::nullopt, 0.});
          }))
      break;
  EXPECT_EQ(series.levels.size(), 2u); // those that were solved are kept
  EXPECT_EQ(result.unfinished, "stalled on level 2");
  result.add(series);
  result.verdicts.push_back(
    {"all levels are solved", Outcome::fail, 0., result.unfinished, "solvers"});
  {
    ConvergenceRecord record(folder);
    record.add(one, result, 1.);
    EXPECT_FALSE(record.is_complete(one));
    EXPECT_TRUE(any_failed(record.verdicts()));
  }
  {
    ConvergenceRecord again(folder);
    EXPECT_FALSE(again.is_complete(one));
    // Else the claim of the first run would outlive its mending.
    EXPECT_TRUE(again.verdicts().empty());
    EXPECT_TRUE(again.levels().empty());
    result.unfinished.clear();
    result.verdicts[0].outcome = Outcome::pass;
    again.add(one, result, 1.);
  }
  EXPECT_TRUE(ConvergenceRecord(folder).is_complete(one));
  EXPECT_FALSE(any_failed(ConvergenceRecord(folder).verdicts()));
}

TEST_F(exact_converge_record, claims_and_levels_are_taken_up_as_they_were)
{
  const ConvergenceCase one = {"cell", "scale", "strip-1", {}};
  const double third        = 1. / 3.;
  Series series;
  series.quantity = "affine: mean error [cell sides], of all vertices";
  series.h_unit   = "cell sides";
  std::vector<double> h, errors;
  for (int k = 0; k < 5; ++k)
  {
    h.push_back(std::pow(0.5, k) * third);
    errors.push_back(0.1 * h.back());
    series.levels.push_back({h.back(), 7, std::nullopt, errors.back(), 0.1});
  }
  series.judgement = judge_errors(h, errors, about(1.));
  ConvergenceResult result;
  result.add(series, "sheet-order.localized");
  result.verdicts.push_back({"nothing, of \"affine\", is measured", Outcome::inconclusive,
                             std::nan(""), "<= 1, at most", "why", Kind::input});
  ConvergenceRecord(folder).add(one, result, 0.25);

  const ConvergenceRecord again(folder);
  ASSERT_TRUE(again.is_complete(one));
  ASSERT_EQ(again.levels().size(), 5u);
  for (std::size_t k = 0; k < 5; ++k)
  {
    const ConvergeRow row = again.levels()[k];
    EXPECT_EQ(row.level, k);
    EXPECT_EQ(row.h, h[k]); // to the last bit
    EXPECT_EQ(row.error, errors[k]);
    EXPECT_TRUE(std::isnan(row.value));
    EXPECT_EQ(row.order, series.judgement->order);
    EXPECT_EQ(row.quantity, series.quantity);
    EXPECT_EQ(row.judgement, Outcome::pass);
  }
  const std::vector<Verdict> verdicts = again.verdicts();
  ASSERT_EQ(verdicts.size(), 2u);
  EXPECT_EQ(verdicts[0].claim, "cell, scale, strip-1: localized converges at least as fast: order "
                               "1 to 2 in sheet sides (order)");
  EXPECT_EQ(verdicts[0].id, "sheet-order.localized");
  EXPECT_EQ(verdicts[0].of.at("case"), "strip-1");
  EXPECT_EQ(verdicts[0].value, series.judgement->order);
  EXPECT_EQ(verdicts[0].derivation, result.verdicts[0].derivation);
  EXPECT_EQ(verdicts[0].kind, Kind::method);
  EXPECT_EQ(verdicts[1].claim, "cell, scale, strip-1: nothing, of \"affine\", is measured");
  EXPECT_EQ(verdicts[1].outcome, Outcome::inconclusive);
  EXPECT_EQ(verdicts[1].kind, Kind::input);
  EXPECT_EQ(verdicts[1].limit, "<= 1, at most");
  EXPECT_TRUE(std::isnan(verdicts[1].value));
  EXPECT_EQ(status_of(verdicts), exit_status::claim_open);
}

TEST(exact_convergence_sizes, every_ladder_has_the_levels_that_its_order_needs)
{
  for (const bool quick : {false, true})
  {
    const ConvergenceSizes sizes = convergence_sizes(quick);
    for (const std::size_t n :
         {sizes.refinements_p1.size(), sizes.refinements_p2.size(), sizes.cells_per_sheet.size(),
          sizes.coarse_per_cell.size() - 1, // a change has one level fewer
          sizes.strains.size(), sizes.time_steps.size()})
      EXPECT_GE(n, fewest_levels) << (quick ? "quick" : "full");
  }
}

TEST(exact_adaptive_cases, what_so_few_dofs_cannot_decide_is_open_and_not_silent)
{
  const homogenization::UnitCell cell =
    tests::cell_of(tests::square_lattice(0.01), 4, 4,
                   {homogenization::isotropic("soft", 1e6, 0.3, 5e-4, 400.),
                    homogenization::isotropic("hard", 1e7, 0.3, 5e-4, 400.)},
                   [](const double f1, const double f2) { return (f1 < 0.5) == (f2 < 0.5); });
  ConvergenceSizes sizes         = convergence_sizes(true);
  sizes.adaptive_dofs            = 100;
  const ConvergenceResult result = adaptive_cases(cell, sizes, MPI_COMM_SELF).front().run();
  ASSERT_EQ(result.verdicts.size(), 2u); // P1 and P2
  for (const Verdict &verdict : result.verdicts)
    EXPECT_EQ(verdict.outcome, Outcome::inconclusive) << verdict.claim;
}
