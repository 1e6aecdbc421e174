// SPDX-License-Identifier: MIT
#include "shell/algebra/block_cholesky.h"

#include "shell/algebra/dense_panel.h"
#include "shell/algebra/index.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace homespun::shell
{
namespace
{
using Panel         = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
using ConstantPanel = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
using Vector        = Eigen::Map<Eigen::VectorXd>;

/// Columns are joined to a panel while at most this part of it are zeros.
constexpr double allowed_zeros = 0.2;

/// From this number of multiply-adds on a product is Eigen's, which packs its factors for the
/// caches; below, packing costs more than it saves.
constexpr double large_product = 4e5;

/// The rows below the diagonal of each column of L: those of the matrix and those of its children
/// in the elimination tree; a column's parent is its first row below the diagonal.
std::vector<std::vector<int>> rows_of_factor(const BlockMatrix &matrix)
{
  const int n = matrix.n_free();
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
  return rows;
}
} // namespace

BlockCholesky::BlockCholesky(const BlockMatrix &matrix)
    : vertex_at(matrix.vertex_at)
{
  const std::vector<std::vector<int>> rows = rows_of_factor(matrix);
  // Of the three columns of a block with m blocks below it, which have c = 3 m + 2, 3 m + 1 and 3 m
  // numbers below their diagonal: c (c + 1) / 2 each for what they take from later columns, c
  // divisions and a root.
  for (const std::vector<int> &own : rows)
    for (int k = 0; k < 3; ++k)
    {
      const double below = 3. * static_cast<double>(own.size()) + k;
      multiply_adds += 0.5 * below * (below + 1.) + below + 1.;
    }
  lay_out_updates(lay_out_nodes(rows));
}

/// Joins columns to supernodes. @return the supernode of each column
std::vector<int> BlockCholesky::lay_out_nodes(const std::vector<std::vector<int>> &rows)
{
  const int n = static_cast<int>(rows.size());
  // The rows of a column are among those of its parent, so that a chain of columns has the rows of
  // the last one.
  std::vector<int> node_of(index(n));
  std::size_t n_values = 0;
  for (int c = 0; c < n;)
  {
    int last       = c;
    double entries = static_cast<double>(rows[index(c)].size()) + 1.;
    while (last + 1 < n && !rows[index(last)].empty() && rows[index(last)].front() == last + 1)
    {
      const double size   = static_cast<double>(rows[index(last + 1)].size()) + 1.,
                   joined = entries + size, columns = last + 2 - c,
                   stored = columns * size + 0.5 * columns * (columns - 1.);
      if (stored - joined > allowed_zeros * stored)
        break;
      entries = joined;
      ++last;
    }
    const std::vector<int> &below = rows[index(last)];
    const int n_columns = last + 1 - c, n_rows = n_columns + static_cast<int>(below.size());
    nodes.push_back({c, n_columns, static_cast<int>(row.size()), n_rows, n_values, 0});
    for (int k = c; k <= last; ++k)
    {
      node_of[index(k)] = static_cast<int>(nodes.size()) - 1;
      row.push_back(k);
    }
    row.insert(row.end(), below.begin(), below.end());
    n_values += 9 * index(n_rows) * index(n_columns);
    c = last + 1;
  }
  nodes.push_back({n, 0, static_cast<int>(row.size()), 0, n_values, 0});
  values.resize(n_values + panel_padding); // multiply() reads whole registers
  return node_of;
}

/// Finds which panels reach into which, and takes the room to work in.
void BlockCholesky::lay_out_updates(const std::vector<int> &node_of)
{
  std::vector<std::vector<Update>> of_node(nodes.size());
  std::size_t longest = 0;
  for (std::size_t s = 0; s < nodes.size(); ++s)
  {
    const Supernode &node = nodes[s];
    longest               = std::max(longest, 3 * index(node.n_rows));
    for (int begin = node.n_columns, end; begin < node.n_rows; begin = end)
    {
      const int target = node_of[index(row[index(node.first_row + begin)])];
      for (end = begin;
           end < node.n_rows && node_of[index(row[index(node.first_row + end)])] == target;)
        ++end;
      of_node[index(target)].push_back({static_cast<int>(s), begin, end - begin});
      n_product =
        std::max(n_product, 3 * index(padded(3 * (node.n_rows - begin))) * index(end - begin));
    }
  }
  for (std::size_t s = 0; s < nodes.size(); ++s)
  {
    nodes[s].first_update = static_cast<int>(updates.size());
    updates.insert(updates.end(), of_node[s].begin(), of_node[s].end());
  }
  const int n = nodes.back().column;
  work.resize(std::max({n_product, 3 * index(n) + longest, 3 * index(padded(longest))}));
  position.resize(index(n));
}

/// Writes the matrix's own values into a panel.
void BlockCholesky::gather(const BlockMatrix &matrix, const Supernode &node)
{
  const int size      = 3 * node.n_rows;
  double *const panel = values.data() + node.start;
  std::fill_n(panel, 3 * index(size) * index(node.n_columns), 0.);
  for (int k = 0; k < node.n_rows; ++k)
    position[index(row[index(node.first_row + k)])] = 3 * k;
  for (int c = 0; c < node.n_columns; ++c)
    for (int k = matrix.first[index(node.column + c)]; k < matrix.first[index(node.column + c + 1)];
         ++k)
    {
      if (matrix.row[index(k)] >= matrix.n_free())
        break;
      Eigen::Map<Eigen::Matrix3d, 0, Eigen::OuterStride<>>(
        panel + 3 * index(c) * index(size) + position[index(matrix.row[index(k)])],
        Eigen::OuterStride<>(size)) = matrix.blocks[index(k)];
    }
}

/// Takes from a panel what an earlier one contributes to its columns.
void BlockCholesky::subtract(const Update &update, const Supernode &node)
{
  const Supernode &from = nodes[index(update.source)];
  const int n_rows = 3 * (from.n_rows - update.offset), n_columns = 3 * update.n_rows,
            depth = 3 * from.n_columns, stride = 3 * from.n_rows;
  const double *const source = values.data() + from.start + 3 * update.offset;
  const ConstantPanel a(source, n_rows, depth, Eigen::OuterStride<>(stride)),
    b(source, n_columns, depth, Eigen::OuterStride<>(stride));
  const int n_padded = padded(n_rows);
  if (static_cast<double>(n_rows) * n_columns * depth < large_product)
    for (int j = 0; j < n_columns; j += 3)
      multiply(source, source + j, stride, depth, n_rows, work.data() + j * n_padded);
  else
    Panel(work.data(), n_rows, n_columns, Eigen::OuterStride<>(n_padded)).noalias() =
      a * b.transpose();
  const int *const places = row.data() + from.first_row + update.offset;
  for (int c = 0; c < update.n_rows; ++c)
  {
    double *const panel =
      values.data() + node.start + 9 * index(places[c] - node.column) * index(node.n_rows);
    for (int j = 0; j < 3; ++j)
    {
      const double *const column = work.data() + (3 * c + j) * n_padded;
      double *const to           = panel + j * 3 * node.n_rows;
      for (int r = c; r < n_rows / 3; ++r)
      {
        double *const at = to + position[index(places[r])];
        at[0] -= column[3 * r];
        at[1] -= column[3 * r + 1];
        at[2] -= column[3 * r + 2];
      }
    }
  }
}

bool BlockCholesky::factorize(const BlockMatrix &matrix)
{
  for (std::size_t s = 0; s + 1 < nodes.size(); ++s)
  {
    const Supernode &node = nodes[s];
    const int width = 3 * node.n_columns, size = 3 * node.n_rows;
    gather(matrix, node);
    for (int u = node.first_update; u < nodes[s + 1].first_update; ++u)
      subtract(updates[index(u)], node);
    // The diagonal block, then the rows below it.
    double *const panel = values.data() + node.start;
    if (!factorize_panel(panel, width, size, work.data()))
      return false;
    for (int j = 0; j < width; ++j)
    {
      const double pivot = panel[j * index(size) + index(j)] * panel[j * index(size) + index(j)];
      const double own =
        matrix.blocks[index(matrix.first[index(node.column + j / 3)])](j % 3, j % 3);
      if (!(pivot > 1e-14 * own) || !(pivot > 0.) || !std::isfinite(pivot))
        return false;
    }
  }
  return true;
}

void BlockCholesky::solve(const Vectors &right_side, Vectors &result) const
{
  const int n     = nodes.back().column;
  double *const x = work.data();
  for (int c = 0; c < n; ++c)
    for (int i = 0; i < 3; ++i)
      x[3 * c + i] = right_side(vertex_at[index(c)], i);
  double *const own = x + 3 * index(n); // the rows of a panel
  for (std::size_t s = 0; s + 1 < nodes.size(); ++s)
  {
    const Supernode &node   = nodes[s];
    const int *const places = row.data() + node.first_row;
    std::copy_n(x + 3 * index(node.column), 3 * node.n_columns, own);
    std::fill_n(own + 3 * node.n_columns, 3 * (node.n_rows - node.n_columns), 0.);
    substitute(values.data() + node.start, 3 * node.n_columns, 3 * node.n_rows, own);
    std::copy_n(own, 3 * node.n_columns, x + 3 * index(node.column));
    for (int k = node.n_columns; k < node.n_rows; ++k)
      for (int i = 0; i < 3; ++i)
        x[3 * index(places[k]) + index(i)] += own[3 * k + i];
  }
  for (std::size_t s = nodes.size() - 1; s-- > 0;)
  {
    const Supernode &node   = nodes[s];
    const int *const places = row.data() + node.first_row;
    for (int k = 0; k < node.n_rows; ++k)
      for (int i = 0; i < 3; ++i)
        own[3 * k + i] = x[3 * index(places[k]) + index(i)];
    substitute_back(values.data() + node.start, 3 * node.n_columns, 3 * node.n_rows, own);
    std::copy_n(own, 3 * node.n_columns, x + 3 * index(node.column));
  }
  result.setZero(right_side.rows(), 3);
  for (int c = 0; c < n; ++c)
    for (int i = 0; i < 3; ++i)
      result(vertex_at[index(c)], i) = x[3 * c + i];
}

std::size_t BlockCholesky::bytes() const
{
  return (values.size() + work.size()) * sizeof(double) + nodes.size() * sizeof(Supernode) +
         updates.size() * sizeof(Update) +
         (row.size() + position.size() + vertex_at.size()) * sizeof(int);
}
} // namespace homespun::shell
