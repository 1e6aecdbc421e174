// SPDX-License-Identifier: MIT
// What a periodic cloth does at its edges, against closed forms, symmetries and the rate at which
// it decays.
#include "homogenization/edges/edge_layers.h"
#include "meshes/plain/errors.h"
#include "tests/homogenization/cell/cells.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::homogenization;
using namespace homespun::tests;

namespace
{
constexpr double side_length = 0.01;

/// A quarter that is not in the middle, on shaken triangles: no symmetry at all.
UnitCell lopsided(const meshes::Lattice &lattice = square_lattice(side_length))
{
  UnitCell cell = cell_of(lattice, 8, 8, soft_and_hard(),
                          [](const double f1, const double f2)
                          { return f1 > 0.1 && f1 < 0.6 && f2 > 0.2 && f2 < 0.5 + 0.4 * f1; });
  shake(cell.mesh, lattice, 0.02 * side_length);
  return cell;
}

meshes::CellEdges edges_with(const UnitCell &cell, const unsigned int order)
{
  EdgeOptions options;
  options.order = order;
  return edges_of(cell, options);
}

/// Uniaxial stress along x: the strain with E11 = 1 that leaves the edges y = constant free.
Eigen::Vector3d pulled_along_x(const Eigen::Matrix3d &stiffness)
{
  const Eigen::Vector3d strain = stiffness.inverse().col(0);
  return strain / strain(0);
}

/// The strip at an edge with all that it stands on.
struct Strip
{
  Strip(const UnitCell &of_cell, const unsigned int order, const int side)
      : cell(of_cell)
      , elements(cell, order)
      , problem(solve_cell(elements))
      , condensed(elements, meshes::axis_of_side(side), elements_of_membrane(elements))
      , half(condensed, problem, side)
  {
  }

  const UnitCell cell;
  const CellElements elements;
  const ElementCellProblem problem;
  const CondensedCell condensed;
  const MembraneStrip half;
};
} // namespace

TEST(exact_edge_layers, of_a_homogeneous_cell_are_zero)
{
  for (const meshes::Lattice &lattice : {square_lattice(side_length), skewed_lattice()})
    for (const unsigned int order : {1u, 2u})
    {
      UnitCell cell =
        cell_of(lattice, 5, 6, soft_and_hard(), [](const double, const double) { return 1; });
      shake(cell.mesh, lattice, 0.02 * side_length);
      const meshes::CellEdges edges = edges_with(cell, order);
      const double force            = 10. * side_length; // E t x cell side
      for (const meshes::CellEdge &edge : edges.sides)
      {
        EXPECT_LT(edge.slip.cwiseAbs().maxCoeff(), 1e-12 * side_length);
        EXPECT_LT(edge.tension.cwiseAbs().maxCoeff(), 1e-12 * force);
        EXPECT_LT(edge.clamped.cwiseAbs().maxCoeff(), 1e-12 * side_length);
        EXPECT_LT(edge.free.cwiseAbs().maxCoeff(), 1e-12 * side_length);
      }
      for (const Eigen::Matrix3d &of_axis : edges.bulk)
        EXPECT_LT(of_axis.cwiseAbs().maxCoeff(), 1e-12 * force);
    }
}

// kappa = (E_h − E_s) t eps (1/8 − s/2) with a soft layer of thickness s eps outermost, then a full
// hard one, any Poisson's ratio; the other edge begins with the rest of the soft one.
TEST(exact_edge_layers, tension_of_a_free_edge_along_stripes_has_its_closed_form)
{
  const std::vector<Phase> phases = {isotropic("soft", 1e6, 0.2, 5e-4, 1.),
                                     isotropic("hard", 1e7, 0.45, 5e-4, 1.)};
  const double scale              = (1e7 - 1e6) * 5e-4 * side_length;
  for (const unsigned int order : {1u, 2u})
    for (const double s : {0., 0.125, 0.25, 0.5})
    {
      const UnitCell cell =
        cell_of(square_lattice(side_length), 3, 8, phases,
                [s](const double, const double f2) { return f2 > s && f2 < s + 0.5 ? 1 : 0; });
      const meshes::CellEdges edges = edges_with(cell, order);
      const Eigen::Vector3d E = pulled_along_x(solve_cell(CellElements(cell, order)).stiffness);
      EXPECT_NEAR(edges.sides[2].tension.dot(E), scale * (1. / 8. - s / 2.), 1e-9 * scale) << s;
      EXPECT_NEAR(edges.sides[3].tension.dot(E), scale * (s / 2. - 1. / 8.), 1e-9 * scale) << s;
      EXPECT_LT(edges.sides[2].free.cwiseAbs().maxCoeff(), 1e-12 * side_length) << "no layer";
    }
}

// Stripes along a clamped edge: all of the edge fluctuates alike, and phi is the constant −w there.
// w22 rises by (C22 / c22_soft − 1) over the soft half and falls over the hard one; its mean lies
// half way.
TEST(exact_edge_layers, slip_of_a_clamped_edge_along_stripes_has_its_closed_form)
{
  const UnitCell cell   = cell_of(square_lattice(side_length), 3, 4, soft_and_hard(), halves);
  const double c22_soft = 1. / (1. - 0.09), c22 = 1.99800200, c66_soft = 1. / 2.6,
               c66              = 0.699300699;
  const meshes::CellEdges edges = edges_with(cell, 1);
  const double stretch          = 0.25 * (c22 / c22_soft - 1.) * side_length;
  const double shear            = 0.25 * (c66 / c66_soft - 1.) * side_length;
  // Below lies the soft half, whose stretch carries the cloth above upwards; the same above.
  EXPECT_NEAR(edges.sides[2].slip(1, 1), stretch, 1e-8 * side_length);
  EXPECT_NEAR(edges.sides[3].slip(1, 1), stretch, 1e-8 * side_length);
  EXPECT_NEAR(edges.sides[2].slip(0, 2), shear, 1e-8 * side_length);
  EXPECT_NEAR(edges.sides[3].slip(0, 2), shear, 1e-8 * side_length);
  EXPECT_LT(edges.sides[2].clamped.cwiseAbs().maxCoeff(), 1e-12 * side_length);
}

// The resultant across the edge is that of the homogenized cloth, whatever the cell does.
TEST(invariant_edge_layers, tension_has_no_component_across_the_edge)
{
  for (const meshes::Lattice &lattice : {square_lattice(side_length), skewed_lattice()})
    for (int side = 0; side < meshes::CellEdges::n_sides; ++side)
    {
      const Strip strip(lopsided(lattice), 2, side);
      const Eigen::Matrix<double, 2, 3> tension = strip.half.tension(strip.half.free(30));
      EXPECT_GT(tension.row(0).cwiseAbs().maxCoeff(), 1e-3 * side_length);
      EXPECT_LT(tension.row(1).cwiseAbs().maxCoeff(), 1e-11 * 10. * side_length) << side;
    }
}

TEST(invariant_edge_layers, of_a_mirrored_cell_are_mirrored)
{
  const UnitCell cell                   = lopsided();
  UnitCell mirrored                     = cell;
  mirrored.mesh.vertices.col(0).array() = side_length - cell.mesh.vertices.col(0).array();
  mirrored.mesh.triangles.col(1)        = cell.mesh.triangles.col(2);
  mirrored.mesh.triangles.col(2)        = cell.mesh.triangles.col(1);
  const meshes::CellEdges edges = edges_with(cell, 1), other = edges_with(mirrored, 1);
  const Eigen::Vector2d turned(-1., 1.);         // of vectors
  const Eigen::Vector3d of_strains(1., 1., -1.); // of strains
  const std::array<int, 4> image = {1, 0, 2, 3};
  const int n                    = cell.mesh.n_vertices();
  for (std::size_t k = 0; k < 4; ++k)
  {
    const meshes::CellEdge &here  = edges.sides[k],
                           &there = other.sides[static_cast<std::size_t>(image[k])];
    EXPECT_LT((there.slip - turned.asDiagonal() * here.slip * of_strains.asDiagonal())
                .cwiseAbs()
                .maxCoeff(),
              1e-11 * side_length);
    EXPECT_GT(here.slip.cwiseAbs().maxCoeff(), 1e-3 * side_length);
    EXPECT_LT((there.tension - of_strains.asDiagonal() * here.tension).cwiseAbs().maxCoeff(),
              1e-11 * 10. * side_length);
    // Component y of the loads 11 and 22 at the vertices of the first cell.
    for (const int column : {1, 3})
    {
      EXPECT_LT(
        (there.clamped.col(column) - here.clamped.col(column)).head(n).cwiseAbs().maxCoeff(),
        1e-11 * side_length);
      EXPECT_LT((there.free.col(column) - here.free.col(column)).head(n).cwiseAbs().maxCoeff(),
                1e-11 * side_length);
    }
  }
  for (int b = 0; b < 2; ++b)
  {
    const auto index = static_cast<std::size_t>(b);
    EXPECT_LT((other.bulk[index] -
               turned(b) * of_strains.asDiagonal() * edges.bulk[index] * of_strains.asDiagonal())
                .cwiseAbs()
                .maxCoeff(),
              1e-11 * 10. * side_length);
  }
}

TEST(invariant_edge_layers, bulk_term_is_antisymmetric_and_zero_with_a_centre_of_symmetry)
{
  const double force = 10. * side_length;
  for (const unsigned int order : {1u, 2u})
  {
    const meshes::CellEdges lop = edges_with(lopsided(), order);
    for (const Eigen::Matrix3d &of_axis : lop.bulk)
    {
      EXPECT_EQ((of_axis + of_axis.transpose()).cwiseAbs().maxCoeff(), 0.);
      EXPECT_GT(of_axis.cwiseAbs().maxCoeff(), 1e-4 * force);
    }
    const UnitCell centred = cell_of(skewed_lattice(), 8, 8, soft_and_hard(), square_inclusion);
    for (const Eigen::Matrix3d &of_axis : edges_with(centred, order).bulk)
      EXPECT_LT(of_axis.cwiseAbs().maxCoeff(), 1e-12 * force);
  }
}

// With w_a + k_a in the place of w_a the bulk term gains (Sigma_c e_b).k_a − (Sigma_a e_b).k_c.
TEST(exact_edge_layers, bulk_term_follows_the_constant_of_the_fluctuation)
{
  for (const unsigned int order : {1u, 2u})
  {
    const UnitCell cell = lopsided(skewed_lattice());
    const CellElements elements(cell, order);
    const ElementCellProblem problem = solve_cell(elements);
    ElementCellProblem shifted       = problem;
    Eigen::Matrix<double, 2, 3> constant;
    constant << 1., -2., 3., 0.5, 0.7, -1.1;
    constant *= 0.1 * side_length;
    for (int n = 0; n < elements.n_classes; ++n)
      shifted.w.middleRows<2>(2 * n) += constant;
    const auto before = bulk_term(elements, problem), after = bulk_term(elements, shifted);
    const auto traction = [&](const int a, const int b)
    {
      const Eigen::Vector3d stress = problem.stiffness.col(a);
      return Eigen::Vector2d(stress(b == 0 ? 0 : 2), stress(b == 0 ? 2 : 1));
    };
    for (int b = 0; b < 2; ++b)
      for (int a = 0; a < 3; ++a)
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(after[static_cast<std::size_t>(b)](a, c) -
                        before[static_cast<std::size_t>(b)](a, c),
                      traction(c, b).dot(constant.col(a)) - traction(a, b).dot(constant.col(c)),
                      1e-11 * 10. * side_length);
  }
}

// On the edge the cloth stays where it is clamped, and far inside it fluctuates as the cell does.
TEST(invariant_edge_layers, clamped_modes_cancel_the_fluctuation_on_the_edge_and_decay)
{
  const UnitCell cell           = lopsided();
  const meshes::CellEdges edges = edges_with(cell, 1);
  const CellElements elements(cell, 1);
  const ElementCellProblem problem = solve_cell(elements);
  const int n                      = cell.mesh.n_vertices();
  for (int side = 0; side < meshes::CellEdges::n_sides; ++side)
  {
    const meshes::CellEdge &edge = edges.sides[static_cast<std::size_t>(side)];
    for (int v = 0; v < n; ++v)
    {
      const double f = elements.fraction(cell.mesh.vertices.row(v))(meshes::axis_of_side(side));
      if (std::abs(f - (meshes::is_far_side(side) ? 1. : 0.)) > 1e-9)
        continue;
      const Eigen::Matrix<double, 2, 3> w =
        problem.w.middleRows<2>(2 * elements.class_of[static_cast<std::size_t>(v)]);
      const Eigen::Matrix<double, 1, 6> mode = edge.clamped.row(v);
      for (int a = 0; a < 3; ++a)
        EXPECT_LT((mode.segment<2>(2 * a).transpose() + w.col(a) + edge.slip.col(a)).norm(), 1e-13);
    }
    EXPECT_LT(edge.clamped.bottomRows(n).cwiseAbs().maxCoeff(),
              std::pow(edge.decay, edge.n_cells - 2) * side_length);
  }
}

// N cells between two clamps, endless along them, the second moved by D: the strain inside is the
// E with E11 = 0 and L E n + (d_first − d_second) E = D, and the cloth lies at E y + d_first E +
// (w + both layers) E, to what the layers are at the other end.
TEST(exact_edge_layers, a_row_of_cells_between_clamps_is_what_slip_and_modes_make_of_it)
{
  const UnitCell cell   = lopsided();
  constexpr int n_cells = 14;
  const Strip first(cell, 1, 2), second(cell, 1, 3);
  const int n             = first.condensed.n_side_dofs();
  const SideStiffness &of = first.condensed.stiffness;
  Eigen::MatrixXd row     = Eigen::MatrixXd::Zero(n * (n_cells + 1), n * (n_cells + 1));
  for (int k = 0; k < n_cells; ++k)
  {
    row.block(n * k, n * k, n, n) += of.first;
    row.block(n * k, n * (k + 1), n, n) += of.across;
    row.block(n * (k + 1), n * k, n, n) += of.across.transpose();
    row.block(n * (k + 1), n * (k + 1), n, n) += of.second;
  }
  const Eigen::Vector2d moved(0.3 * side_length, 0.7 * side_length);
  const Eigen::VectorXd held = moved.replicate(n / 2, 1);
  const int n_free           = n * (n_cells - 1);
  const Eigen::VectorXd u =
    -row.block(n, n, n_free, n_free).llt().solve(row.block(n, n * n_cells, n_free, n) * held);

  const HalfStrip::Lines from_first = first.half.clamped(30), from_second = second.half.clamped(30);
  const Eigen::Matrix<double, 2, 3> d_first  = first.half.slip(from_first),
                                    d_second = second.half.slip(from_second);
  Eigen::Matrix2d equations = (d_first - d_second).rightCols<2>(); // of E22 and gamma12
  const double length       = n_cells * side_length;
  equations(1, 0) += length; // u = (gamma12 y, E22 y): periodic along x
  equations(0, 1) += length;
  Eigen::Vector3d strain;
  strain << 0., equations.lu().solve(moved);
  for (int k = 1; k < n_cells; ++k)
    for (int node = 0; node < n / 2; ++node)
    {
      const auto line = static_cast<std::size_t>(k);
      const Eigen::Vector2d w =
        first.problem.w.middleRows<2>(first.condensed.side[static_cast<std::size_t>(2 * node)]) *
        strain;
      const Eigen::Vector2d layers =
        (from_first[line].middleRows<2>(2 * node) - d_first +
         from_second[n_cells - line].middleRows<2>(2 * node) - d_second) *
        strain;
      const double y = k * side_length;
      const Eigen::Vector2d expected =
        Eigen::Vector2d(strain(2) * y, strain(1) * y) + d_first * strain + w + layers;
      EXPECT_LT((u.segment<2>(n * (k - 1) + 2 * node) - expected).norm(), 1e-10 * side_length) << k;
    }
}

// Along the half strip modes shrink by the factor per cell. What a half strip of N cells does wrong
// at its end comes back as much smaller as it went: at the edge the error is the factor to 2 N.
TEST(order_edge_layers, modes_shrink_per_cell_as_the_floquet_problem_says)
{
  const UnitCell cell = cell_of(square_lattice(side_length), 10, 8, soft_and_hard(),
                                [](const double f1, const double f2) { return halves(f1, f2); });
  const Strip strip(cell, 1, 0);
  const Decay decay = decay_of(strip.condensed);
  EXPECT_LT(decay.residual, 1e-10);
  const HalfStrip::Lines lines          = strip.half.clamped(16);
  const Eigen::Matrix<double, 2, 3> far = strip.half.slip(lines);
  const auto size                       = [&](const std::size_t k)
  {
    Eigen::MatrixXd rest = lines[k];
    for (Eigen::Index row = 0; row < rest.rows(); row += 2)
      rest.middleRows<2>(row) -= far;
    return rest.norm();
  };
  for (std::size_t k = 2; k < 6; ++k)
    EXPECT_NEAR(size(k + 1) / size(k), decay.factor, 0.02 * decay.factor) << k;
  for (int n_cells = 2; n_cells < 5; ++n_cells)
  {
    const auto error = [&](const int n) { return (strip.half.clamped(n)[1] - lines[1]).norm(); };
    EXPECT_NEAR(error(n_cells + 1) / error(n_cells), std::pow(decay.factor, 2),
                0.05 * std::pow(decay.factor, 2))
      << n_cells;
  }
}

// Values of two other codes, on the same triangles; the field of a free edge is symmetric, and the
// slowest mode is not. P2 has the limit, at which P1 arrives with the square of the mesh width.
TEST(exact_edge_layers, decay_of_layers_is_the_known_one)
{
  const auto factor = [](const int n, const unsigned int order)
  {
    const UnitCell cell = cell_of(square_lattice(side_length), n, n, soft_and_hard(), halves);
    return decay_of(Strip(cell, order, 0).condensed).factor;
  };
  const double coarse = factor(12, 1), fine = factor(24, 1);
  EXPECT_NEAR(coarse, 0.0845, 0.00005);
  EXPECT_NEAR(fine - (coarse - fine) / 3., factor(12, 2), 0.02 * (fine - factor(12, 2)));
  const Strip strip(cell_of(square_lattice(side_length), 12, 12, soft_and_hard(), halves), 1, 0);
  const HalfStrip::Lines free = strip.half.free(16);
  EXPECT_NEAR(free[2].norm() / free[1].norm(), 0.0169, 0.00005);
}

TEST(tripwire_edge_layers, too_slow_a_decay_is_refused_with_its_factor)
{
  std::vector<Phase> phases = soft_and_hard();
  phases[1].E1 = phases[1].E2 = 1e6;
  phases[1].G12               = 1e6 / 2.6;
  const UnitCell cell         = cell_of(square_lattice(side_length), 4, 8, phases, halves);
  try
  {
    edges_with(cell, 1);
    FAIL() << "stripes that reach a hundred cells far";
  }
  catch (const meshes::BadInput &refusal)
  {
    const std::string text = refusal.what();
    EXPECT_NE(text.find("along axis 1"), std::string::npos) << text;
    EXPECT_NE(text.find("by a factor of 0.9"), std::string::npos) << text;
    EXPECT_NE(text.find("expected at most 400"), std::string::npos) << text;
  }
}

TEST(tripwire_edge_layers, an_edge_that_is_no_lattice_line_is_named)
{
  UnitCell cell = cell_of(square_lattice(side_length), 6, 6, soft_and_hard(), square_inclusion);
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
    cell.mesh.vertices(v, 0) +=
      0.05 * side_length * std::sin(2. * M_PI * cell.mesh.vertices(v, 1) / side_length);
  try
  {
    edges_with(cell, 1);
    FAIL() << "a wavy outline";
  }
  catch (const meshes::BadInput &refusal)
  {
    EXPECT_NE(std::string(refusal.what()).find("no lattice lines"), std::string::npos);
  }
}

TEST(tripwire_edge_layers, a_cell_whose_outline_cuts_holes_has_no_edges)
{
  UnitCell cell           = lopsided();
  cell.lattice.cuts_holes = true;
  EXPECT_THROW(edges_with(cell, 1), meshes::BadInput);
}
