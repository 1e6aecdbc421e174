// SPDX-License-Identifier: MIT
#include "homogenization/edges/half_strip.h"

#include "meshes/plain/cell_edges.h"
#include "meshes/plain/errors.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace homespun::homogenization
{
namespace
{
EdgeFrame frame_of(const CondensedCell &cell, const bool is_far)
{
  const meshes::Lattice &lattice = cell.elements.cell.lattice;
  const Eigen::Vector2d edge     = lattice.vectors.row(1 - cell.axis).transpose();
  EdgeFrame frame;
  frame.length  = edge.norm();
  frame.period  = lattice.area() / frame.length;
  frame.along   = edge / frame.length;
  frame.inwards = {-frame.along(1), frame.along(0)};
  if ((lattice.vectors.row(cell.axis) * frame.inwards)(0) * (is_far ? -1. : 1.) < 0.)
    frame.inwards = -frame.inwards;
  return frame;
}

/// Cells until a mode has decayed to a part of itself, at least one.
int cells_until(const double left, const double factor)
{
  return factor > 0. ? std::max(1, static_cast<int>(std::ceil(std::log(left) / std::log(factor))))
                     : 1;
}
} // namespace

Eigen::Matrix<double, 2, 3> EdgeFrame::components(const Eigen::Vector2d &e) const
{
  Eigen::Matrix<double, 2, 3> rows;
  const auto row = [&](const Eigen::Vector2d &f)
  { return Eigen::RowVector3d(f(0) * e(0), f(1) * e(1), f(0) * e(1) + f(1) * e(0)); };
  rows << row(along), row(inwards);
  return rows;
}

HalfStrip::HalfStrip(const CondensedCell &cell, const int side)
    : cell(cell)
    , is_far(meshes::is_far_side(side))
    , frame(frame_of(cell, is_far))
    , sides(is_far ? cell.stiffness.turned() : cell.stiffness)
{
}

HalfStrip::Lines HalfStrip::followed(Eigen::MatrixXd first,
                                     const std::vector<Eigen::MatrixXd> &steps) const
{
  Lines lines = {std::move(first)};
  for (auto step = steps.rbegin(); step != steps.rend(); ++step)
    lines.push_back(*step * lines.back());
  return lines;
}

/// From the far end to the edge: with Z the stiffness of what lies beyond a line, the line before
/// it moves it by −(D_22 + Z)^-1 D_21 and feels Z' = D_11 − D_12 (D_22 + Z)^-1 D_21.
HalfStrip::Lines HalfStrip::held(const Eigen::MatrixXd &first, const int n_cells) const
{
  std::vector<Eigen::MatrixXd> steps;
  Eigen::MatrixXd beyond = Eigen::MatrixXd::Zero(cell.n_side_dofs(), cell.n_side_dofs());
  for (int k = 0; k < n_cells; ++k)
  {
    steps.push_back(-(sides.second + beyond).llt().solve(sides.across.transpose()));
    beyond = rounded_off(sides.first + sides.across * steps.back(), cell.rigid);
  }
  return followed(first, steps);
}

HalfStrip::Lines HalfStrip::loaded(const Eigen::MatrixXd &force, const int n_cells) const
{
  std::vector<Eigen::MatrixXd> steps = {
    Eigen::MatrixXd::Zero(cell.n_side_dofs(), cell.n_side_dofs())};
  Eigen::MatrixXd beyond = sides.first;
  for (int k = 1; k < n_cells; ++k)
  {
    steps.push_back(-(sides.second + beyond).llt().solve(sides.across.transpose()));
    beyond = sides.first + sides.across * steps.back();
    beyond = 0.5 * (beyond + beyond.transpose()).eval();
  }
  return followed(beyond.llt().solve(force), steps);
}

Eigen::MatrixXd HalfStrip::in_cell(const Lines &lines, const int k) const
{
  const auto index = static_cast<std::size_t>(k);
  return is_far ? cell.expanded(lines[index + 1], lines[index])
                : cell.expanded(lines[index], lines[index + 1]);
}

Eigen::MatrixXd HalfStrip::summed(const Eigen::MatrixXd &functionals, const Lines &lines) const
{
  const int n = cell.n_side_dofs();
  Eigen::MatrixXd of_sides(2 * n, functionals.cols());
  for (Eigen::Index i = 0; i < functionals.cols(); ++i)
    of_sides.col(i) = cell.condensed(functionals.col(i));
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(functionals.cols(), lines.front().cols());
  for (std::size_t k = 0; k + 1 < lines.size(); ++k)
    sum += of_sides.topRows(n).transpose() * lines[is_far ? k + 1 : k] +
           of_sides.bottomRows(n).transpose() * lines[is_far ? k : k + 1];
  return sum;
}

int cells_of_strip(const CondensedCell &cell, const EdgeOptions &options, const double factor)
{
  const int n_cells = cells_until(options.left_at_end, factor);
  if (n_cells <= options.most_cells)
    return 1 + n_cells;
  std::ostringstream text;
  text
    << cell.elements.cell.file << ": along axis " << cell.axis + 1
    << " what an edge does shrinks from cell to cell by a factor of " << factor << ", and would "
    << "need " << n_cells << " cells; expected at most " << options.most_cells
    << ": parts of such contrast reach too far; take a larger piece of the pattern as the cell, or "
       "less contrast";
  throw meshes::BadInput(text.str());
}

int lines_above(const Eigen::VectorXd &sizes, const HalfStrip::Lines &lines)
{
  int n = 0;
  for (std::size_t k = 0; k < lines.size(); ++k)
    if ((lines[k].cwiseAbs().rowwise().maxCoeff().array() > sizes.array()).any())
      n = static_cast<int>(k) + 1;
  return n;
}
} // namespace homespun::homogenization
