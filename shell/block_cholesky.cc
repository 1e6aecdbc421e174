// SPDX-License-Identifier: MIT
#include "shell/block_cholesky.h"

#include <algorithm>
#include <cmath>

namespace homespun::shell
{
namespace
{
std::size_t index(const int i)
{
  return static_cast<std::size_t>(i);
}

/// T = A B^T for a panel A (n,3) with leading dimension `stride` and a 3 x 3 matrix B at b, columns
/// `stride` apart; T (n,3) with leading dimension n.
void multiply(const double *__restrict a, const int stride, const double *__restrict b, const int n,
              double *__restrict t)
{
  const double b00 = b[0], b10 = b[1], b20 = b[2], b01 = b[stride], b11 = b[stride + 1],
               b21 = b[stride + 2], b02 = b[2 * stride], b12 = b[2 * stride + 1],
               b22                   = b[2 * stride + 2];
  const double *const __restrict a0 = a;
  const double *const __restrict a1 = a + stride;
  const double *const __restrict a2 = a + 2 * stride;
  double *const __restrict t0       = t;
  double *const __restrict t1       = t + n;
  double *const __restrict t2       = t + 2 * n;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i)
  {
    const double p = a0[i], q = a1[i], r = a2[i];
    t0[i] = p * b00 + q * b01 + r * b02;
    t1[i] = p * b10 + q * b11 + r * b12;
    t2[i] = p * b20 + q * b21 + r * b22;
  }
}
} // namespace

BlockCholesky::BlockCholesky(const BlockMatrix &matrix)
    : vertex_at(matrix.vertex_at)
{
  const int n = matrix.n_free();
  // A column of L holds the rows of the matrix and those of its children in the elimination tree; a
  // column's parent is its first row below the diagonal.
  std::vector<std::vector<int>> rows(index(n)), children(index(n));
  std::vector<int> seen(index(n), -1);
  for (int c = 0; c < n; ++c)
  {
    std::vector<int> &own = rows[index(c)];
    seen[index(c)]        = c;
    const auto take       = [&](const int r)
    {
      if (r > c && r < n && seen[index(r)] != c)
      {
        seen[index(r)] = c;
        own.push_back(r);
      }
    };
    for (int k = matrix.first[index(c)]; k < matrix.first[index(c + 1)]; ++k)
      take(matrix.row[index(k)]);
    for (const int child : children[index(c)])
      for (const int r : rows[index(child)])
        take(r);
    std::sort(own.begin(), own.end());
    if (!own.empty())
      children[index(own.front())].push_back(c);
  }
  first.push_back(0);
  start.push_back(0);
  std::vector<std::vector<std::array<int, 2>>> updates(index(n));
  int longest = 1;
  for (int c = 0; c < n; ++c)
  {
    const std::vector<int> &own = rows[index(c)];
    row.push_back(c);
    row.insert(row.end(), own.begin(), own.end());
    const int size = static_cast<int>(own.size()) + 1;
    longest        = std::max(longest, size);
    first.push_back(static_cast<int>(row.size()));
    start.push_back(start.back() + 9 * index(size));
    for (int k = 1; k < size; ++k)
    {
      updates[index(own[index(k - 1)])].push_back({c, k});
      multiply_adds += 27. * (size - k);
    }
    multiply_adds += 18. * size;
  }
  update_first.push_back(0);
  for (const auto &of_column : updates)
  {
    for (const auto &[column, offset] : of_column)
    {
      update_column.push_back(column);
      update_offset.push_back(offset);
    }
    update_first.push_back(static_cast<int>(update_column.size()));
  }
  values.resize(start.back());
  work.resize(std::max(9 * index(longest), 3 * index(n)));
  position.resize(index(n));
}

bool BlockCholesky::factorize(const BlockMatrix &matrix)
{
  const int n = static_cast<int>(first.size()) - 1;
  for (int c = 0; c < n; ++c)
  {
    const int size      = 3 * (first[index(c + 1)] - first[index(c)]);
    double *const panel = values.data() + start[index(c)];
    std::fill_n(panel, 3 * size, 0.);
    for (int k = first[index(c)]; k < first[index(c + 1)]; ++k)
      position[index(row[index(k)])] = 3 * (k - first[index(c)]);
    for (int k = matrix.first[index(c)]; k < matrix.first[index(c + 1)]; ++k)
    {
      if (matrix.row[index(k)] >= n)
        break;
      const BlockMatrix::Block &block = matrix.blocks[index(k)];
      double *const at                = panel + position[index(matrix.row[index(k)])];
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          at[j * size + i] = block(i, j);
    }
    const double diagonal[3] = {panel[0], panel[size + 1], panel[2 * size + 2]};
    for (int u = update_first[index(c)]; u < update_first[index(c + 1)]; ++u)
    {
      const int k          = update_column[index(u)], offset = update_offset[index(u)];
      const int stride     = 3 * (first[index(k + 1)] - first[index(k)]);
      const int n_rows     = stride - 3 * offset;
      const double *source = values.data() + start[index(k)] + 3 * offset;
      multiply(source, stride, source, n_rows, work.data());
      const int *const places = row.data() + first[index(k)] + offset;
      for (int j = 0; j < 3; ++j)
      {
        const double *const from = work.data() + j * n_rows;
        double *const to         = panel + j * size;
        for (int r = 0; r < n_rows / 3; ++r)
        {
          double *const at = to + position[index(places[r])];
          at[0] -= from[3 * r];
          at[1] -= from[3 * r + 1];
          at[2] -= from[3 * r + 2];
        }
      }
    }
    // The diagonal block, then the rows below it.
    for (int j = 0; j < 3; ++j)
    {
      double *const column = panel + j * size;
      for (int i = 0; i < j; ++i)
      {
        const double factor     = panel[i * size + j];
        const double *const old = panel + i * size;
#pragma GCC ivdep
        for (int r = j; r < size; ++r)
          column[r] -= factor * old[r];
      }
      const double pivot = column[j];
      if (!(pivot > 1e-14 * diagonal[j]) || !(pivot > 0.) || !std::isfinite(pivot))
        return false;
      const double inverse = 1. / std::sqrt(pivot);
#pragma GCC ivdep
      for (int r = j; r < size; ++r)
        column[r] *= inverse;
    }
  }
  return true;
}

void BlockCholesky::solve(const Vectors &right_side, Vectors &result) const
{
  const int n     = static_cast<int>(first.size()) - 1;
  double *const x = work.data();
  for (int c = 0; c < n; ++c)
    for (int i = 0; i < 3; ++i)
      x[3 * c + i] = right_side(vertex_at[index(c)], i);
  for (int c = 0; c < n; ++c)
  {
    const int size            = 3 * (first[index(c + 1)] - first[index(c)]);
    const double *const panel = values.data() + start[index(c)];
    double *const y           = x + 3 * c;
    y[0] /= panel[0];
    y[1] = (y[1] - panel[1] * y[0]) / panel[size + 1];
    y[2] = (y[2] - panel[2] * y[0] - panel[size + 2] * y[1]) / panel[2 * size + 2];
    for (int r = 3; r < size; r += 3)
    {
      double *const at = x + 3 * row[index(first[index(c)] + r / 3)];
      for (int i = 0; i < 3; ++i)
        at[i] -= panel[r + i] * y[0] + panel[size + r + i] * y[1] + panel[2 * size + r + i] * y[2];
    }
  }
  for (int c = n - 1; c >= 0; --c)
  {
    const int size            = 3 * (first[index(c + 1)] - first[index(c)]);
    const double *const panel = values.data() + start[index(c)];
    double *const y           = x + 3 * c;
    for (int r = 3; r < size; r += 3)
    {
      const double *const at = x + 3 * row[index(first[index(c)] + r / 3)];
      for (int j = 0; j < 3; ++j)
        y[j] -= panel[j * size + r] * at[0] + panel[j * size + r + 1] * at[1] +
                panel[j * size + r + 2] * at[2];
    }
    y[2] /= panel[2 * size + 2];
    y[1] = (y[1] - panel[size + 2] * y[2]) / panel[size + 1];
    y[0] = (y[0] - panel[1] * y[1] - panel[2] * y[2]) / panel[0];
  }
  result.setZero(right_side.rows(), 3);
  for (int c = 0; c < n; ++c)
    for (int i = 0; i < 3; ++i)
      result(vertex_at[index(c)], i) = x[3 * c + i];
}

std::size_t BlockCholesky::bytes() const
{
  return (values.size() + work.size()) * sizeof(double) + start.size() * sizeof(std::size_t) +
         (row.size() + first.size() + position.size() + vertex_at.size() + update_first.size() +
          update_column.size() + update_offset.size()) *
           sizeof(int);
}
} // namespace homespun::shell
