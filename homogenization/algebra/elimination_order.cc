// SPDX-License-Identifier: MIT
#include "homogenization/algebra/elimination_order.h"

#include <metis.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <numeric>

namespace homespun::homogenization
{
namespace
{
using Matrix = Eigen::SparseMatrix<double>;

/// A number without pattern for each unknown (splitmix64).
std::uint64_t mixed(std::uint64_t number)
{
  number += 0x9e3779b97f4a7c15u;
  number = (number ^ (number >> 30)) * 0xbf58476d1ce4e5b9u;
  number = (number ^ (number >> 27)) * 0x94d049bb133111ebu;
  return number ^ (number >> 31);
}

/// The first unknown of each node. Which unknowns have the same entries is told by a sum over them:
/// two that differ and have the same sum would cost fill, and nothing else.
std::vector<int> first_unknowns_of_nodes(const Matrix &lower_triangle)
{
  const auto n = static_cast<int>(lower_triangle.cols());
  std::vector<std::uint64_t> sums(static_cast<std::size_t>(n), 0);
  for (int column = 0; column < n; ++column)
    for (Matrix::InnerIterator entry(lower_triangle, column); entry; ++entry)
    {
      const auto row = static_cast<int>(entry.row());
      sums[static_cast<std::size_t>(column)] += mixed(static_cast<std::uint64_t>(row));
      if (row != column)
        sums[static_cast<std::size_t>(row)] += mixed(static_cast<std::uint64_t>(column));
    }
  std::vector<int> first;
  for (int k = 0; k < n; ++k)
    if (k == 0 || sums[static_cast<std::size_t>(k)] != sums[static_cast<std::size_t>(k - 1)])
      first.push_back(k);
  return first;
}

/// Nodes, how many unknowns each has, and which of them are neighbours, as METIS wants them.
struct Graph
{
  std::vector<idx_t> starts, neighbours, sizes;
};

Graph graph_of_nodes(const Matrix &lower_triangle, const std::vector<int> &first)
{
  std::vector<int> node(static_cast<std::size_t>(lower_triangle.cols()), -1);
  for (std::size_t k = 0; k < first.size(); ++k)
    node[static_cast<std::size_t>(first[k])] = static_cast<int>(k);
  const auto for_pairs = [&](const auto &work)
  {
    for (std::size_t k = 0; k < first.size(); ++k)
      for (Matrix::InnerIterator entry(lower_triangle, first[k]); entry; ++entry)
        if (const int other = node[static_cast<std::size_t>(entry.row())];
            other > static_cast<int>(k))
          work(k, static_cast<std::size_t>(other));
  };
  Graph graph;
  graph.starts.assign(first.size() + 1, 0);
  for_pairs(
    [&](const std::size_t one, const std::size_t other)
    {
      ++graph.starts[one + 1];
      ++graph.starts[other + 1];
    });
  std::partial_sum(graph.starts.begin(), graph.starts.end(), graph.starts.begin());
  graph.neighbours.resize(static_cast<std::size_t>(graph.starts.back()));
  std::vector<idx_t> next = graph.starts;
  for_pairs(
    [&](const std::size_t one, const std::size_t other)
    {
      graph.neighbours[static_cast<std::size_t>(next[one]++)]   = static_cast<idx_t>(other);
      graph.neighbours[static_cast<std::size_t>(next[other]++)] = static_cast<idx_t>(one);
    });
  for (std::size_t k = 0; k < first.size(); ++k)
    graph.sizes.push_back(
      (k + 1 < first.size() ? first[k + 1] : static_cast<int>(lower_triangle.cols())) - first[k]);
  return graph;
}

std::vector<idx_t> nested_dissection(Graph graph)
{
  auto n = static_cast<idx_t>(graph.sizes.size());
  std::vector<idx_t> order(graph.sizes.size()), places(graph.sizes.size());
  if (METIS_NodeND(&n, graph.starts.data(), graph.neighbours.data(), graph.sizes.data(), nullptr,
                   order.data(), places.data()) != METIS_OK)
    throw std::bad_alloc(); // what else METIS may fail of
  return order;
}
} // namespace

std::vector<int> elimination_order(const Matrix &lower_triangle)
{
  const std::vector<int> first = first_unknowns_of_nodes(lower_triangle);
  std::vector<int> order;
  order.reserve(static_cast<std::size_t>(lower_triangle.cols()));
  for (const idx_t node : nested_dissection(graph_of_nodes(lower_triangle, first)))
  {
    const auto next = static_cast<std::size_t>(node) + 1;
    const int end   = next < first.size() ? first[next] : static_cast<int>(lower_triangle.cols());
    for (int unknown = first[next - 1]; unknown < end; ++unknown)
      order.push_back(unknown);
  }
  return order;
}
} // namespace homespun::homogenization
