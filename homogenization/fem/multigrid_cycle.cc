// SPDX-License-Identifier: MIT
#include "homogenization/fem/multigrid_cycle.h"

#include "homogenization/algebra/cholesky_factor.h"
#include "homogenization/fem/halo.h"

#include <Epetra_CrsMatrix.h>
#include <Epetra_MultiVector.h>
#include <Epetra_Vector.h>
#include <ml_MultiLevelPreconditioner.h>
#include <ml_epetra_utils.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>
#include <tuple>
#include <vector>

namespace homespun::homogenization
{
// Not without a name, as Levels holds some of it.
namespace multigrid
{
/// The rows of a matrix that this rank owns.
struct OwnedRows
{
  explicit OwnedRows(const Epetra_CrsMatrix &matrix)
      : halo(matrix)
      , n(matrix.NumMyRows())
  {
    int *its_first = nullptr, *its_columns = nullptr;
    double *its_values = nullptr;
    if (matrix.ExtractCrsDataPointers(its_first, its_columns, its_values) != 0)
      throw std::logic_error("a matrix of a multigrid hierarchy does not lie in one piece");
    first   = its_first;
    columns = its_columns;
    values  = its_values;
  }

  /// A row of the matrix times columns of x.
  template <int lanes>
  Eigen::Array<double, 1, lanes> row_times(const int row, const LaneBlock<lanes> &x) const
  {
    Eigen::Array<double, 1, lanes> sum = Eigen::Array<double, 1, lanes>::Zero();
    for (int k = first[row]; k < first[row + 1]; ++k)
      sum += values[k] * x.row(columns[k]).array();
    return sum;
  }

  const Halo halo;
  const int n;
  const int *first, *columns; ///< those of the matrix
  const double *values;
};

/// What the cycle works in on one mesh.
template <int lanes>
struct WorkOfLevel
{
  LaneBlock<lanes> right, x, correction, earlier, at_columns;

  /// x where the columns of a matrix ask for it.
  const LaneBlock<lanes> &of(const Halo &halo, const LaneBlock<lanes> &owned)
  {
    if (halo.is_trivial())
      return owned;
    halo.gather(owned, at_columns);
    return at_columns;
  }
};

/// A matrix of ML as one of Epetra.
std::unique_ptr<Epetra_CrsMatrix> epetra_matrix(ML_Operator &given)
{
  Epetra_CrsMatrix *matrix = nullptr;
  if (ML_Operator2EpetraCrsMatrix(&given, matrix) != 0)
    throw std::logic_error("a matrix of a multigrid hierarchy cannot be read");
  return std::unique_ptr<Epetra_CrsMatrix>(matrix);
}

struct Level
{
  explicit Level(const Epetra_CrsMatrix &given)
      : matrix(given)
      , inverse_diagonal(Eigen::ArrayXd::Zero(given.NumMyRows()))
  {
    for (int row = 0; row < matrix.n; ++row)
      for (int k = matrix.first[row]; k < matrix.first[row + 1]; ++k)
        if (given.GCID(matrix.columns[k]) == given.GRID(row) && matrix.values[k] > 0.)
          inverse_diagonal(row) = 1. / matrix.values[k];
  }

  template <int lanes>
  WorkOfLevel<lanes> &work() const
  {
    return std::get<WorkOfLevel<lanes>>(work_of_lanes);
  }

  std::unique_ptr<Epetra_CrsMatrix> of_matrix, of_prolongation; ///< what the rows stand in
  OwnedRows matrix;
  std::unique_ptr<OwnedRows> prolongation; ///< from the next coarser level
  Eigen::ArrayXd inverse_diagonal;         ///< zero where a row is empty
  double largest = 0.;                     ///< bound of the eigenvalues of D^-1 A
  mutable std::tuple<WorkOfLevel<4>, WorkOfLevel<8>> work_of_lanes;
};

/// The coarsest problem, which every rank knows and solves.
class CoarsestProblem
{
public:
  CoarsestProblem(const Epetra_CrsMatrix &matrix, const MPI_Comm communicator)
      : communicator(communicator)
  {
    int n_ranks = 1;
    MPI_Comm_size(communicator, &n_ranks);
    MPI_Comm_rank(communicator, &rank);
    counts.resize(static_cast<std::size_t>(n_ranks));
    const int n_mine = matrix.NumMyRows();
    MPI_Allgather(&n_mine, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator);
    starts.assign(counts.size() + 1, 0);
    std::partial_sum(counts.begin(), counts.end(), starts.begin() + 1);
    const int n           = starts.back();
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    for (int row = 0; row < n_mine; ++row)
    {
      int n_entries = 0, *columns = nullptr;
      double *values = nullptr;
      matrix.ExtractMyRowView(row, n_entries, values, columns);
      for (int k = 0; k < n_entries; ++k)
        dense(starts[static_cast<std::size_t>(rank)] + row, matrix.GCID(columns[k])) = values[k];
    }
    MPI_Allreduce(MPI_IN_PLACE, dense.data(), n * n, MPI_DOUBLE, MPI_SUM, communicator);
    for (int k = 0; k < n; ++k)
      if (!(dense(k, k) > 0.)) // nothing is prolongated from it
        dense(k, k) = 1.;
    dense.triangularView<Eigen::StrictlyUpper>().setZero();
    factor = std::make_unique<CholeskyFactor>(Eigen::SparseMatrix<double>(dense.sparseView()),
                                              "coarsest mesh of the multigrid");
  }

  template <int lanes>
  void solve(const LaneBlock<lanes> &right, LaneBlock<lanes> &x) const
  {
    LaneBlock<lanes> all(starts.back(), lanes);
    std::vector<int> n_numbers, places;
    for (std::size_t k = 0; k < counts.size(); ++k)
    {
      n_numbers.push_back(lanes * counts[k]);
      places.push_back(lanes * starts[k]);
    }
    MPI_Allgatherv(right.data(), static_cast<int>(right.size()), MPI_DOUBLE, all.data(),
                   n_numbers.data(), places.data(), MPI_DOUBLE, communicator);
    const Eigen::MatrixXd solution = factor->solve(all);
    const auto mine                = static_cast<std::size_t>(rank);
    x                              = solution.middleRows(starts[mine], counts[mine]);
  }

private:
  MPI_Comm communicator;
  int rank = 0;
  std::vector<int> counts, starts; ///< of the rows of each rank
  std::unique_ptr<CholeskyFactor> factor;
};
} // namespace multigrid
using namespace multigrid;

class MultigridCycle::Levels
{
public:
  Levels(const Epetra_CrsMatrix &finest, const Epetra_Operator &hierarchy,
         const unsigned int degree, const MPI_Comm communicator)
      : degree(degree)
      , communicator(communicator)
  {
    const ML &made = *dynamic_cast<const ML_Epetra::MultiLevelPreconditioner &>(hierarchy).GetML();
    levels.push_back(std::make_unique<Level>(finest));
    for (const ML_1Level *its = &made.SingleLevel[made.ML_finest_level];
         its->Rmat != nullptr && its->Rmat->to != nullptr; its = its->Rmat->to)
    {
      Level &above          = *levels.back();
      above.of_prolongation = epetra_matrix(*its->Rmat->to->Pmat);
      above.prolongation    = std::make_unique<OwnedRows>(*above.of_prolongation);
      auto matrix           = epetra_matrix(*its->Rmat->to->Amat);
      levels.push_back(std::make_unique<Level>(*matrix));
      levels.back()->of_matrix = std::move(matrix);
    }
    coarsest = std::make_unique<CoarsestProblem>(
      levels.size() > 1 ? *levels.back()->of_matrix : finest, communicator);
    for (std::size_t k = 0; k + 1 < levels.size(); ++k)
      levels[k]->largest = largest_eigenvalue(*levels[k]);
  }

  void apply(const Epetra_MultiVector &residuals, Epetra_MultiVector &preconditioned)
  {
    const int n = residuals.NumVectors();
    for (int first = 0; first < n;)
    {
      const int some = std::min(n - first, 8);
      some <= 4 ? apply<4>(residuals, first, some, preconditioned)
                : apply<8>(residuals, first, some, preconditioned);
      first += some;
    }
  }

private:
  template <int lanes>
  void apply(const Epetra_MultiVector &residuals, const int first, const int some,
             Epetra_MultiVector &preconditioned)
  {
    WorkOfLevel<lanes> &work = levels[0]->work<lanes>();
    work.right.setZero(residuals.MyLength(), lanes);
    for (int k = 0; k < some; ++k)
      for (int i = 0; i < residuals.MyLength(); ++i)
        work.right(i, k) = residuals[first + k][i];
    cycle<lanes>(0);
    for (int k = 0; k < some; ++k)
      for (int i = 0; i < residuals.MyLength(); ++i)
        preconditioned[first + k][i] = work.x(i, k);
  }

  /// x of the right-hand side of a level, from zero.
  template <int lanes>
  void cycle(const std::size_t k)
  {
    const Level &level       = *levels[k];
    WorkOfLevel<lanes> &work = level.work<lanes>();
    if (k + 1 == levels.size())
    {
      coarsest->solve(work.right, work.x);
      return;
    }
    work.x.resize(level.matrix.n, lanes);
    work.correction.resize(level.matrix.n, lanes);
    smooth<lanes>(level, true);
    restrict<lanes>(k);
    WorkOfLevel<lanes> &below = levels[k + 1]->work<lanes>();
    cycle<lanes>(k + 1);
    if (k + 2 < levels.size()) // once more, for what is left
    {
      below.earlier             = below.x;
      const OwnedRows &matrix   = levels[k + 1]->matrix;
      const LaneBlock<lanes> &x = below.of(matrix.halo, below.earlier);
      for (int i = 0; i < matrix.n; ++i)
        below.right.row(i).array() -= matrix.row_times<lanes>(i, x);
      cycle<lanes>(k + 1);
      below.x += below.earlier;
    }
    const OwnedRows &prolongation = *level.prolongation;
    const LaneBlock<lanes> &x     = below.of(prolongation.halo, below.x);
    for (int i = 0; i < prolongation.n; ++i)
      work.x.row(i).array() += prolongation.row_times<lanes>(i, x);
    smooth<lanes>(level, false);
  }

  /// The right-hand side of the next level: what x has left, by the transpose of the prolongation.
  template <int lanes>
  void restrict(const std::size_t k)
  {
    const Level &level            = *levels[k];
    WorkOfLevel<lanes> &work      = level.work<lanes>();
    WorkOfLevel<lanes> &below     = levels[k + 1]->work<lanes>();
    const OwnedRows &prolongation = *level.prolongation;
    const LaneBlock<lanes> &x     = work.of(level.matrix.halo, work.x);
    LaneBlock<lanes> sums         = LaneBlock<lanes>::Zero(prolongation.halo.n_columns, lanes);
    for (int i = 0; i < level.matrix.n; ++i)
    {
      const Eigen::Array<double, 1, lanes> left =
        work.right.row(i).array() - level.matrix.row_times<lanes>(i, x);
      for (int entry = prolongation.first[i]; entry < prolongation.first[i + 1]; ++entry)
        sums.row(prolongation.columns[entry]).array() += prolongation.values[entry] * left;
    }
    if (prolongation.halo.is_trivial())
    {
      below.right = std::move(sums);
      return;
    }
    below.right.setZero(levels[k + 1]->matrix.n, lanes);
    prolongation.halo.scatter_add(sums, below.right);
  }

  /// Steps of Chebyshev's iteration on the upper part of the spectrum.
  template <int lanes>
  void smooth(const Level &level, const bool starts_at_zero)
  {
    constexpr double part    = 10.; // of the spectrum that is smoothed, largest over smallest
    WorkOfLevel<lanes> &work = level.work<lanes>();
    const double centre      = 0.5 * level.largest * (1. + 1. / part),
                 radius = 0.5 * level.largest * (1. - 1. / part), sigma = centre / radius;
    double rho = 1. / sigma;
    for (unsigned int step = 0; step < degree; ++step)
    {
      double of_earlier = 0., of_residual = 1. / centre;
      if (step > 0)
      {
        const double next = 1. / (2. * sigma - rho);
        of_earlier        = next * rho;
        of_residual       = 2. * next / radius;
        rho               = next;
      }
      if (step == 0 && starts_at_zero)
      {
        for (int i = 0; i < level.matrix.n; ++i)
          work.correction.row(i) = of_residual * level.inverse_diagonal(i) * work.right.row(i);
        work.x = work.correction;
        continue;
      }
      const LaneBlock<lanes> &x = work.of(level.matrix.halo, work.x);
      for (int i = 0; i < level.matrix.n; ++i)
      {
        const Eigen::Array<double, 1, lanes> left =
          work.right.row(i).array() - level.matrix.row_times<lanes>(i, x);
        const double factor = of_residual * level.inverse_diagonal(i);
        if (step == 0)
          work.correction.row(i).array() = factor * left;
        else
          work.correction.row(i).array() =
            of_earlier * work.correction.row(i).array() + factor * left;
      }
      work.x += work.correction;
    }
  }

  /// By the power method from four random starts, and a tenth more.
  double largest_eigenvalue(const Level &level) const
  {
    constexpr int lanes = 4, n_steps = 12;
    WorkOfLevel<lanes> &work = level.work<lanes>();
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1., 1.);
    LaneBlock<lanes> x(level.matrix.n, lanes), image = x;
    for (int i = 0; i < x.rows(); ++i)
      for (int k = 0; k < lanes; ++k)
        x(i, k) = uniform(random);
    double found = 0.;
    for (int step = 0; step < n_steps; ++step)
    {
      // In the norm of D, in which D^-1 A is symmetric.
      Eigen::Array<double, 2, lanes> squares = Eigen::Array<double, 2, lanes>::Zero();
      const LaneBlock<lanes> &at_columns     = work.of(level.matrix.halo, x);
      for (int i = 0; i < x.rows(); ++i)
      {
        const double weight = level.inverse_diagonal(i);
        image.row(i)        = weight * level.matrix.row_times<lanes>(i, at_columns).matrix();
        if (weight > 0.)
        {
          squares.row(0) += x.row(i).array().square() / weight;
          squares.row(1) += image.row(i).array().square() / weight;
        }
      }
      MPI_Allreduce(MPI_IN_PLACE, squares.data(), 2 * lanes, MPI_DOUBLE, MPI_SUM, communicator);
      found = 0.;
      for (int k = 0; k < lanes; ++k)
        if (squares(0, k) > 0.)
        {
          found    = std::max(found, std::sqrt(squares(1, k) / squares(0, k)));
          x.col(k) = image.col(k) / std::sqrt(squares(1, k));
        }
    }
    work = {};
    return 1.1 * found;
  }

  const unsigned int degree;
  const MPI_Comm communicator;
  std::vector<std::unique_ptr<Level>> levels; ///< the finest first
  std::unique_ptr<CoarsestProblem> coarsest;
};

MultigridCycle::MultigridCycle(const Epetra_CrsMatrix &finest, const Epetra_Operator &hierarchy,
                               const unsigned int degree, const MPI_Comm communicator)
    : levels(std::make_unique<Levels>(finest, hierarchy, degree, communicator))
{
}

MultigridCycle::~MultigridCycle() = default;

void MultigridCycle::apply(const Epetra_MultiVector &residuals, Epetra_MultiVector &preconditioned)
{
  levels->apply(residuals, preconditioned);
}
} // namespace homespun::homogenization
