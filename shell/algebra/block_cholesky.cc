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
template <int dim>
std::vector<std::vector<int>> rows_of_factor(const BlockMatrixOf<dim> &matrix)
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

template <int dim>
BlockCholeskyOf<dim>::BlockCholeskyOf(const BlockMatrixOf<dim> &matrix)
    : vertex_at(matrix.vertex_at)
{
  const std::vector<std::vector<int>> rows = rows_of_factor(matrix);
  // Of the columns of a block with m blocks below it, which have c = dim m + dim − 1 ... dim m
  // numbers below their diagonal: c (c + 1) / 2 each for what they take from later columns, c
  // divisions and a root.
  for (const std::vector<int> &own : rows)
    for (int k = 0; k < dim; ++k)
    {
      const double below = dim * static_cast<double>(own.size()) + k;
      multiply_adds += 0.5 * below * (below + 1.) + below + 1.;
    }
  lay_out_updates(lay_out_nodes(rows));
}

/// Joins columns to supernodes. @return the supernode of each column
template <int dim>
std::vector<int> BlockCholeskyOf<dim>::lay_out_nodes(const std::vector<std::vector<int>> &rows)
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
    n_values += dim * dim * index(n_rows) * index(n_columns);
    c = last + 1;
  }
  nodes.push_back({n, 0, static_cast<int>(row.size()), 0, n_values, 0});
  values.resize(n_values + panel_padding); // multiply() reads whole registers
  return node_of;
}

/// Finds which panels reach into which, and takes the room to work in.
template <int dim>
void BlockCholeskyOf<dim>::lay_out_updates(const std::vector<int> &node_of)
{
  std::vector<std::vector<Update>> of_node(nodes.size());
  std::size_t longest = 0;
  for (std::size_t s = 0; s < nodes.size(); ++s)
  {
    const Supernode &node = nodes[s];
    longest               = std::max(longest, dim * index(node.n_rows));
    for (int begin = node.n_columns, end; begin < node.n_rows; begin = end)
    {
      const int target = node_of[index(row[index(node.first_row + begin)])];
      for (end = begin;
           end < node.n_rows && node_of[index(row[index(node.first_row + end)])] == target;)
        ++end;
      of_node[index(target)].push_back({static_cast<int>(s), begin, end - begin});
      n_product =
        std::max(n_product, dim * index(padded(dim * (node.n_rows - begin))) * index(end - begin));
    }
  }
  for (std::size_t s = 0; s < nodes.size(); ++s)
  {
    nodes[s].first_update = static_cast<int>(updates.size());
    updates.insert(updates.end(), of_node[s].begin(), of_node[s].end());
  }
  const int n = nodes.back().column;
  work.resize(std::max({n_product, dim * index(n) + longest, dim * index(padded(longest))}));
  position.resize(index(n));
}

/// Writes the matrix's own values into a panel.
template <int dim>
void BlockCholeskyOf<dim>::gather(const BlockMatrixOf<dim> &matrix, const Supernode &node)
{
  const int size      = dim * node.n_rows;
  double *const panel = values.data() + node.start;
  std::fill_n(panel, dim * index(size) * index(node.n_columns), 0.);
  for (int k = 0; k < node.n_rows; ++k)
    position[index(row[index(node.first_row + k)])] = dim * k;
  for (int c = 0; c < node.n_columns; ++c)
    for (int k = matrix.first[index(node.column + c)]; k < matrix.first[index(node.column + c + 1)];
         ++k)
    {
      if (matrix.row[index(k)] >= matrix.n_free())
        break;
      Eigen::Map<Eigen::Matrix<double, dim, dim>, 0, Eigen::OuterStride<>>(
        panel + dim * index(c) * index(size) + position[index(matrix.row[index(k)])],
        Eigen::OuterStride<>(size)) = matrix.blocks[index(k)];
    }
}

/// Takes from a panel what an earlier one contributes to its columns.
template <int dim>
void BlockCholeskyOf<dim>::subtract(const Update &update, const Supernode &node)
{
  const Supernode &from = nodes[index(update.source)];
  const int n_rows = dim * (from.n_rows - update.offset), n_columns = dim * update.n_rows,
            depth = dim * from.n_columns, stride = dim * from.n_rows;
  const double *const source = values.data() + from.start + dim * update.offset;
  const ConstantPanel a(source, n_rows, depth, Eigen::OuterStride<>(stride)),
    b(source, n_columns, depth, Eigen::OuterStride<>(stride));
  const int n_padded = padded(n_rows);
  if (static_cast<double>(n_rows) * n_columns * depth < large_product)
    for (int j = 0; j < n_columns; j += dim)
      multiply<dim>(source, source + j, stride, depth, n_rows, work.data() + j * n_padded);
  else
    Panel(work.data(), n_rows, n_columns, Eigen::OuterStride<>(n_padded)).noalias() =
      a * b.transpose();
  const int *const places = row.data() + from.first_row + update.offset;
  for (int c = 0; c < update.n_rows; ++c)
  {
    double *const panel =
      values.data() + node.start + dim * dim * index(places[c] - node.column) * index(node.n_rows);
    for (int j = 0; j < dim; ++j)
    {
      const double *const column = work.data() + (dim * c + j) * n_padded;
      double *const to           = panel + j * dim * node.n_rows;
      for (int r = c; r < n_rows / dim; ++r)
      {
        double *const at = to + position[index(places[r])];
        for (int i = 0; i < dim; ++i)
          at[i] -= column[dim * r + i];
      }
    }
  }
}

template <int dim>
bool BlockCholeskyOf<dim>::factorize(const BlockMatrixOf<dim> &matrix)
{
  for (std::size_t s = 0; s + 1 < nodes.size(); ++s)
  {
    const Supernode &node = nodes[s];
    const int width = dim * node.n_columns, size = dim * node.n_rows;
    gather(matrix, node);
    for (int u = node.first_update; u < nodes[s + 1].first_update; ++u)
      subtract(updates[index(u)], node);
    // The diagonal block, then the rows below it.
    double *const panel = values.data() + node.start;
    if (!factorize_panel<dim>(panel, width, size, work.data()))
      return false;
    for (int j = 0; j < width; ++j)
    {
      const double pivot = panel[j * index(size) + index(j)] * panel[j * index(size) + index(j)];
      const double own =
        matrix.blocks[index(matrix.first[index(node.column + j / dim)])](j % dim, j % dim);
      if (!(pivot > 1e-14 * own) || !(pivot > 0.) || !std::isfinite(pivot))
        return false;
    }
  }
  return true;
}

template <int dim>
void BlockCholeskyOf<dim>::solve(const VectorsOf<dim> &right_side, VectorsOf<dim> &result) const
{
  const int n     = nodes.back().column;
  double *const x = work.data();
  for (int c = 0; c < n; ++c)
    for (int i = 0; i < dim; ++i)
      x[dim * c + i] = right_side(vertex_at[index(c)], i);
  double *const own = x + dim * index(n); // the rows of a panel
  for (std::size_t s = 0; s + 1 < nodes.size(); ++s)
  {
    const Supernode &node   = nodes[s];
    const int *const places = row.data() + node.first_row;
    std::copy_n(x + dim * index(node.column), dim * node.n_columns, own);
    std::fill_n(own + dim * node.n_columns, dim * (node.n_rows - node.n_columns), 0.);
    substitute<dim>(values.data() + node.start, dim * node.n_columns, dim * node.n_rows, own);
    std::copy_n(own, dim * node.n_columns, x + dim * index(node.column));
    for (int k = node.n_columns; k < node.n_rows; ++k)
      for (int i = 0; i < dim; ++i)
        x[dim * index(places[k]) + index(i)] += own[dim * k + i];
  }
  for (std::size_t s = nodes.size() - 1; s-- > 0;)
  {
    const Supernode &node   = nodes[s];
    const int *const places = row.data() + node.first_row;
    for (int k = 0; k < node.n_rows; ++k)
      for (int i = 0; i < dim; ++i)
        own[dim * k + i] = x[dim * index(places[k]) + index(i)];
    substitute_back<dim>(values.data() + node.start, dim * node.n_columns, dim * node.n_rows, own);
    std::copy_n(own, dim * node.n_columns, x + dim * index(node.column));
  }
  result.setZero(right_side.rows(), dim);
  for (int c = 0; c < n; ++c)
    for (int i = 0; i < dim; ++i)
      result(vertex_at[index(c)], i) = x[dim * c + i];
}

template <int dim>
std::size_t BlockCholeskyOf<dim>::bytes() const
{
  return (values.size() + work.size()) * sizeof(double) + nodes.size() * sizeof(Supernode) +
         updates.size() * sizeof(Update) +
         (row.size() + position.size() + vertex_at.size()) * sizeof(int);
}

template class BlockCholeskyOf<2>;
template class BlockCholeskyOf<3>;
} // namespace homespun::shell
