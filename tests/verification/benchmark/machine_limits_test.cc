// SPDX-License-Identifier: MIT
#include "verification/benchmark/machine_limits.h"

#include "verification/benchmark/benchmark_study.h"
#include "verification/record/blas.h"

#include <Eigen/Core>

#include <gtest/gtest.h>

namespace homespun::verification
{
namespace
{
TEST(exact_machine_limits, work_is_what_moves_and_what_is_computed)
{
  EXPECT_EQ(copy_limit(1000, 1).work, 2000.);   // read and written
  EXPECT_EQ(triad_limit(1000, 1).work, 24000.); // two numbers read, one written
  EXPECT_EQ(product_limit(50, 1).work, 250000.);
  EXPECT_EQ(product_limit(50, 3).seconds.size(), 3u);
}

TEST(exact_machine_limits, the_product_is_that_of_the_matrices)
{
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(17, 17), b = Eigen::MatrixXd::Random(17, 17);
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(17, 17);
  ASSERT_TRUE(multiply_by_blas(17, a.data(), b.data(), c.data()));
  EXPECT_LE((c - a * b).norm(), 1e-14 * 17.);
}

TEST(exact_benchmark_table, a_row_says_rate_and_share_of_its_limit)
{
  BenchmarkRow row;
  row.part          = "step: factor";
  row.seconds       = 2e-4;
  row.mean          = 3e-4;
  row.percentile_95 = 4e-4;
  row.work          = 4e6;
  row.unit          = "flop";
  row.limit         = "dgemm";
  row.of_limit      = 0.5;
  EXPECT_DOUBLE_EQ(row.rate(), 2e10);
  const std::string text = table_of({row});
  for (const char *word :
       {"step: factor", "200 us", "300 us", "400 us", "20 Gflop", "0.5", "dgemm"})
    EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
}
} // namespace
} // namespace homespun::verification
