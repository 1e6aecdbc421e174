// SPDX-License-Identifier: MIT
#include "shell/algebra/vertex_matrix.h"

namespace homespun::shell
{
VertexMatrix::VertexMatrix(const std::vector<bool> &is_held)
    : diagonal(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(is_held.size())))
{
  for (const bool held : is_held)
    place.push_back(held ? -1 : n_free++);
}

void VertexMatrix::clear()
{
  entries.clear();
  diagonal.setZero();
}

void VertexMatrix::add(const int row, const int column, const Eigen::Matrix3d &block)
{
  const int r = place[static_cast<std::size_t>(row)], c = place[static_cast<std::size_t>(column)];
  if (r < 0 || c < 0)
    return;
  if (row == column)
    diagonal(row) += block.trace();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      entries.emplace_back(3 * r + i, 3 * c + j, block(i, j));
}

bool VertexMatrix::solve(const Vectors &right_side, Vectors &result)
{
  result.setZero(right_side.rows(), 3);
  if (n_free == 0)
    return true;
  Eigen::SparseMatrix<double> matrix(3 * n_free, 3 * n_free);
  matrix.setFromTriplets(entries.begin(), entries.end());
  if (!factor)
  {
    factor = std::make_unique<Eigen::SparseLU<Eigen::SparseMatrix<double>>>();
    factor->analyzePattern(matrix);
  }
  factor->factorize(matrix);
  if (factor->info() != Eigen::Success)
    return false;
  Eigen::VectorXd unknowns(3 * n_free);
  for (Eigen::Index v = 0; v < right_side.rows(); ++v)
    if (place[static_cast<std::size_t>(v)] >= 0)
      unknowns.segment<3>(3 * place[static_cast<std::size_t>(v)]) = right_side.row(v).transpose();
  unknowns = factor->solve(unknowns).eval();
  for (Eigen::Index v = 0; v < right_side.rows(); ++v)
    if (place[static_cast<std::size_t>(v)] >= 0)
      result.row(v) = unknowns.segment<3>(3 * place[static_cast<std::size_t>(v)]).transpose();
  return unknowns.allFinite();
}

std::size_t VertexMatrix::bytes() const
{
  return place.capacity() * sizeof(int) + entries.capacity() * sizeof(entries[0]);
}
} // namespace homespun::shell
