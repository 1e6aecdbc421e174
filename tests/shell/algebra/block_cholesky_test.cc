// SPDX-License-Identifier: MIT
// The factorisation of a block matrix against the product with it, on meshes whose panels are
// narrow and wide, and what it refuses.
#include "shell/algebra/block_cholesky.h"
#include "tests/meshes/plain/shapes.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

using namespace homespun;
using namespace homespun::shell;

namespace
{
/// A random positive definite matrix over a sheet of n x n x 2 triangles, whose lower edge is held.
BlockMatrix random_matrix(const int n)
{
  const meshes::TriangleMesh mesh =
    meshes::coarse_sheet({0., 0.}, Eigen::Matrix2d::Identity(), n, n);
  std::vector<std::array<int, 2>> pairs;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      pairs.push_back({mesh.triangles(t, k), mesh.triangles(t, (k + 1) % 3)});
  std::vector<bool> is_held(static_cast<std::size_t>(mesh.n_vertices()), false);
  std::fill_n(is_held.begin(), n + 1, true);
  BlockMatrix matrix(pairs, is_held);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> random(-1., 1.);
  // Σ (B_i x_i + B_j x_j)² + 0.01 |x|²
  for (const auto &pair : pairs)
  {
    const Eigen::Matrix3d first = Eigen::Matrix3d::NullaryExpr([&] { return random(generator); }),
                          other = Eigen::Matrix3d::NullaryExpr([&] { return random(generator); });
    matrix.add(matrix.slot(pair[0], pair[0]), first.transpose() * first);
    matrix.add(matrix.slot(pair[1], pair[1]), other.transpose() * other);
    matrix.add(matrix.slot(pair[0], pair[1]), first.transpose() * other);
  }
  for (int v = 0; v < mesh.n_vertices(); ++v)
    matrix.add_multiple(matrix.slot(v, v), 0.01);
  return matrix;
}
} // namespace

TEST(exact_block_cholesky, a_solution_times_the_matrix_is_the_right_side)
{
  for (const int n : {1, 2, 5, 20, 60})
  {
    const BlockMatrix matrix = random_matrix(n);
    BlockCholesky cholesky(matrix);
    for (int repeat = 0; repeat < 2; ++repeat)
    {
      ASSERT_TRUE(cholesky.factorize(matrix)) << n;
      Vectors x = Vectors::Random(matrix.n_vertices(), 3), right_side, solution;
      for (int v = 0; v < matrix.n_vertices(); ++v)
        if (!matrix.is_free(v))
          x.row(v).setZero();
      matrix.multiply(x, right_side);
      cholesky.solve(right_side, solution);
      EXPECT_LE((solution - x).norm(), 1e-11 * x.norm()) << n;
    }
  }
}

// The textbook's elimination, number by number, which counts what it does.
TEST(exact_block_cholesky, operations_are_counted_as_an_elimination_by_numbers_does_them)
{
  for (const int n : {1, 3, 8})
  {
    const BlockMatrix matrix = random_matrix(n);
    const int n_unknowns     = 3 * matrix.n_free();
    Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> is_filled =
      Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>::Zero(n_unknowns, n_unknowns);
    for (int c = 0; c < matrix.n_free(); ++c)
      for (int k = matrix.first[static_cast<std::size_t>(c)];
           k < matrix.first[static_cast<std::size_t>(c) + 1]; ++k)
        if (const int r = matrix.row[static_cast<std::size_t>(k)]; r < matrix.n_free())
          is_filled.block<3, 3>(3 * r, 3 * c).setConstant(true);
    double operations = 0.;
    for (int c = 0; c < n_unknowns; ++c)
    {
      operations += 1.; // the root
      for (int r = c + 1; r < n_unknowns; ++r)
        if (is_filled(r, c))
        {
          operations += 1.; // the division
          for (int s = c + 1; s <= r; ++s)
            if (is_filled(s, c))
            {
              operations += 1.;
              is_filled(r, s) = true;
            }
        }
    }
    EXPECT_EQ(BlockCholesky(matrix).n_multiply_adds(), operations) << n;
  }
}

TEST(tripwire_block_cholesky, a_matrix_that_is_not_positive_definite_is_refused_wherever_it_fails)
{
  BlockMatrix matrix = random_matrix(20);
  BlockCholesky cholesky(matrix);
  for (int v = 21; v < matrix.n_vertices(); v += 7)
    for (const double wrong : {-1e3, std::numeric_limits<double>::quiet_NaN()})
    {
      BlockMatrix::Block &block = matrix.blocks[static_cast<std::size_t>(matrix.slot(v, v).block)];
      const BlockMatrix::Block kept = block;
      block(v % 3, v % 3) += wrong;
      EXPECT_FALSE(cholesky.factorize(matrix)) << v << ' ' << wrong;
      block = kept;
    }
  EXPECT_TRUE(cholesky.factorize(matrix));
}
