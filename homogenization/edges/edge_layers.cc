// SPDX-License-Identifier: MIT
#include "homogenization/edges/edge_layers.h"

#include "meshes/plain/index.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace homespun::homogenization
{
using meshes::at;

namespace
{
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

Eigen::MatrixXd translations(const CondensedCell &cell)
{
  return Eigen::Matrix2d::Identity().replicate(cell.n_side_dofs() / 2, 1);
}

} // namespace

StripElements elements_of_membrane(const CellElements &elements)
{
  const auto stiffness = [&elements](const int t)
  {
    const int n            = 2 * elements.n_shapes();
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
    for (const ElementPoint &point : elements.points_of(t))
      matrix += point.weight * point.strains.transpose() * elements.stiffness_of(t) * point.strains;
    return matrix;
  };
  return {std::vector<int>(at(elements.n_shapes()), 2), stiffness, translations};
}

MembraneStrip::MembraneStrip(const CondensedCell &cell, const ElementCellProblem &problem,
                             const int side)
    : HalfStrip(cell, side)
    , problem(problem)
{
}

HalfStrip::Lines MembraneStrip::clamped(const int n_cells) const
{
  Eigen::MatrixXd first(cell.n_side_dofs(), 3);
  for (int k = 0; k < cell.n_side_dofs(); ++k)
    first.row(k) = -problem.w.row(cell.side[at(k)]);
  return held(first, n_cells);
}

HalfStrip::Lines MembraneStrip::free(const int n_cells) const
{
  // Force on the edge: integral of sigma_a : eps(v) over the cell, and of Sigma_a n . v over the
  // edge, n inwards. Within the cell the first vanishes.
  const CellElements &elements = cell.elements;
  Eigen::MatrixXd excess       = Eigen::MatrixXd::Zero(cell.n_dofs(), 3);
  for (int t = 0; t < elements.n_triangles(); ++t)
  {
    const Eigen::MatrixXd w     = w_of(elements, problem, t);
    const std::vector<int> dofs = cell.dofs_of(t);
    for (const ElementPoint &point : elements.points_of(t))
    {
      const Eigen::MatrixXd forces = point.weight * point.strains.transpose() *
                                     elements.stiffness_of(t) *
                                     (Eigen::Matrix3d::Identity() + point.strains * w);
      for (int k = 0; k < forces.rows(); ++k)
        excess.row(dofs[at(k)]) += forces.row(k);
    }
  }
  Eigen::Matrix2d axes;
  axes << frame.along, frame.inwards;
  const Eigen::Matrix<double, 2, 3> traction = // Sigma_a n
    axes * frame.components(frame.inwards) * problem.stiffness;
  const Eigen::VectorXd lengths = elements.lengths_on_edge(cell.axis);
  Eigen::MatrixXd force(cell.n_side_dofs(), 3);
  for (int k = 0; k < cell.n_side_dofs(); ++k)
  {
    const int glued = cell.side[at(k)];
    force.row(k)    = -excess.row(edge_dof(k)) - lengths(glued / 2) * traction.row(glued % 2);
  }
  return loaded(force, n_cells);
}

Eigen::Matrix<double, 2, 3> MembraneStrip::slip(const Lines &clamped) const
{
  const Eigen::MatrixXd moves = translations(cell);
  return moves.transpose() * clamped.back() / (0.5 * cell.n_side_dofs());
}

Eigen::Matrix<double, 2, 3> MembraneStrip::tension(const Lines &free) const
{
  // Of the cell far inside the part 1 − s counts, s from 0 to 1 across it; a whole cell has none.
  const CellElements &elements           = cell.elements;
  const Eigen::Matrix<double, 2, 3> rows = frame.components(frame.along);
  Eigen::Matrix<double, 2, 3> of_cell =
    0.5 * elements.cell.lattice.area() * rows * problem.stiffness;
  Eigen::MatrixXd functional = Eigen::MatrixXd::Zero(cell.n_dofs(), 2);
  for (int t = 0; t < elements.n_triangles(); ++t)
  {
    const Eigen::MatrixXd w     = w_of(elements, problem, t);
    const std::vector<int> dofs = cell.dofs_of(t);
    for (const ElementPoint &point : elements.points_of(t))
    {
      const Eigen::MatrixXd stress_rows =
        point.weight * rows * elements.stiffness_of(t) * point.strains;
      of_cell -= depth(place_of(elements, t, point)) *
                 (point.weight * rows * elements.stiffness_of(t) + stress_rows * w);
      for (int k = 0; k < stress_rows.cols(); ++k)
        functional.row(dofs[at(k)]) += stress_rows.col(k).transpose();
    }
  }
  return (of_cell + summed(functional, free)) / frame.length;
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

meshes::CellEdges edges_of(const UnitCell &cell, const EdgeOptions &options)
{
  const CellElements elements(cell, options.order);
  const ElementCellProblem problem = solve_cell(elements);
  meshes::CellEdges edges;
  edges.bulk                 = bulk_term(elements, problem);
  constexpr double round_off = 1e-12; // of a cell that does not fluctuate
  for (int axis = 0; axis < 2; ++axis)
  {
    const CondensedCell condensed(elements, axis, elements_of_membrane(elements));
    const Eigen::MatrixXd moves     = translations(condensed);
    const double factor             = decay_of(condensed).factor;
    const int n_cells               = cells_of_strip(condensed, options, factor);
    const Eigen::VectorXd too_small = Eigen::VectorXd::Constant(
      condensed.n_side_dofs(), std::max(options.kept * problem.w.cwiseAbs().maxCoeff(),
                                        round_off * std::sqrt(cell.lattice.area())));
    for (const int side : {2 * axis, 2 * axis + 1})
    {
      const MembraneStrip strip(condensed, problem, side);
      HalfStrip::Lines clamped    = strip.clamped(n_cells);
      const HalfStrip::Lines free = strip.free(n_cells);
      meshes::CellEdge &edge      = edges.sides[at(side)];
      edge.slip                   = strip.slip(clamped);
      edge.tension                = strip.tension(free).row(0).transpose();
      edge.decay                  = factor;
      for (Eigen::MatrixXd &line : clamped)
        line -= moves * edge.slip;
      const int n_lines = std::max(lines_above(too_small, clamped), lines_above(too_small, free));
      edge.n_cells      = std::clamp(n_lines, 1, n_cells);
      edge.clamped      = strip.at_vertices<2>(clamped, edge.n_cells);
      edge.free         = strip.at_vertices<2>(free, edge.n_cells);
    }
  }
  return edges;
}
} // namespace homespun::homogenization
