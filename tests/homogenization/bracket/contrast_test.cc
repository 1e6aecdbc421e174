// SPDX-License-Identifier: MIT
// Sides of cells whose phases differ without end, up to holes.
#include "homogenization/bracket/bracket.h"
#include "tests/homogenization/bracket/bracket_cells.h"
#include "tests/homogenization/cell/cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace homespun;
using namespace homespun::homogenization;
using tests::bracketed;
using tests::is_ordered;
using tests::relative_difference;

namespace
{
/// Part of the squares of an 8 x 8 cell left out, or filled with something soft.
template <typename IsHole>
std::array<tests::BracketCell, 2> filled_and_empty(const IsHole &is_hole, const double softness)
{
  tests::BracketCell filled =
    tests::bracket_cell(tests::skewed_lattice(), 8, 8, tests::contrasting(softness),
                        [&](double f1, double f2)
                        { return is_hole(static_cast<int>(8. * f1), static_cast<int>(8. * f2)); });
  tests::BracketCell empty = filled;
  int n_kept               = 0;
  for (int t = 0; t < filled.mesh.n_triangles(); ++t)
    if (filled.mesh.material(t) == 0)
      empty.mesh.triangles.row(n_kept++) = filled.mesh.triangles.row(t);
  empty.mesh.triangles.conservativeResize(n_kept, 3);
  empty.mesh.material.setZero(n_kept);
  return {empty, filled};
}
} // namespace

TEST(bound_bracket, lower_is_below_upper_and_both_lie_between_reuss_and_voigt)
{
  std::mt19937 generator(3);
  std::bernoulli_distribution coin(0.4);
  for (const double contrast : {1., 30., 1e4, 1e6, 1e9})
  {
    const auto stiffness = tests::contrasting(contrast);
    const tests::BracketCell cell =
      tests::bracket_cell(tests::skewed_lattice(), 8, 8, stiffness,
                          [&](double, double) { return coin(generator) ? 1 : 0; });
    Eigen::Matrix3d voigt = Eigen::Matrix3d::Zero(), reuss = voigt;
    for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    {
      const Eigen::Matrix3d &c = stiffness[static_cast<std::size_t>(cell.mesh.material(t))];
      voigt += c / cell.mesh.n_triangles();
      reuss += c.inverse() / cell.mesh.n_triangles();
    }
    const Bracket b = bracketed(cell, 2);
    EXPECT_TRUE(is_ordered(b.lower, b.upper)) << contrast;
    EXPECT_TRUE(is_ordered(reuss.inverse(), b.lower, 1e-12)) << contrast;
    EXPECT_TRUE(is_ordered(b.upper, voigt, 1e-12)) << contrast;
    EXPECT_LT(b.round_off, 1e-7) << contrast;
    EXPECT_LT(b.excess, 1e-9) << contrast;
  }
}

TEST(bound_bracket, stripes_lie_between_their_sides_at_any_contrast)
{
  // In the stiff phase the soft load leaves a strain of 1 / contrast, which is a difference of
  // numbers of size 1: its product with the stiff load is off by the rounding of 1 times
  // sqrt(contrast), where the energy of neither is.
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  for (const double contrast : {1e3, 1e6, 1e9, 1e12})
    for (const bool is_soft_first : {true, false})
      for (const unsigned order : {1u, 2u})
      {
        std::vector<Eigen::Matrix3d> phases = tests::contrasting(contrast);
        if (!is_soft_first)
          std::swap(phases[0], phases[1]);
        const Bracket b =
          bracketed(tests::bracket_cell(tests::square_lattice(1.), 4, 3, phases,
                                        [](double, double f2) { return f2 < 1. / 3. ? 0 : 1; }),
                    order);
        const Eigen::Matrix3d exact = laminate_stiffness(phases, {1. / 3., 2. / 3.}),
                              scale = exact.diagonal().cwiseSqrt().cwiseInverse().asDiagonal();
        const auto is_below         = [&](const Eigen::Matrix3d &A, const Eigen::Matrix3d &B)
        { return is_ordered(scale * A * scale, scale * B * scale, 4. * epsilon); };
        EXPECT_TRUE(is_below(b.lower, exact) && is_below(exact, b.upper)) << contrast;
        EXPECT_LT(b.round_off, 2000. * epsilon * std::sqrt(contrast)) << contrast;
      }
}

TEST(exact_bracket, holes_are_the_limit_of_ever_softer_phases)
{
  // Two holes that touch in a vertex, and one by itself.
  const auto [holes, filled] = filled_and_empty(
    [](const int i, const int j)
    { return (i == 2 && j == 2) || (i == 3 && j == 3) || (i > 4 && i < 7 && j == 5); },
    1e-9);
  ASSERT_TRUE(meshes::faults_of(holes.mesh, "holes").empty());
  const Bracket empty = bracketed(holes, 2), soft = bracketed(filled, 2);
  EXPECT_LT(relative_difference(empty.stiffness, soft.stiffness), 1e-6);
  EXPECT_LT(relative_difference(empty.compliance, soft.compliance), 1e-6);
  EXPECT_TRUE(is_ordered(empty.lower, empty.upper));
}

TEST(bound_bracket, brackets_of_cells_with_holes_close_by_adaptivity)
{
  const tests::BracketCell cell = filled_and_empty(
    [](const int i, const int j) { return (i > 0 && i < 4 && j == 2) || (i == 6 && j == 6); },
    1.)[0];
  const Bracket coarse = bracketed(cell, 2);
  AdaptiveOptions options;
  options.tolerance = 4e-3;
  options.max_dofs  = 40000;
  const AdaptiveBracket narrow =
    adaptive_bracket(cell.mesh, cell.lattice, cell.stiffness, options, [](const Bracket &) {});
  EXPECT_EQ(narrow.ending, AdaptiveEnd::tolerance);
  EXPECT_TRUE(is_ordered(coarse.lower, narrow.bracket.lower));
  EXPECT_TRUE(is_ordered(narrow.bracket.upper, coarse.upper));
}
