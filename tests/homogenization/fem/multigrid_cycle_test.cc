// SPDX-License-Identifier: MIT
#include "homogenization/fem/multigrid_cycle.h"

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_MultiVector.h>
#include <Epetra_Vector.h>
#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

namespace homespun::homogenization
{
namespace
{
/// Five-point differences on n x n points between walls, the right half of which is a thousand
/// times as stiff.
class TwoMedia
{
public:
  explicit TwoMedia(const int n)
      : communicator(MPI_COMM_SELF)
      , map(n * n, 0, communicator)
      , matrix(Copy, map, 5)
  {
    const auto weight = [n](const int i) { return 2 * i < n ? 1. : 1000.; };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
      {
        const double left = weight(i - 1), right = weight(i), along = 0.5 * (left + right);
        add(i * n + j, i * n + j, left + right + 2. * along);
        if (i > 0)
          add(i * n + j, (i - 1) * n + j, -left);
        if (i + 1 < n)
          add(i * n + j, (i + 1) * n + j, -right);
        if (j > 0)
          add(i * n + j, i * n + j - 1, -along);
        if (j + 1 < n)
          add(i * n + j, i * n + j + 1, -along);
      }
    matrix.FillComplete();
    Teuchos::ParameterList parameters;
    ML_Epetra::SetDefaults("SA", parameters);
    parameters.set("ML output", 0);
    parameters.set("coarse: max size", 50); // three levels and more
    const ML_Epetra::MultiLevelPreconditioner hierarchy(matrix, parameters);
    cycle = std::make_unique<MultigridCycle>(matrix, hierarchy, 2, MPI_COMM_SELF);
  }

  Epetra_MultiVector random(const int n_columns) const
  {
    Epetra_MultiVector vectors(map, n_columns);
    vectors.SetSeed(1);
    vectors.Random();
    return vectors;
  }

  /// The factor by which x -> x − M A x shortens an error in the energy norm, after some steps.
  double contraction() const
  {
    Epetra_MultiVector x = random(1), image(map, 1), corrected(map, 1);
    double energy = 0., last = 0.;
    for (int step = 0; step < 12; ++step)
    {
      matrix.Apply(x, image);
      last = energy;
      x.Dot(image, &energy);
      cycle->apply(image, corrected);
      x.Update(-1., corrected, 1.);
    }
    return std::sqrt(energy / last);
  }

  Epetra_MpiComm communicator;
  Epetra_Map map;
  Epetra_CrsMatrix matrix;
  std::unique_ptr<MultigridCycle> cycle;

private:
  void add(const int row, const int column, const double value)
  {
    matrix.InsertGlobalValues(row, 1, &value, &column);
  }
};

// Some thirty roundings for each number on the way down and up again, of terms of this contrast.
constexpr double rounded = 30. * 1000. * std::numeric_limits<double>::epsilon();
} // namespace

TEST(invariant_multigrid_cycle, it_is_symmetric_and_positive)
{
  const TwoMedia problem(64);
  const Epetra_MultiVector x = problem.random(8);
  Epetra_MultiVector of_x(problem.map, 8);
  problem.cycle->apply(x, of_x);
  for (int a = 0; a < 8; ++a)
  {
    double own = 0.;
    of_x(a)->Dot(*x(a), &own);
    EXPECT_GT(own, 0.);
    for (int b = 0; b < a; ++b)
    {
      double one = 0., other = 0., its = 0.;
      of_x(a)->Dot(*x(b), &one);
      of_x(b)->Dot(*x(a), &other);
      of_x(b)->Dot(*x(b), &its);
      EXPECT_NEAR(one, other, rounded * std::sqrt(own * its)) << a << " " << b;
    }
  }
}

TEST(invariant_multigrid_cycle, columns_do_not_know_of_each_other_nor_of_their_sizes)
{
  const TwoMedia problem(32);
  for (const int n_columns : {1, 3, 5, 9}) // packs of four and of eight, full and not
  {
    Epetra_MultiVector x = problem.random(n_columns);
    for (int k = 0; k < n_columns; ++k)
      x(k)->Scale(std::pow(1e-40, k % 2));
    Epetra_MultiVector together(problem.map, n_columns), alone(problem.map, 1);
    problem.cycle->apply(x, together);
    for (int k = 0; k < n_columns; ++k)
    {
      problem.cycle->apply(*x(k), alone);
      double size = 0., distance = 0.;
      alone(0)->Norm2(&size);
      alone(0)->Update(-1., *together(k), 1.);
      alone(0)->Norm2(&distance);
      EXPECT_GT(size, 0.);
      EXPECT_LE(distance, rounded * size) << k << " of " << n_columns;
    }
  }
}

TEST(invariant_multigrid_cycle, finer_meshes_lose_nothing_of_its_rate)
{
  const double coarse = TwoMedia(32).contraction(), fine = TwoMedia(128).contraction();
  EXPECT_LT(coarse, 0.5);
  EXPECT_LT(fine, 0.5);
}
} // namespace homespun::homogenization
