// SPDX-License-Identifier: MIT
#include "homogenization/algebra/cholesky_factor.h"
#include "homogenization/algebra/elimination_order.h"

#include "meshes/plain/errors.h"

#include <gtest/gtest.h>

#include <algorithm>
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
  CholeskyFactor in_its_room(five_points(n, 0.5), "in its room");
  in_its_room.factorize(one);
  EXPECT_EQ((in_its_room.solve(loads) - first).norm(), 0.);
  EXPECT_THROW(in_its_room.factorize(-1. * one), meshes::NotConverged);
  in_its_room.factorize(one);
  EXPECT_EQ((in_its_room.solve(loads) - first).norm(), 0.);
  in_its_room.factorize(five_points(n / 2, 0.));
  EXPECT_EQ(in_its_room.solve(loads.topRows(n * n / 4)).rows(), n * n / 4);
  const Eigen::SparseMatrix<double> full =
    Eigen::SparseMatrix<double>(five_points(n, 0.5).selfadjointView<Eigen::Lower>());
  EXPECT_LT((full * of_other - loads).norm(), 1e-12 * loads.norm()); // condition below 1e4
}

TEST(exact_elimination_order, every_unknown_comes_once_and_those_of_a_node_together)
{
  const int n = 30, n_nodes = n * n, per_node = 3;
  const Eigen::SparseMatrix<double> points = five_points(n, 0.);
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < n_nodes; ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(points, column); entry; ++entry)
      for (int i = 0; i < per_node; ++i)
        for (int j = 0; j < per_node; ++j)
          if (const int row = per_node * static_cast<int>(entry.row()) + i;
              row >= per_node * column + j)
            entries.emplace_back(row, per_node * column + j, 1.);
  Eigen::SparseMatrix<double> matrix(per_node * n_nodes, per_node * n_nodes);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const std::vector<int> order = elimination_order(matrix);
  std::vector<int> sorted      = order;
  std::sort(sorted.begin(), sorted.end());
  for (int k = 0; k < per_node * n_nodes; ++k)
    ASSERT_EQ(sorted[static_cast<std::size_t>(k)], k);
  for (std::size_t k = 0; k < order.size(); ++k)
    EXPECT_EQ(order[k], order[k - k % per_node] + static_cast<int>(k % per_node));
}

TEST(exact_cholesky_factor, a_large_matrix_whose_nodes_are_ordered_is_solved)
{
  const int n                 = 150; // above the size from which on they are
  const auto matrix           = five_points(n, 0.);
  const Eigen::MatrixXd loads = Eigen::MatrixXd::Random(n * n, 3);
  const Eigen::MatrixXd x     = CholeskyFactor(matrix, "large").solve(loads);
  const Eigen::MatrixXd again = CholeskyFactor(matrix, "large").solve(loads);
  const Eigen::SparseMatrix<double> full =
    Eigen::SparseMatrix<double>(matrix.selfadjointView<Eigen::Lower>());
  EXPECT_LT((full * x - loads).norm(), 1e-12 * loads.norm());
  EXPECT_EQ((again - x).norm(), 0.); // of the remembered order
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
