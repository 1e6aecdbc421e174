// SPDX-License-Identifier: MIT
#include "homogenization/edges/edge_layers.h"

#include "homogenization/bracket/bending_bracket.h"
#include "meshes/plain/errors.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace homespun::homogenization
{
namespace
{
/// What an edge of a cell looks like.
struct EdgeFrame
{
  Eigen::Vector2d along, inwards; ///< unit vectors t and n
  double length;                  ///< of one cell [m]
};

EdgeFrame frame_of(const CondensedCell &cell, const bool is_far)
{
  const Eigen::Matrix2d &vectors = cell.elements.cell.lattice.vectors;
  const Eigen::Vector2d edge     = vectors.row(1 - cell.axis).transpose();
  EdgeFrame frame;
  frame.length  = edge.norm();
  frame.along   = edge / frame.length;
  frame.inwards = {-frame.along(1), frame.along(0)};
  if ((vectors.row(cell.axis) * frame.inwards)(0) * (is_far ? -1. : 1.) < 0.)
    frame.inwards = -frame.inwards;
  return frame;
}

/// Rows that make t . sigma e and n . sigma e of a stress in Voigt order.
Eigen::Matrix<double, 2, 3> components(const EdgeFrame &frame, const Eigen::Vector2d &e)
{
  Eigen::Matrix<double, 2, 3> rows;
  const auto row = [&](const Eigen::Vector2d &f)
  { return Eigen::RowVector3d(f(0) * e(0), f(1) * e(1), f(0) * e(1) + f(1) * e(0)); };
  rows << row(frame.along), row(frame.inwards);
  return rows;
}

/// w_a at the nodes of a triangle (2 n,3) [m].
Eigen::MatrixXd w_of(const CellElements &elements, const ElementCellProblem &problem,
                     const int triangle)
{
  Eigen::MatrixXd w(2 * elements.n_shapes(), 3);
  for (int k = 0; k < elements.n_shapes(); ++k)
    w.middleRows<2>(2 * k) = problem.w.middleRows<2>(
      2 * elements.class_of[static_cast<std::size_t>(elements.nodes(triangle, k))]);
  return w;
}

/// The place of a point of quadrature.
Eigen::RowVector2d place_of(const CellElements &elements, const int triangle,
                            const ElementPoint &point)
{
  Eigen::RowVector2d place = Eigen::RowVector2d::Zero();
  for (int k = 0; k < elements.n_shapes(); ++k)
    place += point.values(k) * elements.points.row(elements.nodes(triangle, k));
  return place;
}
} // namespace

HalfStrip::HalfStrip(const CondensedCell &cell, const ElementCellProblem &problem, const int side)
    : cell(cell)
    , problem(problem)
    , is_far(meshes::is_far_side(side))
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
HalfStrip::Lines HalfStrip::clamped(const int n_cells) const
{
  std::vector<Eigen::MatrixXd> steps;
  Eigen::MatrixXd beyond = Eigen::MatrixXd::Zero(2 * cell.n_side(), 2 * cell.n_side());
  for (int k = 0; k < n_cells; ++k)
  {
    steps.push_back(-(sides.second + beyond).llt().solve(sides.across.transpose()));
    beyond = sides.first + sides.across * steps.back();
    beyond = 0.5 * (beyond + beyond.transpose()).eval();
  }
  Eigen::MatrixXd first(2 * cell.n_side(), 3);
  for (int k = 0; k < cell.n_side(); ++k)
    first.middleRows<2>(2 * k) =
      -problem.w.middleRows<2>(2 * cell.side[static_cast<std::size_t>(k)]);
  return followed(std::move(first), steps);
}

HalfStrip::Lines HalfStrip::free(const int n_cells) const
{
  const int n                        = 2 * cell.n_side();
  std::vector<Eigen::MatrixXd> steps = {Eigen::MatrixXd::Zero(n, n)};
  Eigen::MatrixXd beyond             = sides.first;
  for (int k = 1; k < n_cells; ++k)
  {
    steps.push_back(-(sides.second + beyond).llt().solve(sides.across.transpose()));
    beyond = sides.first + sides.across * steps.back();
    beyond = 0.5 * (beyond + beyond.transpose()).eval();
  }
  // Force on the edge: integral of sigma_a : eps(v) over the cell, and of Sigma_a n . v over the
  // edge, n inwards. Within the cell the first vanishes.
  const CellElements &elements = cell.elements;
  const EdgeFrame frame        = frame_of(cell, is_far);
  Eigen::MatrixXd excess       = Eigen::MatrixXd::Zero(2 * cell.n_strip_nodes(), 3);
  for (int t = 0; t < elements.n_triangles(); ++t)
  {
    const Eigen::MatrixXd w = w_of(elements, problem, t);
    for (const ElementPoint &point : elements.points_of(t))
    {
      const Eigen::MatrixXd forces = point.weight * point.strains.transpose() *
                                     elements.stiffness_of(t) *
                                     (Eigen::Matrix3d::Identity() + point.strains * w);
      for (int k = 0; k < elements.n_shapes(); ++k)
        excess.middleRows<2>(2 * cell.strip_node(t, k)) += forces.middleRows<2>(2 * k);
    }
  }
  Eigen::Matrix<double, 2, 3> traction; // Sigma_a n
  traction << components(frame, frame.inwards) * problem.stiffness;
  Eigen::Matrix2d axes;
  axes << frame.along, frame.inwards;
  traction                      = (axes * traction).eval();
  const Eigen::VectorXd lengths = elements.lengths_on_edge(cell.axis);
  Eigen::MatrixXd force(n, 3);
  for (int k = 0; k < cell.n_side(); ++k)
  {
    const int of_class         = cell.side[static_cast<std::size_t>(k)];
    const int node             = is_far ? elements.n_classes + k : of_class;
    force.middleRows<2>(2 * k) = -excess.middleRows<2>(2 * node) - lengths(of_class) * traction;
  }
  return followed(beyond.llt().solve(force), steps);
}

Eigen::Matrix<double, 2, 3> HalfStrip::slip(const Lines &clamped) const
{
  Eigen::Matrix<double, 2, 3> mean = Eigen::Matrix<double, 2, 3>::Zero();
  for (int k = 0; k < cell.n_side(); ++k)
    mean += clamped.back().middleRows<2>(2 * k) / cell.n_side();
  return mean;
}

Eigen::Matrix<double, 2, 3> HalfStrip::tension(const Lines &free) const
{
  // Of the cell far inside the part 1 − s counts, s from 0 to 1 across it; a whole cell has none.
  const CellElements &elements           = cell.elements;
  const EdgeFrame frame                  = frame_of(cell, is_far);
  const Eigen::Matrix<double, 2, 3> rows = components(frame, frame.along);
  Eigen::Matrix<double, 2, 3> of_cell =
    0.5 * elements.cell.lattice.area() * rows * problem.stiffness;
  Eigen::MatrixXd functional = Eigen::MatrixXd::Zero(2 * cell.n_strip_nodes(), 2);
  for (int t = 0; t < elements.n_triangles(); ++t)
  {
    const Eigen::MatrixXd w = w_of(elements, problem, t);
    for (const ElementPoint &point : elements.points_of(t))
    {
      const Eigen::MatrixXd stress_rows =
        point.weight * rows * elements.stiffness_of(t) * point.strains;
      const double fraction = elements.fraction(place_of(elements, t, point))(cell.axis);
      of_cell -= (is_far ? 1. - fraction : fraction) *
                 (point.weight * rows * elements.stiffness_of(t) + stress_rows * w);
      for (int k = 0; k < elements.n_shapes(); ++k)
        functional.middleRows<2>(2 * cell.strip_node(t, k)) +=
          stress_rows.middleCols<2>(2 * k).transpose();
    }
  }
  Eigen::MatrixXd of_sides(4 * cell.n_side(), 2);
  for (int i = 0; i < 2; ++i)
    of_sides.col(i) = cell.condensed(functional.col(i));
  const Eigen::MatrixXd of_low  = of_sides.topRows(2 * cell.n_side()).transpose(),
                        of_high = of_sides.bottomRows(2 * cell.n_side()).transpose();
  for (std::size_t k = 0; k + 1 < free.size(); ++k)
    of_cell += of_low * free[is_far ? k + 1 : k] + of_high * free[is_far ? k : k + 1];
  return of_cell / frame.length;
}

meshes::EdgeModes HalfStrip::at_vertices(const Lines &lines, const Eigen::Matrix<double, 2, 3> &far,
                                         const int n_cells) const
{
  const int n = cell.elements.cell.mesh.n_vertices();
  meshes::EdgeModes modes(n_cells * n, 6);
  for (int k = 0; k < n_cells; ++k)
  {
    const auto index          = static_cast<std::size_t>(k);
    const Eigen::MatrixXd all = is_far ? cell.expanded(lines[index + 1], lines[index])
                                       : cell.expanded(lines[index], lines[index + 1]);
    for (int v = 0; v < n; ++v)
      for (int a = 0; a < 3; ++a)
        modes.row(k * n + v).segment<2>(2 * a) =
          (all.middleRows<2>(2 * cell.strip_node(v)).col(a) - far.col(a)).transpose();
  }
  return modes;
}

std::array<Eigen::Matrix3d, 2> bulk_term(const CellElements &elements,
                                         const ElementCellProblem &problem)
{
  // <(sigma_c e_b).w_a>: rows a, columns c.
  std::array<Eigen::Matrix3d, 2> mean = {Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};
  for (int t = 0; t < elements.n_triangles(); ++t)
  {
    const Eigen::MatrixXd w = w_of(elements, problem, t);
    for (const ElementPoint &point : elements.points_of(t))
    {
      const Eigen::Matrix3d stress =
        elements.stiffness_of(t) * (Eigen::Matrix3d::Identity() + point.strains * w);
      Eigen::Matrix<double, 2, 3> value = Eigen::Matrix<double, 2, 3>::Zero();
      for (int k = 0; k < elements.n_shapes(); ++k)
        value += point.values(k) * w.middleRows<2>(2 * k);
      Eigen::Matrix<double, 2, 3> along_x, along_y;
      along_x << stress.row(0), stress.row(2);
      along_y << stress.row(2), stress.row(1);
      mean[0] += point.weight * value.transpose() * along_x;
      mean[1] += point.weight * value.transpose() * along_y;
    }
  }
  for (Eigen::Matrix3d &of_axis : mean)
    of_axis = ((of_axis - of_axis.transpose()) / elements.cell.lattice.area()).eval();
  return mean;
}

namespace
{
/// Cells until a mode has decayed to a part of itself, at least one.
int cells_until(const double left, const double factor)
{
  return factor > 0. ? std::max(1, static_cast<int>(std::ceil(std::log(left) / std::log(factor))))
                     : 1;
}

/// How many lines from the edge on hold a value above a size, what is far away taken off: loads
/// excite the slowest mode little or not at all, so that these are fewer than it would take.
int lines_above(const double size, const HalfStrip::Lines &lines,
                const Eigen::Matrix<double, 2, 3> &far)
{
  int n = 0;
  for (std::size_t k = 0; k < lines.size(); ++k)
    for (Eigen::Index row = 0; row < lines[k].rows(); row += 2)
      if ((lines[k].middleRows<2>(row) - far).cwiseAbs().maxCoeff() > size)
        n = static_cast<int>(k) + 1;
  return n;
}

void require_decay(const UnitCell &cell, const EdgeOptions &options, const int axis,
                   const double factor)
{
  const int n_cells = cells_until(options.left_at_end, factor);
  if (n_cells <= options.most_cells)
    return;
  std::ostringstream text;
  text
    << cell.file << ": along axis " << axis + 1
    << " what an edge does shrinks from cell to cell by a factor of " << factor << ", and would "
    << "need " << n_cells << " cells; expected at most " << options.most_cells
    << ": parts of such contrast reach too far; take a larger piece of the pattern as the cell, or "
       "less contrast";
  throw meshes::BadInput(text.str());
}
} // namespace

namespace
{
meshes::CellEdges edges_of_elements(const CellElements &elements, const EdgeOptions &options)
{
  const UnitCell &cell             = elements.cell;
  const ElementCellProblem problem = solve_cell(elements);
  meshes::CellEdges edges;
  edges.bulk                 = bulk_term(elements, problem);
  constexpr double round_off = 1e-12; // of a cell that does not fluctuate
  for (int axis = 0; axis < 2; ++axis)
  {
    const CondensedCell condensed(elements, axis);
    const double factor = decay_of(condensed.stiffness).factor;
    require_decay(cell, options, axis, factor);
    const int n_cells      = 1 + cells_until(options.left_at_end, factor);
    const double too_small = std::max(options.kept * problem.w.cwiseAbs().maxCoeff(),
                                      round_off * std::sqrt(cell.lattice.area()));
    for (const int side : {2 * axis, 2 * axis + 1})
    {
      const HalfStrip strip(condensed, problem, side);
      const HalfStrip::Lines clamped = strip.clamped(n_cells), free = strip.free(n_cells);
      const Eigen::Matrix<double, 2, 3> none = Eigen::Matrix<double, 2, 3>::Zero();
      meshes::CellEdge &edge                 = edges.sides[static_cast<std::size_t>(side)];
      edge.slip                              = strip.slip(clamped);
      edge.tension                           = strip.tension(free).row(0).transpose();
      edge.decay                             = factor;
      const int of_clamped                   = lines_above(too_small, clamped, edge.slip);
      const int of_free                      = lines_above(too_small, free, none);
      edge.n_cells = std::clamp(std::max(of_clamped, of_free), 1, n_cells);
      edge.clamped = strip.at_vertices(clamped, edge.slip, edge.n_cells);
      edge.free    = strip.at_vertices(free, none, edge.n_cells);
    }
  }
  return edges;
}
} // namespace

meshes::CellEdges edges_of(const UnitCell &cell, const EdgeOptions &options)
{
  return edges_of_elements(CellElements(cell, options.order), options);
}

meshes::CellEdges edges_of_plate(const UnitCell &cell, const EdgeOptions &options)
{
  const CellElements elements(cell, options.order,
                              analogous_membranes(cell.bending_stiffness_of_phase()));
  if (!rim_edges(elements.torus).empty())
    throw meshes::BadInput(cell.file + ": the cell has holes; the terms of edges of a plate are "
                                       "known for cells without");
  return edges_of_elements(elements, options);
}
} // namespace homespun::homogenization
