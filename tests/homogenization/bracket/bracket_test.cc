// SPDX-License-Identifier: MIT
#include "homogenization/bracket/bracket.h"
#include "tests/homogenization/bracket/bracket_cells.h"
#include "tests/homogenization/cell/cells.h"
#include "tests/homogenization/cell/unfolded.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace homespun;
using namespace homespun::homogenization;
using tests::bracketed;
using tests::is_ordered;
using tests::odd_pattern;
using tests::of_bulk_and_shear;
using tests::relative_difference;

namespace
{
meshes::Lattice hexagonal_lattice()
{
  meshes::Lattice lattice;
  lattice.vectors << 1., 0., 0.5, 0.5 * std::sqrt(3.);
  return lattice;
}

/// Four geometries for two isotropic phases; the stiff parts of the second one meet at corners.
std::vector<tests::BracketCell> geometries(const std::vector<Eigen::Matrix3d> &stiffness)
{
  return {tests::bracket_cell(tests::square_lattice(1.), 8, 8, stiffness, tests::square_inclusion),
          tests::bracket_cell(tests::square_lattice(1.), 8, 8, stiffness,
                              [](double f1, double f2)
                              { return (f1 < 0.5) == (f2 < 0.5) ? 1 : 0; }),
          tests::bracket_cell(tests::skewed_lattice(), 8, 8, stiffness, odd_pattern),
          tests::bracket_cell(hexagonal_lattice(), 8, 8, stiffness, tests::square_inclusion)};
}

/// The exponent p of width ~ dofs^p over the last steps.
double slope_of(const std::vector<std::array<double, 2>> &history, const std::size_t first)
{
  double sx = 0., sy = 0., sxx = 0., sxy = 0., n = 0.;
  for (std::size_t k = first; k < history.size(); ++k)
  {
    const double x = std::log(history[k][0]), y = std::log(history[k][1]);
    sx += x, sy += y, sxx += x * x, sxy += x * y, n += 1.;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}
} // namespace

TEST(exact_bracket, laminates_close_to_round_off_because_both_spaces_hold_the_exact_fields)
{
  // chi is piecewise linear; phi piecewise quadratic with a continuous gradient. Nothing is left to
  // converge.
  const Eigen::Matrix3d exact = laminate_stiffness(tests::contrasting(10.), {0.5, 0.5});
  for (const unsigned order : {1u, 2u})
  {
    const Bracket b = bracketed(tests::stripes(6, 4, 10.), order);
    EXPECT_LT(b.width, 1e-11);
    EXPECT_GE(b.width, b.round_off);
    EXPECT_TRUE(is_ordered(b.lower, exact) && is_ordered(exact, b.upper)) << "P" << order;
    EXPECT_LT(relative_difference(b.lower, exact), 1e-11);
  }
}

TEST(exact_bracket, two_linear_triangles_have_no_unknowns_and_the_mean_of_their_stiffnesses)
{
  const std::vector<Eigen::Matrix3d> stiffness = tests::contrasting(10.);
  tests::BracketCell cell =
    tests::bracket_cell(tests::skewed_lattice(), 1, 1, stiffness, odd_pattern);
  cell.mesh.material         = Eigen::Vector2i(0, 1);
  const Bracket b            = bracketed(cell, 1);
  const Eigen::Matrix3d mean = 0.5 * (stiffness[0] + stiffness[1]);
  EXPECT_LT(relative_difference(b.upper, mean), 1e-11);
  EXPECT_TRUE(is_ordered(b.lower, b.upper));
}

TEST(exact_bracket, a_laminate_of_one_element_along_its_layers_has_the_closed_form_of_its_mesh)
{
  for (const bool is_along_2 : {false, true})
  {
    const tests::BracketCell cell = tests::bracket_cell(
      tests::square_lattice(1.), is_along_2 ? 4 : 1, is_along_2 ? 1 : 4, tests::contrasting(10.),
      [&](const double f1, const double f2) { return (is_along_2 ? f1 : f2) < 0.5 ? 0 : 1; });
    const Bracket b = bracketed(cell, 1);
    EXPECT_LT(
      relative_difference(b.upper, laminate_stiffness(cell.mesh, cell.lattice, cell.stiffness)),
      1e-11);
  }
}

TEST(exact_bracket, off_axis_anisotropic_laminates_close_at_any_angle_of_the_cell)
{
  const std::vector<Eigen::Matrix3d> layers = {
    plane_stress_stiffness({"a", 10., 1., 0.3, 0.4, 30., 1., 1.}),
    plane_stress_stiffness({"b", 6., 2., 0.2, 0.7, -55., 0.8, 1.}),
    tests::isotropic_stiffness(3., 0.1)};
  const tests::BracketCell cell = tests::bracket_cell(tests::square_lattice(0.01), 3, 8, layers,
                                                      [](double, double f2) {
                                                        return f2 < 0.25 ? 0 : f2 < 0.5 ? 1 : 2;
                                                      });
  const Eigen::Matrix3d upright = laminate_stiffness(layers, {0.25, 0.25, 0.5});
  ASSERT_GT(std::abs(upright(0, 2)), 0.1);
  for (const double degrees : {0., 20., -63.})
  {
    const double angle      = degrees * M_PI / 180.;
    const Eigen::Matrix3d T = stiffness_rotation(angle);
    Eigen::Matrix2d turn;
    turn << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
    tests::BracketCell turned = cell;
    turned.mesh.vertices      = cell.mesh.vertices * turn;
    turned.lattice.vectors    = cell.lattice.vectors * turn;
    for (Eigen::Matrix3d &c : turned.stiffness)
      c = (T * c * T.transpose()).eval();
    const Bracket b = bracketed(turned, 2);
    EXPECT_LT(relative_difference(b.lower, T * upright * T.transpose()), 1e-10) << degrees;
    EXPECT_LT(relative_difference(b.upper, T * upright * T.transpose()), 1e-10) << degrees;
  }
}

TEST(exact_bracket, both_solvers_agree_on_an_adaptively_refined_mesh)
{
  // Periodicity by constraints and multigrid against periodicity by gluing and Cholesky.
  UnitCell cell =
    tests::cell_of(tests::skewed_lattice(), 8, 8, tests::soft_and_hard(), odd_pattern);
  for (const unsigned order : {1u, 2u})
  {
    AdaptiveOptions options;
    options.order                  = order;
    options.max_dofs               = 4000;
    options.tolerance              = 1e-9;
    const AdaptiveBracket adaptive = adaptive_bracket(
      cell.mesh, cell.lattice, cell.stiffness_of_phase(), options, [](const Bracket &) {});
    EXPECT_EQ(adaptive.ending, AdaptiveEnd::max_dofs);
    UnitCell fine              = cell;
    fine.mesh                  = tests::unfolded(adaptive.mesh);
    const Homogenization by_cg = tests::solved(fine, order);
    EXPECT_LT(relative_difference(adaptive.bracket.stiffness, by_cg.stiffness), 1e-10);
    EXPECT_LT(relative_difference(adaptive.bracket.stiffness_by_flux, by_cg.stiffness), 1e-9);
    EXPECT_TRUE(is_ordered(adaptive.bracket.lower, by_cg.stiffness));
    // chi at the given vertices, wherever they stand in the refined mesh.
    for (int v = 0; v < cell.mesh.n_vertices(); ++v)
    {
      Eigen::Index same;
      (fine.mesh.vertices.rowwise() - cell.mesh.vertices.row(v)).rowwise().norm().minCoeff(&same);
      EXPECT_LT((adaptive.bracket.chi.row(v) - by_cg.chi.row(same)).norm(),
                1e-8 * by_cg.chi.cwiseAbs().maxCoeff());
    }
  }
}

TEST(exact_bracket, gaps_of_the_triangles_add_up_to_the_gap_of_the_energies)
{
  for (const tests::BracketCell &cell : geometries(tests::contrasting(100.)))
    for (const unsigned order : {1u, 2u})
    {
      const Bracket b = bracketed(cell, order);
      EXPECT_GE(b.gaps.minCoeff(), 0.);
      const double gap = (b.stiffness.inverse() * (b.stiffness - b.compliance.inverse())).trace();
      EXPECT_NEAR(b.gaps.sum(), gap, 1e-11 * gap);
      EXPECT_LE(b.width, gap + b.round_off);
      EXPECT_GE(3. * b.width, gap);
    }
}

TEST(bound_bracket, hills_exact_stiffness_lies_inside_in_every_geometry)
{
  // Hill (1964): with one shear modulus G in all phases the cell is isotropic with that G and the
  // area bulk modulus K of 1/(K + G) = <1/(K_i + G)>, whatever its geometry.
  const double G = 1., K[2] = {1.5, 40.};
  for (const tests::BracketCell &cell :
       geometries({of_bulk_and_shear(K[0], G), of_bulk_and_shear(K[1], G)}))
  {
    const Eigen::VectorXd areas = meshes::signed_areas(cell.mesh);
    double part                 = 0.;
    for (int t = 0; t < cell.mesh.n_triangles(); ++t)
      part += areas(t) * cell.mesh.material(t) / areas.sum();
    const double bulk           = 1. / ((1. - part) / (K[0] + G) + part / (K[1] + G)) - G;
    const Eigen::Matrix3d exact = of_bulk_and_shear(bulk, G);
    for (const unsigned order : {1u, 2u})
    {
      const Bracket b = bracketed(cell, order);
      EXPECT_TRUE(is_ordered(b.lower, exact, 1e-14) && is_ordered(exact, b.upper, 1e-14));
      EXPECT_LT(b.width, order == 1 ? 0.5 : 0.1); // not inside because it is vast
    }
  }
}

TEST(exact_bracket, the_shift_of_cherkaev_lurie_and_milton_shifts_the_compliance_to_round_off)
{
  // 1/K + lambda and 1/G − lambda in every phase add lambda det(sigma) to twice the energy density
  // of the stress. det(curl curl phi) integrates to zero for every periodic phi whose gradient is
  // continuous: the compliance of any admissible stress shifts by the same constants. A stress that
  // is not in equilibrium, by an edge's normal the wrong way round or a lost pair, does not.
  const double lambda = 0.3, K[2] = {0.8, 30.}, G[2] = {0.5, 2.};
  Eigen::Matrix3d shift = Eigen::Matrix3d::Zero();
  shift(0, 1) = shift(1, 0) = 0.5 * lambda;
  shift(2, 2)               = -lambda;
  const auto phases         = [&](const double by)
  {
    std::vector<Eigen::Matrix3d> stiffness;
    for (int p = 0; p < 2; ++p)
      stiffness.push_back(of_bulk_and_shear(1. / (1. / K[p] + by), 1. / (1. / G[p] - by)));
    return stiffness;
  };
  ASSERT_LT(relative_difference(phases(lambda)[1].inverse(), phases(0.)[1].inverse() + shift),
            1e-13);
  const auto plain = geometries(phases(0.)), shifted = geometries(phases(lambda));
  for (std::size_t k = 0; k < plain.size(); ++k)
    for (const unsigned order : {1u, 2u})
    {
      const Bracket b = bracketed(plain[k], order), s = bracketed(shifted[k], order);
      EXPECT_LT(relative_difference(s.compliance, b.compliance + shift), 1e-11) << k;
      // And the two brackets of one exact value overlap.
      const auto moved = [&](const Eigen::Matrix3d &C) -> Eigen::Matrix3d
      { return (C.inverse() + shift).inverse(); };
      EXPECT_TRUE(is_ordered(moved(b.lower), s.upper) && is_ordered(s.lower, moved(b.upper))) << k;
    }
}

TEST(bound_bracket, a_finer_mesh_nests_inside_a_coarser_one)
{
  const tests::BracketCell cell = tests::square_inclusion_cell(4, 100.);
  for (const unsigned order : {1u, 2u})
  {
    TorusMesh mesh = glued(cell.mesh, cell.lattice);
    Bracket before = bracket(mesh, cell.stiffness, order);
    for (int level = 0; level < 3; ++level)
    {
      mesh            = bisected(mesh, largest(before.indicators, 0.5));
      const Bracket b = bracket(mesh, cell.stiffness, order);
      EXPECT_TRUE(is_ordered(b.upper, before.upper, 1e-11));
      EXPECT_LT(b.width, before.width);
      before = b;
    }
  }
}

TEST(invariant_bracket, units_turns_and_shifts_leave_the_bracket_alone)
{
  const tests::BracketCell cell =
    tests::bracket_cell(tests::skewed_lattice(), 8, 8, tests::contrasting(50.), odd_pattern);
  const Bracket before = bracketed(cell, 2);
  for (const double metres : {1e-3, 1e3})
    for (const double pascals : {1e-9, 1e9})
    {
      tests::BracketCell other = cell;
      other.mesh.vertices *= metres;
      other.lattice.vectors *= metres;
      for (Eigen::Matrix3d &c : other.stiffness)
        c *= pascals;
      const Bracket b = bracketed(other, 2);
      EXPECT_LT(relative_difference(b.lower / pascals, before.lower), 1e-10);
      EXPECT_LT(relative_difference(b.upper / pascals, before.upper), 1e-10);
      EXPECT_NEAR(b.width, before.width, 1e-9);
    }
  const double angle      = 0.7;
  const Eigen::Matrix3d T = stiffness_rotation(angle);
  Eigen::Matrix2d turn;
  turn << std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle);
  tests::BracketCell turned = cell;
  turned.mesh.vertices      = (cell.mesh.vertices * turn).rowwise() + Eigen::RowVector2d(0.3, -0.2);
  turned.lattice.vectors    = cell.lattice.vectors * turn;
  const Bracket b           = bracketed(turned, 2);
  EXPECT_LT(relative_difference(b.lower, T * before.lower * T.transpose()), 1e-10);
  EXPECT_LT(relative_difference(b.upper, T * before.upper * T.transpose()), 1e-10);
  const tests::BracketCell shifted =
    tests::bracket_cell(cell.lattice, 8, 8, cell.stiffness,
                        [](double f1, double f2) {
                          return odd_pattern(std::fmod(f1 + 0.375, 1.), std::fmod(f2 + 0.75, 1.));
                        });
  EXPECT_LT(relative_difference(bracketed(shifted, 2).lower, before.lower), 1e-10);
}

TEST(exact_bracket, meshes_far_finer_than_coordinates_keep_their_digits)
{
  // 90 halvings towards the corner of the cell where the stiff squares meet: triangles of 1e-27.
  const tests::BracketCell cell = tests::checkerboard_cell(2, 1000.);
  TorusMesh mesh                = glued(cell.mesh, cell.lattice);
  const Bracket coarse          = bracket(mesh, cell.stiffness, 2);
  for (int round = 0; round < 90; ++round)
  {
    std::vector<char> is_marked(mesh.triangles.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (const int v : mesh.triangles[t].vertices)
        is_marked[t] |= v == 0;
    mesh = bisected(mesh, is_marked);
  }
  EXPECT_LT(relative_resolution(mesh), 1e-27);
  const Bracket b = bracket(mesh, cell.stiffness, 2);
  EXPECT_LT(b.round_off, 1e-9);
  EXPECT_LT(b.excess, 1e-9);
  EXPECT_TRUE(is_ordered(b.lower, b.upper));
  EXPECT_LT(b.width, coarse.width);
  const double gap = (b.stiffness.inverse() * (b.stiffness - b.compliance.inverse())).trace();
  EXPECT_NEAR(b.gaps.sum(), gap, 1e-9 * gap);
}

TEST(order_bracket, adaptive_widths_fall_with_the_number_of_dofs_as_if_there_were_no_corners)
{
  // Width ~ h^2 for P1 and h^4 for P2 and Clough-Tocher on smooth solutions, dofs ~ h^-2.
  const tests::BracketCell cell = tests::square_inclusion_cell(4, 100.);
  for (const unsigned order : {1u, 2u})
  {
    AdaptiveOptions options;
    options.order     = order;
    options.tolerance = order == 1 ? 4e-3 : 1e-4;
    std::vector<std::array<double, 2>> history;
    adaptive_bracket(cell.mesh, cell.lattice, cell.stiffness, options,
                     [&](const Bracket &b) {
                       history.push_back({1. * b.n_displacement_dofs, b.width});
                     });
    EXPECT_NEAR(slope_of(history, history.size() - 5), order == 1 ? -1. : -2., 0.2) << "P" << order;
  }
}

TEST(exact_bracket, marking_takes_the_fewest_that_hold_the_wanted_part)
{
  Eigen::VectorXd values(5);
  values << 1., 5., 2., 0., 4.;
  EXPECT_EQ(largest(values, 0.7), (std::vector<char>{0, 1, 0, 0, 1}));
  EXPECT_EQ(largest(values, 0.8), (std::vector<char>{0, 1, 1, 0, 1}));
  EXPECT_EQ(largest(values, 0.4), (std::vector<char>{0, 1, 0, 0, 0}));
}
