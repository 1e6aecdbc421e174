// SPDX-License-Identifier: MIT
#include "homogenization/algebra/cholesky_factor.h"

#include "meshes/plain/errors.h"

#include <gtest/gtest.h>

#include <vector>

namespace homespun::homogenization
{
namespace
{
/// The lower triangle of five-point differences on n x n points with a coefficient for each row.
Eigen::SparseMatrix<double> five_points(const int n, const double growth)
{
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
    {
      const double weight = 1. + growth * j;
      entries.emplace_back(n * j + i, n * j + i, 4. * weight + growth);
      if (i > 0)
        entries.emplace_back(n * j + i, n * j + i - 1, -weight);
      if (j > 0)
        entries.emplace_back(n * j + i, n * (j - 1) + i, -0.5 * (2. * weight - growth));
    }
  Eigen::SparseMatrix<double> matrix(n * n, n * n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}
} // namespace

TEST(exact_cholesky_factor, a_remembered_order_gives_the_same_factor_of_other_values_too)
{
  const int n                         = 40;
  const Eigen::MatrixXd loads         = Eigen::MatrixXd::Random(n * n, 3);
  const auto one                      = five_points(n, 0.);
  const Eigen::MatrixXd first         = CholeskyFactor(one, "one").solve(loads);
  const Eigen::MatrixXd of_other      = CholeskyFactor(five_points(n, 0.5), "other").solve(loads);
  const Eigen::MatrixXd of_remembered = CholeskyFactor(one, "one").solve(loads);
  EXPECT_EQ((of_remembered - first).norm(), 0.);
  const Eigen::SparseMatrix<double> full =
    Eigen::SparseMatrix<double>(five_points(n, 0.5).selfadjointView<Eigen::Lower>());
  EXPECT_LT((full * of_other - loads).norm(), 1e-12 * loads.norm()); // condition below 1e4
}

TEST(tripwire_cholesky_factor, singular_and_indefinite_matrices_are_refused_by_name)
{
  for (const double entry : {0., -4.})
  {
    Eigen::SparseMatrix<double> bad = five_points(4, 0.);
    bad.coeffRef(5, 5)              = entry;
    EXPECT_THROW(CholeskyFactor(bad, "bad"), meshes::NotConverged);
  }
  Eigen::SparseMatrix<double> indefinite(2, 2);
  const std::vector<Eigen::Triplet<double>> entries = {{0, 0, 1.}, {1, 0, 2.}, {1, 1, 1.}};
  indefinite.setFromTriplets(entries.begin(), entries.end());
  EXPECT_THROW(CholeskyFactor(indefinite, "indefinite"), meshes::NotConverged);
}
} // namespace homespun::homogenization
