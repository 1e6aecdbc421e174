// SPDX-License-Identifier: MIT
#include "shell/algebra/conjugate_gradients.h"

#include "shell/algebra/index.h"

#include "meshes/plain/errors.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>

namespace homespun::shell
{
IncompleteCholesky::IncompleteCholesky(const BlockMatrix &matrix)
    : values(matrix.blocks.size())
    , inverses(index(matrix.n_free()))
{
}

void IncompleteCholesky::factorize(const BlockMatrix &matrix)
{
  // Right-looking: column c, scaled, is taken from the columns of its rows.
  const int n = matrix.n_free();
  values      = matrix.blocks;
  for (int c = 0; c < n; ++c)
  {
    const int begin = matrix.first[index(c)];
    int end         = matrix.first[index(c + 1)];
    Eigen::LLT<Eigen::Matrix3d> llt(values[index(begin)]);
    if (llt.info() != Eigen::Success || !(llt.matrixLLT().diagonal().minCoeff() > 0.))
      llt.compute(matrix.blocks[index(begin)]);
    const Eigen::Matrix3d inverse = Eigen::Matrix3d(llt.matrixL()).inverse();
    inverses[index(c)]            = inverse;
    while (end > begin + 1 && matrix.row[index(end - 1)] >= n)
      --end;
    for (int k = begin + 1; k < end; ++k)
      values[index(k)] *= inverse.transpose();
    for (int k = begin + 1; k < end; ++k)
    {
      const int column = matrix.row[index(k)];
      int at           = matrix.first[index(column)];
      for (int l = k; l < end; ++l)
      {
        const int r = matrix.row[index(l)];
        while (at < matrix.first[index(column + 1)] && matrix.row[index(at)] < r)
          ++at;
        if (at < matrix.first[index(column + 1)] && matrix.row[index(at)] == r)
          values[index(at)].noalias() -= values[index(l)] * values[index(k)].transpose();
      }
    }
  }
}

void IncompleteCholesky::apply(const BlockMatrix &matrix, const Vectors &r, Vectors &z) const
{
  const int n = matrix.n_free();
  z           = r;
  for (int c = 0; c < n; ++c)
  {
    const int v                = matrix.vertex_at[index(c)];
    const Eigen::RowVector3d y = z.row(v) * inverses[index(c)].transpose();
    z.row(v)                   = y;
    for (int k = matrix.first[index(c)] + 1; k < matrix.first[index(c + 1)]; ++k)
    {
      if (matrix.row[index(k)] >= n)
        break;
      z.row(matrix.vertex_at[index(matrix.row[index(k)])]).noalias() -=
        y * values[index(k)].transpose();
    }
  }
  for (int c = n - 1; c >= 0; --c)
  {
    const int v          = matrix.vertex_at[index(c)];
    Eigen::RowVector3d y = z.row(v);
    for (int k = matrix.first[index(c)] + 1; k < matrix.first[index(c + 1)]; ++k)
    {
      if (matrix.row[index(k)] >= n)
        break;
      y.noalias() -= z.row(matrix.vertex_at[index(matrix.row[index(k)])]) * values[index(k)];
    }
    z.row(v).noalias() = y * inverses[index(c)];
  }
  for (int p = n; p < matrix.n_vertices(); ++p)
    z.row(matrix.vertex_at[index(p)]).setZero();
}

std::size_t IncompleteCholesky::bytes() const
{
  return (values.size() + inverses.size()) * sizeof(BlockMatrix::Block);
}

ConjugateGradientsReport conjugate_gradients(const BlockMatrix &matrix,
                                             const IncompleteCholesky &preconditioner,
                                             const Vectors &right_side,
                                             const double relative_tolerance,
                                             const int max_iterations, Vectors &x)
{
  ConjugateGradientsReport report;
  std::vector<double> history;
  Vectors b = right_side;
  for (int v = 0; v < matrix.n_vertices(); ++v)
    if (!matrix.is_free(v))
      b.row(v).setZero();
  const double size = b.norm();
  if (size == 0.)
  {
    x.setZero(b.rows(), 3);
    return report;
  }
  Vectors Ap, z;
  matrix.multiply(x, Ap);
  Vectors r = b - Ap;
  preconditioner.apply(matrix, r, z);
  Vectors p = z;
  double rz = r.cwiseProduct(z).sum();
  while (true)
  {
    report.relative_residual = r.norm() / size;
    history.push_back(report.relative_residual);
    if (report.relative_residual <= relative_tolerance)
      return report;
    if (report.iterations >= max_iterations || !std::isfinite(report.relative_residual))
      throw meshes::NotConverged("conjugate gradients of the cloth's step", history);
    matrix.multiply(p, Ap);
    const double alpha = rz / p.cwiseProduct(Ap).sum();
    x += alpha * p;
    r -= alpha * Ap;
    preconditioner.apply(matrix, r, z);
    const double next = r.cwiseProduct(z).sum();
    p                 = z + (next / rz) * p;
    rz                = next;
    ++report.iterations;
  }
}
} // namespace homespun::shell
