// SPDX-License-Identifier: MIT
#include "shell/algebra/plane_matrix.h"

#include "shell/algebra/index.h"

namespace homespun::shell
{
namespace
{
std::vector<std::array<int, 2>> couplings_of(const PlaneMatrix::Elements &elements)
{
  std::vector<std::array<int, 2>> pairs;
  for (Eigen::Index e = 0; e < elements.rows(); ++e)
    for (Eigen::Index a = 0; a < elements.cols(); ++a)
      for (Eigen::Index b = a + 1; b < elements.cols(); ++b)
        pairs.push_back({elements(e, a), elements(e, b)});
  return pairs;
}
} // namespace

PlaneMatrix::PlaneMatrix(const Elements &elements, const std::vector<bool> &is_held)
    : n_vertices(static_cast<int>(elements.cols()))
    , matrix(couplings_of(elements), is_held)
    , cholesky(matrix)
{
  for (Eigen::Index e = 0; e < elements.rows(); ++e)
    for (int a = 0; a < n_vertices; ++a)
      for (int b = a; b < n_vertices; ++b)
        places.push_back(matrix.slot(elements(e, a), elements(e, b)));
  clear();
}

void PlaneMatrix::clear()
{
  matrix.clear();
  shifted = 0.;
}

bool PlaneMatrix::factorize(const double shift)
{
  for (int c = 0; c < matrix.n_free(); ++c)
    matrix.blocks[index(matrix.first[index(c)])].diagonal().array() += shift - shifted;
  shifted = shift;
  return cholesky.factorize(matrix);
}

PlaneMatrix::Rows PlaneMatrix::solve(const Rows &right_side) const
{
  Rows result;
  cholesky.solve(right_side, result);
  return result;
}

PlaneMatrix::Rows PlaneMatrix::multiply(const Rows &rows) const
{
  Rows result;
  matrix.multiply(rows, result);
  return result;
}

double PlaneMatrix::mean_diagonal() const
{
  double sum = 0.;
  for (int c = 0; c < matrix.n_free(); ++c)
    sum += matrix.blocks[index(matrix.first[index(c)])].trace();
  return matrix.n_free() > 0 ? sum / (2 * matrix.n_free()) : 0.;
}
} // namespace homespun::shell
