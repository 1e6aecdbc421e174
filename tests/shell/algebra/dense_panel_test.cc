// SPDX-License-Identifier: MIT
#include "shell/algebra/dense_panel.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <vector>

using namespace homespun::shell;

namespace
{
/// A panel with padding behind it, which is not a number: nothing may depend on it.
struct Padded
{
  explicit Padded(const Eigen::MatrixXd &values)
      : numbers(static_cast<std::size_t>(values.size()) + panel_padding,
                std::numeric_limits<double>::quiet_NaN())
      , rows(values.rows())
      , columns(values.cols())
  {
    matrix() = values;
  }
  Eigen::Map<Eigen::MatrixXd> matrix()
  {
    return {numbers.data(), rows, columns};
  }
  std::vector<double> numbers;
  Eigen::Index rows, columns;
};

/// Sizes around whole registers, and beyond those that Eigen takes over.
template <int dim>
std::vector<int> sizes()
{
  std::vector<int> all;
  for (const int n_blocks : {1, 2, 3, 5, 8, 9, 16, 17, 24, 25, 50, 75})
    all.push_back(dim * n_blocks);
  return all;
}

/// (size,width): the leading columns of a positive definite matrix.
Eigen::MatrixXd panel(const int size, const int width)
{
  std::srand(static_cast<unsigned int>(7 * size + width));
  const Eigen::MatrixXd random = Eigen::MatrixXd::Random(size, size);
  return (random * random.transpose() + size * Eigen::MatrixXd::Identity(size, size))
    .leftCols(width);
}
template <int dim>
void check_products()
{
  for (const int size : sizes<dim>())
    for (const int depth : {dim, 4 * dim, 10 * dim})
      for (int offset = 0; offset < size; offset += dim)
      {
        const int n = size - offset;
        Padded a(panel(size, std::min(depth, size)));
        std::vector<double> t(dim * static_cast<std::size_t>(padded(n)));
        multiply<dim>(a.numbers.data() + offset, a.numbers.data(), size,
                      static_cast<int>(a.columns), n, t.data());
        const Eigen::MatrixXd expected =
          a.matrix().bottomRows(n) * a.matrix().topRows(dim).transpose();
        const Eigen::Map<Eigen::MatrixXd> found(t.data(), padded(n), dim);
        EXPECT_LT((found.topRows(n) - expected).cwiseAbs().maxCoeff(),
                  1e-13 * expected.cwiseAbs().maxCoeff())
          << size << " " << depth << " " << offset;
      }
}

template <int dim>
void check_factors()
{
  for (const int size : sizes<dim>())
    for (const int width : sizes<dim>())
    {
      if (width > size)
        continue;
      const Eigen::MatrixXd A = panel(size, width);
      Padded factor(A);
      std::vector<double> product(dim * static_cast<std::size_t>(padded(size)));
      ASSERT_TRUE(factorize_panel<dim>(factor.numbers.data(), width, size, product.data()));
      Eigen::MatrixXd L = factor.matrix();
      L.topRows(width).triangularView<Eigen::StrictlyUpper>().setZero();
      const double scale = A.cwiseAbs().maxCoeff();
      EXPECT_LT((L * L.topRows(width).transpose() - A)
                  .triangularView<Eigen::Lower>()
                  .toDenseMatrix()
                  .cwiseAbs()
                  .maxCoeff(),
                1e-13 * scale)
        << size << " " << width;

      const Eigen::VectorXd x   = Eigen::VectorXd::LinSpaced(size, -1., 2.);
      const Eigen::VectorXd top = x.head(width), below = x.tail(size - width);
      Eigen::VectorXd y = x;
      substitute<dim>(factor.numbers.data(), width, size, y.data());
      EXPECT_LT((L.topRows(width) * y.head(width) - top).norm(), 1e-13 * x.norm() * scale);
      EXPECT_LT((y.tail(size - width) - below + L.bottomRows(size - width) * y.head(width)).norm(),
                1e-13 * x.norm() * scale);
      y = x;
      substitute_back<dim>(factor.numbers.data(), width, size, y.data());
      EXPECT_LT((L.transpose() * y - top).norm(), 1e-13 * x.norm() * scale);
      EXPECT_EQ(y.tail(size - width), below);
    }
}
} // namespace

TEST(exact_dense_panel, a_product_is_that_of_its_rows)
{
  check_products<2>();
  check_products<3>();
}

TEST(exact_dense_panel, factor_and_substitutions_are_those_of_a_dense_matrix)
{
  check_factors<2>();
  check_factors<3>();
}

TEST(exact_dense_panel, a_pivot_that_is_not_positive_is_told)
{
  for (const int place : {0, 1, 2, 5, 11})
    for (const double value : {0., -1., std::numeric_limits<double>::quiet_NaN()})
    {
      Padded matrix(Eigen::MatrixXd::Identity(15, 12));
      matrix.matrix()(place, place) = value;
      std::vector<double> product(3 * static_cast<std::size_t>(padded(15)));
      Padded other = matrix;
      EXPECT_FALSE(factorize_panel<3>(matrix.numbers.data(), 12, 15, product.data())) << place;
      EXPECT_FALSE(factorize_panel<2>(other.numbers.data(), 12, 15, product.data())) << place;
    }
}
