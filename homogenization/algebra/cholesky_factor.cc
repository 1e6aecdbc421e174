// SPDX-License-Identifier: MIT
#include "homogenization/algebra/cholesky_factor.h"

#include "homogenization/algebra/elimination_order.h"
#include "meshes/plain/errors.h"

#include <Eigen/CholmodSupport>

#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <mutex>
#include <vector>

namespace homespun::homogenization
{
namespace
{
using Matrix  = Eigen::SparseMatrix<double>;
using Pattern = std::array<std::uint64_t, 4>;

/// Rows, entries, and two checksums (FNV-1a) of where the entries are.
Pattern pattern_of(const Matrix &matrix)
{
  const auto checksum = [](const int *from, const std::int64_t n)
  {
    std::uint64_t sum = 0xcbf29ce484222325u;
    for (const int *place = from; place != from + n; ++place)
      sum = (sum ^ static_cast<std::uint32_t>(*place)) * 0x100000001b3u;
    return sum;
  };
  return {static_cast<std::uint64_t>(matrix.rows()), static_cast<std::uint64_t>(matrix.nonZeros()),
          checksum(matrix.outerIndexPtr(), matrix.cols() + 1),
          checksum(matrix.innerIndexPtr(), matrix.nonZeros())};
}

/// Orders of elimination by the pattern of the matrix, four bytes a row.
class Orders
{
public:
  std::vector<int> order_of(const Pattern &pattern)
  {
    const std::lock_guard guard(mutex);
    for (const auto &[known, order] : last)
      if (known == pattern)
        return order;
    return {};
  }

  void remember(const Pattern &pattern, std::vector<int> order)
  {
    // Of a study: displacements P1, P2 and P2 refined on a small and a large sheet under each way
    // of holding it, of the cell, and Airy's function.
    constexpr std::size_t most = 16;
    const std::lock_guard guard(mutex);
    last.emplace_back(pattern, std::move(order));
    if (last.size() > most)
      last.pop_front();
  }

private:
  std::mutex mutex;
  std::deque<std::pair<Pattern, std::vector<int>>> last;
};

Orders &orders()
{
  static Orders of_this_process;
  return of_this_process;
}
} // namespace

class CholeskyFactor::Decomposition
    : public Eigen::CholmodBase<Matrix, Eigen::Lower, CholeskyFactor::Decomposition>
{
public:
  explicit Decomposition(const Matrix &lower_triangle)
      : pattern(pattern_of(lower_triangle))
  {
    m_cholmod.print        = 0;
    m_cholmod.final_asis   = 1;
    m_cholmod.supernodal   = CHOLMOD_SUPERNODAL;
    std::vector<int> order = orders().order_of(pattern);
    const bool is_known    = !order.empty();
    m_cholmod.postorder    = !is_known; // which is remembered after it
    if (is_known)
      analyze(lower_triangle, order);
    else if (lower_triangle.cols() < least_dissected)
      analyzePattern(lower_triangle);
    else
    {
      order = elimination_order(lower_triangle);
      analyze(lower_triangle, order);
    }
    if (is_known || m_cholmodFactor == nullptr)
      return;
    const auto *const found = static_cast<const int *>(m_cholmodFactor->Perm);
    orders().remember(pattern, {found, found + m_cholmodFactor->n});
  }

  /// Whether a matrix has the same places of entries.
  bool is_of(const Matrix &lower_triangle) const
  {
    return pattern == pattern_of(lower_triangle);
  }

private:
  const Pattern pattern;
  /// From which size on nodes are ordered in the place of unknowns; CHOLMOD itself is as fast
  /// below.
  static constexpr Eigen::Index least_dissected = 20000;

  void analyze(const Matrix &lower_triangle, std::vector<int> &order)
  {
    m_cholmod.nmethods           = 1;
    m_cholmod.method[0].ordering = CHOLMOD_GIVEN;
    cholmod_sparse view = Eigen::viewAsCholmod(lower_triangle.selfadjointView<Eigen::Lower>());
    m_cholmodFactor     = cholmod_analyze_p(&view, order.data(), nullptr, 0, &m_cholmod);
    m_isInitialized     = true;
    m_analysisIsOk      = true;
    m_info              = Eigen::Success;
  }
};

CholeskyFactor::CholeskyFactor(Matrix lower_triangle, const std::string &what)
    : what(what)
{
  factorize(std::move(lower_triangle));
}

void CholeskyFactor::factorize(Matrix lower_triangle)
{
  scale = lower_triangle.diagonal();
  for (double &entry : scale)
  {
    if (!(entry > 0.) || !std::isfinite(entry))
      throw meshes::NotConverged(what + ": a degree of freedom has no stiffness", {});
    entry = 1. / std::sqrt(entry);
  }
  for (int column = 0; column < lower_triangle.outerSize(); ++column)
    for (Matrix::InnerIterator entry(lower_triangle, column); entry; ++entry)
      entry.valueRef() *= scale(entry.row()) * scale(column);

  lower_triangle.makeCompressed();
  if (!decomposition || !decomposition->is_of(lower_triangle))
    decomposition = std::make_unique<Decomposition>(lower_triangle);
  // Near contrast 1e9 round-off can make the last pivots negative. A small shift then gives a
  // preconditioner, and conjugate gradients take the shift out again.
  for (const double shift : {0., 1e-14, 1e-12})
  {
    decomposition->setShift(shift);
    decomposition->factorize(lower_triangle);
    if (decomposition->info() == Eigen::Success)
      return;
  }
  throw meshes::NotConverged(
    what + ": the matrix is not positive definite; expected a connected cell whose parts hang "
           "together by more than single vertices",
    {});
}

CholeskyFactor::~CholeskyFactor() = default;

Eigen::MatrixXd CholeskyFactor::solve(const Eigen::MatrixXd &right_hand_sides) const
{
  const Eigen::MatrixXd scaled = scale.asDiagonal() * right_hand_sides;
  return scale.asDiagonal() * Eigen::MatrixXd(decomposition->solve(scaled));
}
} // namespace homespun::homogenization
