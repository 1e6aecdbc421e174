// SPDX-License-Identifier: MIT
#include "homogenization/edges/condensed_cell.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/index.h"
#include "meshes/plain/symmetric_eigen.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace homespun::homogenization
{
using meshes::at;

namespace
{
/// Stiffness of a row of cells, by joining a row to itself until fields that shrink by a thousandth
/// per cell have gone, or the row is so slender that a rigid motion of one end feels nothing but
/// rounding of the other.
SideStiffness long_row_of_cells(SideStiffness row, const Eigen::MatrixXd &rigid)
{
  constexpr int n_doublings = 12;
  const auto is_slender     = [&]()
  {
    const Eigen::Matrix2d of_rigid = rigid.transpose() * row.first * rigid;
    return meshes::symmetric_eigen<2>(of_rigid).values(0) < 1e-11 * row.first.norm();
  };
  for (int k = 0; k < n_doublings && !is_slender(); ++k)
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

/// A basis of what the columns span.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd &columns)
{
  return columns.householderQr().householderQ() *
         Eigen::MatrixXd::Identity(columns.rows(), columns.cols());
}

/// The largest |eigenvalue|, by |A^2m| / |A^m| = it^m for large m.
double spectral_radius(Eigen::MatrixXd power)
{
  constexpr int n_squares = 12; // a factor of 10 between the norms is 0.11 % then
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

Eigen::MatrixXd rounded_off(const Eigen::MatrixXd &stiffness, const Eigen::MatrixXd &rigid)
{
  Eigen::MatrixXd result = stiffness - stiffness * rigid * rigid.transpose();
  result -= (rigid * (rigid.transpose() * result)).eval();
  return 0.5 * (result + result.transpose());
}

Decay decay_of(const CondensedCell &cell)
{
  const SideStiffness &sides = cell.stiffness;
  const SideStiffness row    = long_row_of_cells(sides, cell.rigid);
  const Eigen::MatrixXd back = sides.across.transpose();
  // The other end of the row is held; let go, it follows rigid motions, which then feel nothing.
  const Eigen::MatrixXd &q    = cell.rigid;
  const Eigen::MatrixXd stiff = row.first * q;
  Eigen::MatrixXd half_strip =
    row.first - stiff * (q.transpose() * stiff).llt().solve(stiff.transpose());
  // Slender rows are rounded: a few more cells at the edge take that back, as they shrink fields.
  Eigen::MatrixXd step;
  for (int k = 0; k < 4; ++k)
  {
    step       = -(sides.second + half_strip).llt().solve(back);
    half_strip = rounded_off(sides.first + sides.across * step, q);
  }
  Decay decay;
  // Over the square roots of the diagonal: deflections and slopes have other units.
  const Eigen::VectorXd scale = (sides.first + sides.second).diagonal().cwiseSqrt().cwiseInverse();
  const auto size             = [&](const Eigen::MatrixXd &stiffness)
  { return (scale.asDiagonal() * stiffness * scale.asDiagonal()).norm(); };
  decay.residual = size(sides.across * step * step + (sides.first + sides.second) * step + back) /
                   size(sides.first);
  // Rigid motions go over into rigid motions: on what is left of the others X has all |l| < 1.
  Eigen::MatrixXd decaying = step - q * (q.transpose() * step);
  decaying -= (decaying * q * q.transpose()).eval();
  constexpr double round_off = 1e-13;
  decay.factor = decaying.norm() < round_off * step.norm() ? 0. : spectral_radius(decaying);
  constexpr double solved_to = 1e-6;
  if (!(decay.residual < solved_to) || !(decay.factor < 1. - 1e-3))
    throw meshes::NotConverged(
      "half strip at an edge: what decays along it is not told apart from what does not; the "
      "slowest shrinks by less than a thousandth per cell",
      {});
  return decay;
}

CondensedCell::CondensedCell(const CellElements &elements, const int axis, const StripElements &of)
    : elements(elements)
    , axis(axis)
    , dofs_of_shape(of.dofs_of_shape)
{
  number_dofs();
  std::vector<Eigen::Triplet<double>> entries;
  for (int t = 0; t < elements.n_triangles(); ++t)
  {
    const Eigen::MatrixXd matrix = of.stiffness(t);
    const std::vector<int> dofs  = dofs_of(t);
    for (int i = 0; i < matrix.rows(); ++i)
      for (int j = 0; j < matrix.cols(); ++j)
        entries.emplace_back(dofs[at(i)], dofs[at(j)], matrix(i, j));
  }
  condense(entries);
  rigid = orthonormal(of.rigid(*this));
}

std::vector<int> CondensedCell::dofs_of(const int triangle) const
{
  std::vector<int> dofs;
  for (int k = 0; k < elements.n_shapes(); ++k)
    for (int i = 0; i < dofs_of_shape[at(k)]; ++i)
      dofs.push_back(first_dof(elements.nodes(triangle, k)) + i);
  return dofs;
}

/// Two ends of lattice coordinate `axis`: what lies near 1 is the second side.
void CondensedCell::number_dofs()
{
  std::vector<int> dofs_of_class(at(elements.n_classes), 0);
  for (int t = 0; t < elements.n_triangles(); ++t)
    for (int k = 0; k < elements.n_shapes(); ++k)
      dofs_of_class[at(elements.class_of[at(elements.nodes(t, k))])] = dofs_of_shape[at(k)];
  std::vector<int> first_of_class;
  for (const int n : dofs_of_class)
  {
    first_of_class.push_back(n_glued);
    n_glued += n;
  }
  const double slack = 2. * meshes::image_tolerance;
  const auto n_nodes = static_cast<std::size_t>(elements.points.rows());
  std::vector<bool> is_second(n_nodes, false);
  std::vector<int> on_side(at(elements.n_classes), -1); // the first DoF of each class
  for (std::size_t node = 0; node < n_nodes; ++node)
  {
    const double f  = elements.fraction(elements.points.row(static_cast<Eigen::Index>(node)))(axis);
    is_second[node] = f >= 1. - slack;
    const auto of_class = at(elements.class_of[node]);
    if ((!is_second[node] && f > slack) || on_side[of_class] >= 0)
      continue;
    on_side[of_class] = n_side_dofs();
    for (int i = 0; i < dofs_of_class[of_class]; ++i)
      side.push_back(first_of_class[of_class] + i);
  }
  for (std::size_t node = 0; node < n_nodes; ++node)
  {
    const auto of_class = at(elements.class_of[node]);
    first_dof_of.push_back(is_second[node] ? n_glued + on_side[of_class]
                                           : first_of_class[of_class]);
  }
  place.assign(at(n_dofs()), 0);
  for (int k = 0; k < n_side_dofs(); ++k)
  {
    place[at(side[at(k)])] = -1 - k;
    place[at(n_glued + k)] = -1 - n_side_dofs() - k;
  }
  for (int &row : place)
    if (row >= 0)
      row = n_inner++;
}

void CondensedCell::condense(const std::vector<Eigen::Triplet<double>> &entries)
{
  const int n_outer     = 2 * n_side_dofs();
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
  coupling.resize(n_inner, n_outer);
  coupling.setFromTriplets(between.begin(), between.end());
  if (n_inner > 0)
  {
    Eigen::SparseMatrix<double> lower(n_inner, n_inner);
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
  Eigen::MatrixXd all(n_dofs(), first.cols());
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
  Eigen::VectorXd inner(n_inner), outer(2 * n_side_dofs());
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
