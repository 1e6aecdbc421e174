// SPDX-License-Identifier: MIT
#include "shell/algebra/block_matrix.h"

#include "shell/algebra/index.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace homespun::shell
{
namespace
{
/// Free vertices in an order of little fill, then the held ones.
std::vector<int> elimination_order(const std::vector<std::array<int, 2>> &couplings,
                                   const std::vector<bool> &is_held)
{
  std::vector<int> number(is_held.size(), -1), vertices;
  for (std::size_t v = 0; v < is_held.size(); ++v)
    if (!is_held[v])
    {
      number[v] = static_cast<int>(vertices.size());
      vertices.push_back(static_cast<int>(v));
    }
  const int n_free = static_cast<int>(vertices.size());
  std::vector<Eigen::Triplet<char>> entries;
  for (const auto &pair : couplings)
  {
    const int a = number[index(pair[0])], b = number[index(pair[1])];
    if (a >= 0 && b >= 0)
    {
      entries.emplace_back(a, b, 1);
      entries.emplace_back(b, a, 1);
    }
  }
  for (int c = 0; c < n_free; ++c)
    entries.emplace_back(c, c, 1);
  Eigen::SparseMatrix<char> graph(n_free, n_free);
  graph.setFromTriplets(entries.begin(), entries.end(), [](const char a, const char) { return a; });
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation(n_free);
  if (n_free > 0)
    Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Upper>(), permutation);
  std::vector<int> order;
  order.reserve(is_held.size());
  for (int c = 0; c < n_free; ++c)
    order.push_back(vertices[index(permutation.indices()(c))]);
  for (std::size_t v = 0; v < is_held.size(); ++v)
    if (is_held[v])
      order.push_back(static_cast<int>(v));
  return order;
}
} // namespace

template <int dim>
BlockMatrixOf<dim>::BlockMatrixOf(const std::vector<std::array<int, 2>> &couplings,
                                  const std::vector<bool> &is_held)
    : place_of(is_held.size())
    , vertex_at(elimination_order(couplings, is_held))
{
  for (std::size_t p = 0; p < vertex_at.size(); ++p)
    place_of[index(vertex_at[p])] = static_cast<int>(p);
  const int n_free = static_cast<int>(std::count(is_held.begin(), is_held.end(), false));
  std::vector<std::vector<int>> below(index(n_free));
  for (const auto &pair : couplings)
  {
    const int a = place_of[index(pair[0])], b = place_of[index(pair[1])];
    if (std::min(a, b) < n_free)
      below[index(std::min(a, b))].push_back(std::max(a, b));
  }
  first.push_back(0);
  for (int c = 0; c < n_free; ++c)
  {
    std::vector<int> &rows = below[index(c)];
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    row.push_back(c);
    row.insert(row.end(), rows.begin(), rows.end());
    first.push_back(static_cast<int>(row.size()));
  }
  blocks.assign(row.size(), Block::Zero());
}

template <int dim>
typename BlockMatrixOf<dim>::Slot BlockMatrixOf<dim>::slot(const int first_vertex,
                                                           const int second_vertex) const
{
  const int a = place_of[index(first_vertex)], b = place_of[index(second_vertex)];
  const int column = std::min(a, b), below = std::max(a, b);
  if (column >= n_free())
    return {};
  const auto begin = row.begin() + first[index(column)],
             end   = row.begin() + first[index(column + 1)];
  const auto found = std::lower_bound(begin, end, below);
  if (found == end || *found != below)
    throw std::logic_error("block matrix: vertices " + std::to_string(first_vertex) + " and " +
                           std::to_string(second_vertex) + " were not said to be coupled");
  return {static_cast<int>(found - row.begin()), a < b};
}

template <int dim>
void BlockMatrixOf<dim>::clear()
{
  std::fill(blocks.begin(), blocks.end(), Block::Zero());
}

template <int dim>
void BlockMatrixOf<dim>::multiply(const VectorsOf<dim> &x, VectorsOf<dim> &y) const
{
  y.setZero(x.rows(), dim);
  for (int c = 0; c < n_free(); ++c)
  {
    using Row    = Eigen::Matrix<double, 1, dim>;
    const int v  = vertex_at[index(c)];
    const Row xv = x.row(v);
    Row sum      = xv * blocks[index(first[index(c)])];
    for (int k = first[index(c)] + 1; k < first[index(c + 1)]; ++k)
    {
      if (row[index(k)] >= n_free())
        break;
      const int u = vertex_at[index(row[index(k)])];
      y.row(u).noalias() += xv * blocks[index(k)].transpose();
      sum.noalias() += x.row(u) * blocks[index(k)];
    }
    y.row(v) += sum;
  }
}

template <int dim>
void BlockMatrixOf<dim>::subtract_held(const VectorsOf<dim> &x, VectorsOf<dim> &y) const
{
  for (int c = 0; c < n_free(); ++c)
    for (int k = first[index(c + 1)] - 1; k > first[index(c)] && row[index(k)] >= n_free(); --k)
      y.row(vertex_at[index(c)]).noalias() -=
        x.row(vertex_at[index(row[index(k)])]) * blocks[index(k)];
}

template <int dim>
std::size_t BlockMatrixOf<dim>::bytes() const
{
  return blocks.size() * (sizeof(Block) + sizeof(int)) +
         (place_of.size() + vertex_at.size() + first.size()) * sizeof(int);
}

template class BlockMatrixOf<2>;
template class BlockMatrixOf<3>;
} // namespace homespun::shell
