// SPDX-License-Identifier: MIT
// The judgement of scaling on made-up runs, where the truth is known.
#include "verification/scaling/scaling_study.h"
#include "verification/scaling/scaling_summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace homespun::verification;

namespace
{
/// Memory 2e8 + 1000 n/p, time n (1e-6 + 3e-5/p).
std::vector<ScalingRun> runs()
{
  std::vector<ScalingRun> all;
  for (const int refine : {3, 4, 5})
    for (const int ranks : {1, 2, 4})
      for (int repeat = 0; repeat < 3; ++repeat)
      {
        ScalingRun run;
        run.refine       = refine;
        run.ranks        = ranks;
        run.repeat       = repeat;
        run.dofs         = 1e4 * (1 << (2 * refine));
        run.iterations   = 20. + refine;
        run.solve        = run.dofs * (1e-6 + 3e-5 / ranks);
        run.largest_rank = 2e8 + 1000. * run.dofs / ranks;
        run.all_ranks    = ranks * run.largest_rank;
        run.C11 = 1000., run.C12 = 300., run.C22 = 900., run.C33 = 200.;
        all.push_back(run);
      }
  return all;
}
} // namespace

TEST(exact_scaling, the_model_of_runs_that_follow_it_is_found_with_its_misfit)
{
  const TwoTerms memory = memory_model_of(runs()).value(), time = time_model_of(runs(), 4).value();
  EXPECT_NEAR(memory.fixed, 2e8, 1e-3 * 2e8);
  EXPECT_NEAR(memory.shared, 1000., 1e-6 * 1000.);
  EXPECT_NEAR(time.fixed, 1e-6, 1e-10);
  EXPECT_NEAR(time.shared, 3e-5, 1e-9);
  EXPECT_LT(memory.misfit, 1e-9);
  EXPECT_LT(time.misfit, 1e-9);
  // One point off by a tenth shows in the misfit, and one slow repeat of three in nothing.
  std::vector<ScalingRun> off = runs();
  for (int repeat = 0; repeat < 3; ++repeat)
    off[static_cast<std::size_t>(repeat)].largest_rank *= 1.1;
  off[3].solve *= 10.;
  EXPECT_GT(memory_model_of(off)->misfit, 0.02);
  EXPECT_LT(time_model_of(off, 4)->misfit, 1e-9);
  // Four ranks on two cores take as long as two.
  for (ScalingRun &run : off)
    run.solve = run.dofs * (1e-6 + 3e-5 / std::min(run.ranks, 2));
  EXPECT_LT(time_model_of(off, 2)->misfit, 1e-9);
  EXPECT_GT(time_model_of(off, 4)->misfit, 0.1);
}

TEST(exact_scaling, what_the_runs_do_not_determine_is_not_told)
{
  const auto those = [](const auto &is_kept)
  {
    std::vector<ScalingRun> all = runs();
    all.erase(
      std::remove_if(all.begin(), all.end(), [&](const ScalingRun &run) { return !is_kept(run); }),
      all.end());
    return all;
  };
  const auto one_rank = those([](const ScalingRun &run) { return run.ranks == 1; });
  EXPECT_TRUE(memory_model_of(one_rank));
  EXPECT_FALSE(time_model_of(one_rank, 4)) << "what is serial and what is not look alike";
  EXPECT_FALSE(time_model_of(runs(), 1));
  const auto two = those([](const ScalingRun &run) { return run.refine == 3 && run.ranks < 4; });
  EXPECT_FALSE(memory_model_of(two)) << "no misfit to see";
  EXPECT_FALSE(time_model_of(two, 4));
  // Claims on what is not there to compare cannot fail, and are not made.
  EXPECT_TRUE(verdicts_of(one_rank).empty());
  EXPECT_TRUE(
    verdicts_of(those([](const ScalingRun &run) { return run.refine == 3 && run.ranks == 1; }))
      .empty());
  std::vector<ScalingRun> homogeneous = runs();
  for (ScalingRun &run : homogeneous)
    run.iterations = 0.;
  EXPECT_TRUE(notes_of(homogeneous).empty());
  ASSERT_EQ(notes_of(runs()).size(), 1u);
  EXPECT_NE(notes_of(runs())[0].find("between 23 and 25"), std::string::npos)
    << notes_of(runs())[0];
}

TEST(tripwire_scaling, each_claim_fails_where_it_does_not_hold)
{
  for (const Verdict &verdict : verdicts_of(runs()))
  {
    EXPECT_EQ(verdict.outcome, Outcome::pass) << verdict.claim;
    EXPECT_FALSE(verdict.derivation.empty()) << verdict.claim;
  }
  const auto fails = [](const std::vector<ScalingRun> &all, const std::size_t claim)
  { return verdicts_of(all).at(claim).outcome == Outcome::fail; };
  std::vector<ScalingRun> other = runs();
  other[4].C13                  = 1e-6; // one part in 1e9 of the largest entry
  EXPECT_TRUE(fails(other, 0));
  other        = runs();
  other[4].C13 = std::nan("");
  EXPECT_TRUE(fails(other, 0));
  other = runs();
  for (ScalingRun &run : other)
    run.largest_rank = 2e8 + 1000. * run.dofs; // nothing is distributed
  EXPECT_FALSE(fails(other, 0));
  for (ScalingRun &run : other)
    run.largest_rank *= 1. + 0.01 * run.ranks;
  EXPECT_TRUE(fails(other, 1));
  for (ScalingRun &run : other)
    run.largest_rank = std::nan("");
  EXPECT_TRUE(fails(other, 1));
}

TEST(exact_scaling, the_table_shows_medians_and_speed_up)
{
  std::vector<ScalingRun> some = runs();
  const std::string table      = table_of(some);
  EXPECT_NE(table.find("640000"), std::string::npos);
  EXPECT_NE(table.find("1.94"), std::string::npos) << "3.1e-5 over 1.6e-5\n" << table;
}
