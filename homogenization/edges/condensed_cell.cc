// SPDX-License-Identifier: MIT
#include "homogenization/edges/condensed_cell.h"

#include "meshes/plain/errors.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace homespun::homogenization
{
namespace
{
/// Stiffness of a row of 2^n cells, by joining a row to itself n times.
SideStiffness row_of_cells(SideStiffness row, const int n)
{
  for (int k = 0; k < n; ++k)
  {
    const Eigen::LLT<Eigen::MatrixXd> joint(row.first + row.second);
    if (joint.info() != Eigen::Success)
      throw meshes::NotConverged("half strip at an edge: a part of the cell has no stiffness", {});
    const Eigen::MatrixXd forth = joint.solve(row.across),
                          back  = joint.solve(row.across.transpose());
    row.first -= row.across * back;
    row.second -= row.across.transpose() * forth;
    row.across = (-row.across * forth).eval();
  }
  return row;
}

/// The largest |eigenvalue|, by |A^2m| / |A^m| = it^m for large m.
double spectral_radius(Eigen::MatrixXd power)
{
  constexpr int n_squares = 12; // a factor of 10 between the norms is 0.06 % then
  double log_norm = 0., log_radius = 0.;
  for (int k = 0; k <= n_squares; ++k)
  {
    const double norm = power.norm();
    if (!(norm > 1e-100))
      return 0.;
    power /= norm;
    const double before = log_norm; // of A^(2^(k−1))
    log_norm            = (k == 0 ? 0. : 2. * before) + std::log(norm);
    log_radius          = k == 0 ? log_norm : (log_norm - before) / std::ldexp(1., k - 1);
    power               = (power * power).eval();
  }
  return std::exp(log_radius);
}
} // namespace

Decay decay_of(const SideStiffness &sides)
{
  constexpr int n_doublings  = 12; // fields that shrink by a thousandth per cell have gone
  const SideStiffness row    = row_of_cells(sides, n_doublings);
  const Eigen::MatrixXd back = sides.across.transpose();
  const Eigen::MatrixXd half_strip =
    row.first - row.across * row.second.llt().solve(row.across.transpose());
  const Eigen::MatrixXd step = -(sides.second + half_strip).llt().solve(back);
  Decay decay;
  decay.residual =
    (sides.across * step * step + (sides.first + sides.second) * step + back).norm() /
    sides.first.norm();
  Eigen::MatrixXd translations = step; // far away nothing else is left
  for (int k = 0; k < n_doublings; ++k)
    translations = (translations * translations).eval();
  const Eigen::MatrixXd decaying = step - translations;
  constexpr double round_off     = 1e-13;
  decay.factor = decaying.norm() < round_off * step.norm() ? 0. : spectral_radius(decaying);
  constexpr double solved_to = 1e-6;
  if (!(decay.residual < solved_to) || !(decay.factor < 1. - 1e-3))
    throw meshes::NotConverged(
      "half strip at an edge: what decays along it is not told apart from what does not; the "
      "slowest shrinks by less than a thousandth per cell",
      {});
  return decay;
}

CondensedCell::CondensedCell(const CellElements &elements, const int axis)
    : elements(elements)
    , axis(axis)
{
  number_nodes();
  std::vector<Eigen::Triplet<double>> entries;
  for (int t = 0; t < elements.n_triangles(); ++t)
  {
    Eigen::MatrixXd matrix =
      Eigen::MatrixXd::Zero(2 * elements.n_shapes(), 2 * elements.n_shapes());
    for (const ElementPoint &point : elements.points_of(t))
      matrix += point.weight * point.strains.transpose() * elements.stiffness_of(t) * point.strains;
    for (int i = 0; i < matrix.rows(); ++i)
      for (int j = 0; j < matrix.cols(); ++j)
        entries.emplace_back(2 * strip_node(t, i / 2) + i % 2, 2 * strip_node(t, j / 2) + j % 2,
                             matrix(i, j));
  }
  condense(entries);
}

/// Two ends of lattice coordinate `axis`: what lies near 1 is the second side.
void CondensedCell::number_nodes()
{
  const double slack = 2. * meshes::image_tolerance;
  const auto n_nodes = static_cast<std::size_t>(elements.points.rows());
  std::vector<bool> is_second(n_nodes, false);
  std::vector<int> on_side(static_cast<std::size_t>(elements.n_classes), -1); // of each class
  for (std::size_t node = 0; node < n_nodes; ++node)
  {
    const double f  = elements.fraction(elements.points.row(static_cast<Eigen::Index>(node)))(axis);
    is_second[node] = f >= 1. - slack;
    int &place      = on_side[static_cast<std::size_t>(elements.class_of[node])];
    if ((is_second[node] || f <= slack) && place < 0)
    {
      place = n_side();
      side.push_back(elements.class_of[node]);
    }
  }
  strip_node_of.resize(n_nodes);
  for (std::size_t node = 0; node < n_nodes; ++node)
  {
    const int of_class = elements.class_of[node];
    strip_node_of[node] =
      is_second[node] ? elements.n_classes + on_side[static_cast<std::size_t>(of_class)] : of_class;
  }
  for (int node = 0; node < n_strip_nodes(); ++node)
  {
    const int first = node < elements.n_classes ? on_side[static_cast<std::size_t>(node)] : -1;
    const int outer = node < elements.n_classes ? first : n_side() + node - elements.n_classes;
    for (int c = 0; c < 2; ++c)
      place.push_back(outer >= 0 ? -1 - (2 * outer + c) : 2 * n_inner + c);
    n_inner += outer < 0 ? 1 : 0;
  }
}

void CondensedCell::condense(const std::vector<Eigen::Triplet<double>> &entries)
{
  const int n_outer     = 4 * n_side();
  Eigen::MatrixXd outer = Eigen::MatrixXd::Zero(n_outer, n_outer);
  std::vector<Eigen::Triplet<double>> within, between;
  for (const Eigen::Triplet<double> &entry : entries)
  {
    const int i = place[static_cast<std::size_t>(entry.row())],
              j = place[static_cast<std::size_t>(entry.col())];
    if (i < 0 && j < 0)
      outer(-1 - i, -1 - j) += entry.value();
    else if (i >= 0 && j < 0)
      between.emplace_back(i, -1 - j, entry.value());
    else if (i >= 0 && i >= j)
      within.emplace_back(i, j, entry.value());
  }
  coupling.resize(2 * n_inner, n_outer);
  coupling.setFromTriplets(between.begin(), between.end());
  if (n_inner > 0)
  {
    Eigen::SparseMatrix<double> lower(2 * n_inner, 2 * n_inner);
    lower.setFromTriplets(within.begin(), within.end());
    factor = std::make_unique<CholeskyFactor>(lower, elements.cell.file + ": half strip");
    constexpr int at_once = 64; // columns, so that memory stays small
    for (int begin = 0; begin < n_outer; begin += at_once)
    {
      const int n = std::min(at_once, n_outer - begin);
      outer.middleCols(begin, n) -=
        coupling.transpose() * factor->solve(Eigen::MatrixXd(coupling.middleCols(begin, n)));
    }
  }
  outer          = 0.5 * (outer + outer.transpose()).eval();
  const int half = n_outer / 2;
  stiffness      = {outer.topLeftCorner(half, half), outer.topRightCorner(half, half),
                    outer.bottomRightCorner(half, half)};
}

Eigen::MatrixXd CondensedCell::expanded(const Eigen::MatrixXd &first,
                                        const Eigen::MatrixXd &second) const
{
  Eigen::MatrixXd outer(first.rows() + second.rows(), first.cols());
  outer << first, second;
  Eigen::MatrixXd inner;
  if (factor)
    inner = -factor->solve(Eigen::MatrixXd(coupling * outer));
  Eigen::MatrixXd all(2 * n_strip_nodes(), first.cols());
  for (int dof = 0; dof < all.rows(); ++dof)
  {
    const int row = place[static_cast<std::size_t>(dof)];
    if (row >= 0)
      all.row(dof) = inner.row(row);
    else
      all.row(dof) = outer.row(-1 - row);
  }
  return all;
}

Eigen::VectorXd CondensedCell::condensed(const Eigen::VectorXd &functional) const
{
  Eigen::VectorXd inner(2 * n_inner), outer(4 * n_side());
  for (int dof = 0; dof < functional.size(); ++dof)
  {
    const int row = place[static_cast<std::size_t>(dof)];
    if (row >= 0)
      inner(row) = functional(dof);
    else
      outer(-1 - row) = functional(dof);
  }
  if (factor)
    outer -= coupling.transpose() * factor->solve(inner);
  return outer;
}
} // namespace homespun::homogenization
