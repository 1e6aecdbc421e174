// SPDX-License-Identifier: MIT
#include "shell/algebra/free_vertex_matrix.h"

#include <Eigen/OrderingMethods>

#include <algorithm>

namespace homespun::shell
{
namespace
{
/// Places of the vertices in the order in which the free ones come, −1 where held.
std::vector<int> places_as_they_come(const std::vector<bool> &is_held)
{
  std::vector<int> place(is_held.size(), -1);
  int n_free = 0;
  for (std::size_t v = 0; v < is_held.size(); ++v)
    if (!is_held[v])
      place[v] = n_free++;
  return place;
}

/// Which free vertices have a side in common. This graph is dim^2 times smaller than that of the
/// unknowns, with the same order.
Eigen::SparseMatrix<double> graph_of(const meshes::Triangles &triangles,
                                     const std::vector<int> &place, const int n_free)
{
  std::vector<Eigen::Triplet<double>> edges;
  for (int v = 0; v < n_free; ++v)
    edges.emplace_back(v, v, 1.);
  for (int t = 0; t < static_cast<int>(triangles.rows()); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int a = place[static_cast<std::size_t>(triangles(t, k))],
                b = place[static_cast<std::size_t>(triangles(t, (k + 1) % 3))];
      if (a >= 0 && b >= 0)
      {
        edges.emplace_back(a, b, 1.);
        edges.emplace_back(b, a, 1.);
      }
    }
  Eigen::SparseMatrix<double> graph(n_free, n_free);
  graph.setFromTriplets(edges.begin(), edges.end());
  return graph;
}

/// The places above each in its column of vertex blocks, ascending, in a fill-reducing order.
/// @param place as the vertices come; here they are put into that order
std::vector<std::vector<int>> reorder(const Eigen::SparseMatrix<double> &graph,
                                      std::vector<int> &place)
{
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  if (graph.rows() > 0)
    Eigen::AMDOrdering<int>()(graph, order); // order.indices()(new place) = old place
  std::vector<int> new_place(static_cast<std::size_t>(graph.rows()));
  for (int p = 0; p < static_cast<int>(graph.rows()); ++p)
    new_place[static_cast<std::size_t>(order.indices()(p))] = p;
  for (int &p : place)
    if (p >= 0)
      p = new_place[static_cast<std::size_t>(p)];
  std::vector<std::vector<int>> above(new_place.size());
  for (int column = 0; column < static_cast<int>(graph.cols()); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(graph, column); entry; ++entry)
    {
      const int a = new_place[static_cast<std::size_t>(entry.row())],
                b = new_place[static_cast<std::size_t>(entry.col())];
      if (a < b)
        above[static_cast<std::size_t>(b)].push_back(a);
    }
  for (std::vector<int> &rows : above)
    std::sort(rows.begin(), rows.end());
  return above;
}

/// The upper half, all zero.
template <int dim>
Eigen::SparseMatrix<double> upper_half(const std::vector<std::vector<int>> &above)
{
  const auto n_free      = static_cast<int>(above.size());
  Eigen::Index n_entries = 0;
  for (const std::vector<int> &rows : above)
    n_entries += static_cast<Eigen::Index>(rows.size()) * dim * dim + dim * (dim + 1) / 2;
  Eigen::SparseMatrix<double> upper(dim * n_free, dim * n_free);
  upper.reserve(n_entries);
  for (int column = 0; column < n_free; ++column)
    for (int j = 0; j < dim; ++j)
    {
      upper.startVec(dim * column + j);
      for (const int row : above[static_cast<std::size_t>(column)])
        for (int i = 0; i < dim; ++i)
          upper.insertBack(dim * row + i, dim * column + j) = 0.;
      for (int i = 0; i <= j; ++i)
        upper.insertBack(dim * column + i, dim * column + j) = 0.;
    }
  upper.finalize();
  return upper;
}
} // namespace

template <int dim>
FreeVertexMatrix<dim>::FreeVertexMatrix(const meshes::Triangles &triangles,
                                        const std::vector<bool> &is_held)
    : triangles(triangles)
    , place(places_as_they_come(is_held))
    , block_row(static_cast<std::size_t>(3 * triangles.rows()), -1)
{
  const auto n_free = static_cast<int>(std::count(is_held.begin(), is_held.end(), false));
  const std::vector<std::vector<int>> above = reorder(graph_of(triangles, place, n_free), place);
  upper                                     = upper_half<dim>(above);
  for (int t = 0; t < static_cast<int>(triangles.rows()); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int a = place[static_cast<std::size_t>(triangles(t, k))],
                b = place[static_cast<std::size_t>(triangles(t, (k + 1) % 3))];
      if (a < 0 || b < 0)
        continue;
      const std::vector<int> &rows = above[static_cast<std::size_t>(std::max(a, b))];
      block_row[static_cast<std::size_t>(3 * t + k)] =
        static_cast<int>(std::lower_bound(rows.begin(), rows.end(), std::min(a, b)) - rows.begin());
    }
  if (n_free > 0)
    factor.analyzePattern(upper);
}

template <int dim>
void FreeVertexMatrix<dim>::clear()
{
  std::fill_n(upper.valuePtr(), upper.nonZeros(), 0.);
}

template <int dim>
void FreeVertexMatrix<dim>::add(const int triangle, const Element &element)
{
  double *const values     = upper.valuePtr();
  const int *const columns = upper.outerIndexPtr();
  for (int k = 0; k < 3; ++k)
  {
    const int next = (k + 1) % 3;
    const int a    = place[static_cast<std::size_t>(triangles(triangle, k))],
              b    = place[static_cast<std::size_t>(triangles(triangle, next))];
    if (a < 0)
      continue;
    for (int j = 0; j < dim; ++j)
    {
      double *const diagonal = values + columns[dim * a + j + 1] - 1 - j;
      for (int i = 0; i <= j; ++i)
        diagonal[i] += element(k * dim + i, k * dim + j);
    }
    if (b < 0)
      continue;
    const int row_corner = a < b ? k : next, column_corner = a < b ? next : k;
    const int column = std::max(a, b);
    const int row    = dim * block_row[static_cast<std::size_t>(3 * triangle + k)];
    for (int j = 0; j < dim; ++j)
    {
      double *const block = values + columns[dim * column + j] + row;
      for (int i = 0; i < dim; ++i)
        block[i] += element(row_corner * dim + i, column_corner * dim + j);
    }
  }
}

template <int dim>
bool FreeVertexMatrix<dim>::factorize(const double shift)
{
  if (n_unknowns() == 0)
    return true;
  factor.setShift(shift);
  factor.factorize(upper);
  if (factor.info() != Eigen::Success)
    return false;
  // A pivot is positive and no larger than its diagonal entry where the matrix is positive
  // definite; one that has lost all its digits to cancellation is not trusted.
  const Eigen::VectorXd pivots = factor.vectorD();
  for (int c = 0; c < n_unknowns(); ++c)
    if (!(pivots(c) > 1e-14 * (upper.valuePtr()[upper.outerIndexPtr()[c + 1] - 1] + shift)) ||
        !(pivots(c) > 0.))
      return false;
  return true;
}

template <int dim>
typename FreeVertexMatrix<dim>::Rows FreeVertexMatrix<dim>::solve(const Rows &right_side) const
{
  if (n_unknowns() == 0)
    return Rows::Zero(right_side.rows(), dim);
  return scatter(factor.solve(gather(right_side)));
}

template <int dim>
typename FreeVertexMatrix<dim>::Rows FreeVertexMatrix<dim>::multiply(const Rows &rows) const
{
  return scatter(upper.template selfadjointView<Eigen::Upper>() * gather(rows));
}

template <int dim>
double FreeVertexMatrix<dim>::mean_diagonal() const
{
  double sum = 0.;
  for (int c = 0; c < n_unknowns(); ++c)
    sum += upper.valuePtr()[upper.outerIndexPtr()[c + 1] - 1];
  return n_unknowns() > 0 ? sum / n_unknowns() : 0.;
}

template <int dim>
int FreeVertexMatrix<dim>::n_unknowns() const
{
  return static_cast<int>(upper.rows());
}

template <int dim>
Eigen::Index FreeVertexMatrix<dim>::n_factor_entries() const
{
  return n_unknowns() > 0 ? factor.matrixL().nestedExpression().nonZeros() : 0;
}

template <int dim>
Eigen::VectorXd FreeVertexMatrix<dim>::gather(const Rows &rows) const
{
  Eigen::VectorXd unknowns(n_unknowns());
  for (std::size_t v = 0; v < place.size(); ++v)
    if (place[v] >= 0)
      unknowns.segment<dim>(dim * place[v]) = rows.row(static_cast<Eigen::Index>(v)).transpose();
  return unknowns;
}

template <int dim>
typename FreeVertexMatrix<dim>::Rows
FreeVertexMatrix<dim>::scatter(const Eigen::VectorXd &unknowns) const
{
  Rows rows = Rows::Zero(static_cast<Eigen::Index>(place.size()), dim);
  for (std::size_t v = 0; v < place.size(); ++v)
    if (place[v] >= 0)
      rows.row(static_cast<Eigen::Index>(v)) = unknowns.segment<dim>(dim * place[v]).transpose();
  return rows;
}

template class FreeVertexMatrix<2>;
template class FreeVertexMatrix<3>;
} // namespace homespun::shell
