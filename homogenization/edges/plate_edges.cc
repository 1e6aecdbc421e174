// SPDX-License-Identifier: MIT
#include "homogenization/edges/plate_edges.h"

#include "homogenization/bracket/clough_tocher.h"
#include "homogenization/bracket/equilibrated_stress.h"
#include "homogenization/bracket/plate.h"
#include "meshes/plain/index.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace homespun::homogenization
{
using meshes::at;

namespace
{
/// The cell problem of a plate on the nodes of a strip.
struct PlateProblem
{
  explicit PlateProblem(const UnitCell &cell);

  /// M_a at a field point of a triangle, rows 11, 22, 12 [N].
  /// @param kappa of its shapes there
  Eigen::Matrix3d moments(int triangle, const Eigen::Matrix<double, 3, 12> &kappa) const;

  const CellElements elements; ///< their nodes alone
  const ThinPlate plate;
  const PlateCell solved;
};

/// What the cell problem makes of a row of cells at an edge: a plate's.
class PlateStrip : public HalfStrip
{
public:
  /// @param cell condensed with elements_of_plate()
  PlateStrip(const CondensedCell &cell, const PlateProblem &problem, int side);

  Lines clamped(int n_cells) const; ///< phi_a with no force on the other end
  Lines free(int n_cells) const;    ///< phi_a with the other end held

  /// c_a and b_a, the means of the last line.
  AffineDeflection far(const Lines &clamped) const;

  /// It is taken off.
  Lines without(const AffineDeflection &far, Lines lines) const;

  /// Of a free edge, columns a, rows m_a tt and tn (2,3) [N m^2].
  Eigen::Matrix<double, 2, 3> moment(const Lines &free) const;

private:
  Eigen::VectorXd moment_on_edge() const;

  const PlateProblem &problem;
};

/// What a DoF of the glued plate is: w, w,1, w,2 of a vertex, or the slope along a side's normal.
struct DofKind
{
  int of_vertex; ///< 0, 1, 2; −1: of a side
  int side;
};

DofKind kind_of(const ThinPlate &plate, const int dof)
{
  const int n_of_vertices = plate.dof_of_side(0);
  return dof < n_of_vertices ? DofKind{dof % 3, -1} : DofKind{-1, dof - n_of_vertices};
}

/// Deflections without curvature on a side of a cell, by their gradients and values there.
/// @param gradient rows: of each load @param values of each load
Eigen::MatrixXd without_curvature(const CondensedCell &cell, const ThinPlate &plate,
                                  const Eigen::MatrixX2d &gradient,
                                  const Eigen::RowVectorXd &values)
{
  Eigen::MatrixXd line(cell.n_side_dofs(), values.cols());
  for (int k = 0; k < cell.n_side_dofs(); ++k)
  {
    const auto [of_vertex, side] = kind_of(plate, cell.side[at(k)]);
    if (of_vertex == 0)
      line.row(k) = values;
    else if (of_vertex > 0)
      line.row(k) = gradient.col(of_vertex - 1).transpose();
    else
      line.row(k) = (gradient * plate.mesh.normals[at(side)]).transpose();
  }
  return line;
}

/// (12,3) of a triangle.
Eigen::Matrix<double, 12, 3> deflection_of(const PlateProblem &problem, const int triangle)
{
  const auto dofs = problem.plate.dofs_of(triangle);
  Eigen::Matrix<double, 12, 3> local;
  for (int k = 0; k < 12; ++k)
    local.row(k) = problem.solved.deflection.row(dofs[at(k)]);
  return local;
}

/// kappa of the shapes at each field point of a triangle.
template <typename Visit>
void at_field_points(const ThinPlate &plate, const int triangle, Visit &&visit)
{
  const Eigen::Matrix<double, 27, 12> rows = plate.curvatures(triangle);
  for (int q = 0; q < n_field_points; ++q)
    visit(Eigen::Matrix<double, 3, 12>(rows.middleRows<3>(3 * q)),
          field_points()[at(q)].in_triangle);
}

PlateProblem::PlateProblem(const UnitCell &cell)
    : elements(cell, 2)
    , plate(PlateMesh(elements.torus), cell.bending_stiffness_of_phase())
    , solved(solve_plate_cell(elements.torus, plate.bending_stiffness_of_material))
{
}

Eigen::Matrix3d PlateProblem::moments(const int triangle,
                                      const Eigen::Matrix<double, 3, 12> &kappa) const
{
  return plate.bending_stiffness_of_material[at(plate.mesh.triangles[at(triangle)].material)] *
         (Eigen::Matrix3d::Identity() + kappa * deflection_of(*this, triangle));
}

/// Clough-Tocher triangles, for CondensedCell [N m, with the powers of m of their DoFs].
StripElements elements_of_plate(const PlateProblem &problem)
{
  const auto rigid = [&problem](const CondensedCell &cell)
  {
    const Eigen::RowVector2d along =
      problem.elements.cell.lattice.vectors.row(1 - cell.axis).normalized();
    Eigen::Matrix2d gradient; // of a translation, and of a turn about the side
    gradient << 0., 0., -along(1), along(0);
    return without_curvature(cell, problem.plate, gradient, Eigen::RowVector2d(1., 0.));
  };
  return {{3, 3, 3, 1, 1, 1},
          [&problem](const int t) -> Eigen::MatrixXd { return problem.plate.stiffness(t); },
          rigid};
}

PlateStrip::PlateStrip(const CondensedCell &cell, const PlateProblem &problem, const int side)
    : HalfStrip(cell, side)
    , problem(problem)
{
}

HalfStrip::Lines PlateStrip::clamped(const int n_cells) const
{
  Eigen::MatrixXd first(cell.n_side_dofs(), 3);
  for (int k = 0; k < cell.n_side_dofs(); ++k)
    first.row(k) = -problem.solved.deflection.row(cell.side[at(k)]);
  return held(first, n_cells);
}

/// integral dv/dn along the edge, n inwards, of the cell's DoFs.
Eigen::VectorXd PlateStrip::moment_on_edge() const
{
  const CellElements &elements = problem.elements;
  Eigen::VectorXd integral     = Eigen::VectorXd::Zero(cell.n_dofs());
  const auto is_on             = [&](const int node)
  { return depth(elements.points.row(node)) < 2. * meshes::image_tolerance; };
  for (int t = 0; t < elements.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int from = elements.nodes(t, k), to = elements.nodes(t, (k + 1) % 3);
      if (!is_on(from) || !is_on(to))
        continue;
      const double its = (elements.points.row(to) - elements.points.row(from)).norm();
      for (const int node : {from, to})
        integral.segment<2>(cell.first_dof(node) + 1) += its / 6. * frame.inwards;
      const Eigen::Vector2d &normal =
        problem.plate.mesh.normals[at(problem.plate.mesh.triangles[at(t)].sides[at(k)])];
      integral(cell.first_dof(elements.nodes(t, 3 + k))) +=
        its * 2. / 3. * normal.dot(frame.inwards);
    }
  return integral;
}

HalfStrip::Lines PlateStrip::free(const int n_cells) const
{
  // integral of M_a : kappa(v) over the cell, which vanishes within, and of the moment of the
  // homogenized plate along the edge.
  Eigen::MatrixXd excess = Eigen::MatrixXd::Zero(cell.n_dofs(), 3);
  for (int t = 0; t < problem.elements.n_triangles(); ++t)
  {
    Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(12, 3);
    at_field_points(problem.plate, t,
                    [&](const auto &kappa, const auto &)
                    { forces += kappa.transpose() * problem.moments(t, kappa); });
    const std::vector<int> dofs = cell.dofs_of(t);
    for (int k = 0; k < 12; ++k)
      excess.row(dofs[at(k)]) += problem.plate.area(t) / n_field_points * forces.row(k);
  }
  excess += moment_on_edge() * frame.components(frame.inwards).row(1) * problem.solved.stiffness;
  Eigen::MatrixXd force(cell.n_side_dofs(), 3);
  for (int k = 0; k < cell.n_side_dofs(); ++k)
    force.row(k) = -excess.row(edge_dof(k));
  return loaded(force, n_cells);
}

AffineDeflection PlateStrip::far(const Lines &clamped) const
{
  AffineDeflection mean = {Eigen::RowVector3d::Zero(), Eigen::RowVector3d::Zero()};
  int n                 = 0;
  for (int k = 0; k < cell.n_side_dofs(); ++k)
  {
    const int of_vertex = kind_of(problem.plate, cell.side[at(k)]).of_vertex;
    if (of_vertex == 0)
    {
      mean.value += clamped.back().row(k);
      ++n;
    }
    else if (of_vertex > 0)
      mean.slope += frame.inwards(of_vertex - 1) * clamped.back().row(k);
  }
  mean.slope /= n;
  const double y_n = frame.period * (static_cast<double>(clamped.size()) - 1.);
  mean.value       = (mean.value / n - y_n * mean.slope).eval();
  return mean;
}

HalfStrip::Lines PlateStrip::without(const AffineDeflection &far, Lines lines) const
{
  for (std::size_t k = 0; k < lines.size(); ++k)
    lines[k] -=
      without_curvature(cell, problem.plate, far.slope.transpose() * frame.inwards.transpose(),
                        far.value + static_cast<double>(k) * frame.period * far.slope);
  return lines;
}

Eigen::Matrix<double, 2, 3> PlateStrip::moment(const Lines &free) const
{
  // Of the cell far inside the part 1 − s counts, s from 0 to 1 across it; a whole cell has none.
  const CellElements &elements           = problem.elements;
  const Eigen::Matrix<double, 2, 3> rows = frame.components(frame.along);
  Eigen::Matrix<double, 2, 3> of_cell =
    0.5 * elements.cell.lattice.area() * rows * problem.solved.stiffness;
  Eigen::MatrixXd functional = Eigen::MatrixXd::Zero(cell.n_dofs(), 2);
  for (int t = 0; t < elements.n_triangles(); ++t)
  {
    const Eigen::Matrix3d &D =
      problem.plate.bending_stiffness_of_material[at(problem.plate.mesh.triangles[at(t)].material)];
    const double weight         = problem.plate.area(t) / n_field_points;
    const std::vector<int> dofs = cell.dofs_of(t);
    Eigen::Matrix<double, 3, 2> corners;
    for (int k = 0; k < 3; ++k)
      corners.row(k) = elements.points.row(elements.nodes(t, k));
    at_field_points(problem.plate, t,
                    [&](const auto &kappa, const Eigen::Vector3d &place)
                    {
                      of_cell -= weight * depth(place.transpose() * corners) * rows *
                                 problem.moments(t, kappa);
                      const Eigen::Matrix<double, 2, 12> of_shapes = weight * rows * D * kappa;
                      for (int k = 0; k < 12; ++k)
                        functional.row(dofs[at(k)]) += of_shapes.col(k).transpose();
                    });
  }
  return (of_cell + summed(functional, free)) / frame.length;
}

/// M_abc of a cell.
std::array<Eigen::Matrix3d, 2> bulk_term(const PlateProblem &problem)
{
  const std::vector<WeightedPoint> points = points_of_pieces(3);
  // 2 <(M_c e_b).grad w_a>: rows a, columns c.
  std::array<Eigen::Matrix3d, 2> mean = {Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};
  for (int t = 0; t < problem.elements.n_triangles(); ++t)
  {
    const Eigen::Matrix<double, 12, 3> w = deflection_of(problem, t);
    for (const auto &[point, part] : points)
    {
      const ThinPlate::Shapes shapes         = problem.plate.shapes(t, point.in_triangle);
      const Eigen::Matrix<double, 2, 3> grad = shapes.middleRows<2>(1) * w;
      const Eigen::Matrix3d moments          = problem.moments(t, shapes.bottomRows<3>());
      Eigen::Matrix<double, 2, 3> along_x, along_y;
      along_x << moments.row(0), moments.row(2);
      along_y << moments.row(2), moments.row(1);
      const double weight = 2. * problem.plate.area(t) * part;
      mean[0] += weight * grad.transpose() * along_x;
      mean[1] += weight * grad.transpose() * along_y;
    }
  }
  for (Eigen::Matrix3d &of_axis : mean)
    of_axis = ((of_axis - of_axis.transpose()) / problem.elements.cell.lattice.area()).eval();
  return mean;
}

/// Deflections and slopes too small to be kept, as the DoFs of a side have them.
Eigen::VectorXd too_small_on(const PlateStrip &strip, const PlateProblem &problem,
                             const double kept)
{
  const double side          = std::sqrt(problem.elements.cell.lattice.area());
  constexpr double round_off = 1e-12; // of a cell that does not fluctuate
  double deflection = round_off * side * side, slope = round_off * side;
  for (int d = 0; d < problem.plate.n_dofs(); ++d)
  {
    double &largest = kind_of(problem.plate, d).of_vertex == 0 ? deflection : slope;
    largest = std::max(largest, kept * problem.solved.deflection.row(d).cwiseAbs().maxCoeff());
  }
  Eigen::VectorXd sizes(strip.cell.n_side_dofs());
  for (int k = 0; k < strip.cell.n_side_dofs(); ++k)
    sizes(k) = kind_of(problem.plate, strip.cell.side[at(k)]).of_vertex == 0 ? deflection : slope;
  return sizes;
}

/// The tensor of a moment of which tt and tn are given, in rows 11, 22, 12.
Eigen::Matrix3d in_axes(const EdgeFrame &frame, const Eigen::Matrix<double, 2, 3> &of_edge)
{
  const Eigen::Vector2d &t = frame.along, &n = frame.inwards;
  Eigen::Matrix<double, 3, 2> columns;
  columns << t(0) * t(0), 2. * t(0) * n(0), t(1) * t(1), 2. * t(1) * n(1), t(0) * t(1),
    t(0) * n(1) + t(1) * n(0);
  return columns * of_edge;
}
} // namespace

PlateEdges edges_of_plate(const UnitCell &cell, const EdgeOptions &options)
{
  const PlateProblem problem(cell);
  PlateEdges edges;
  edges.bulk = bulk_term(problem);
  for (int axis = 0; axis < 2; ++axis)
  {
    const CondensedCell condensed(problem.elements, axis, elements_of_plate(problem));
    const int n_cells = cells_of_strip(condensed, options, decay_of(condensed).factor);
    for (const int side : {2 * axis, 2 * axis + 1})
    {
      const PlateStrip strip(condensed, problem, side);
      const HalfStrip::Lines at_clamp = strip.clamped(n_cells), free = strip.free(n_cells);
      const AffineDeflection far      = strip.far(at_clamp);
      const HalfStrip::Lines clamped  = strip.without(far, at_clamp);
      const Eigen::VectorXd too_small = too_small_on(strip, problem, options.kept);
      PlateEdge &edge                 = edges.sides[at(side)];
      edge.slip                       = far;
      edge.moment                     = in_axes(strip.frame, strip.moment(free));
      const int n_lines = std::max(lines_above(too_small, clamped), lines_above(too_small, free));
      edge.n_cells      = std::clamp(n_lines, 1, n_cells);
      edge.clamped      = strip.at_vertices<3>(clamped, edge.n_cells);
      edge.free         = strip.at_vertices<3>(free, edge.n_cells);
    }
  }
  return edges;
}
} // namespace homespun::homogenization
