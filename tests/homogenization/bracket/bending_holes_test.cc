// SPDX-License-Identifier: MIT
// Brackets on the bending stiffness of sheets with holes.
#include "tests/homogenization/bracket/bending_cells.h"
#include "tests/homogenization/cell/cells.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::homogenization;
using tests::bent;
using tests::is_ordered;
using tests::plate;
using tests::relative_difference;
using tests::yarn;

namespace
{
/// Squares of an n x n cell left out.
template <typename IsHole>
tests::BracketCell with_holes(const meshes::Lattice &lattice, const int n,
                              const Eigen::Matrix3d &stiffness, const IsHole &is_hole)
{
  tests::BracketCell cell =
    tests::bracket_cell(lattice, n, n, {stiffness}, [](double, double) { return 0; });
  int n_kept = 0;
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    if (!is_hole(t / 2 % n, t / 2 / n))
      cell.mesh.triangles.row(n_kept++) = cell.mesh.triangles.row(t).eval();
  cell.mesh.triangles.conservativeResize(n_kept, 3);
  cell.mesh.material.setZero(n_kept);
  // Vertices inside of a hole go.
  std::vector<int> number(static_cast<std::size_t>(cell.mesh.n_vertices()), -1);
  const auto its_number = [&](const int k) -> int &
  { return number[static_cast<std::size_t>(cell.mesh.triangles(k / 3, k % 3))]; };
  for (int k = 0; k < 3 * n_kept; ++k)
    its_number(k) = 0;
  int n_vertices = 0;
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
    if (number[static_cast<std::size_t>(v)] == 0)
    {
      cell.mesh.vertices.row(n_vertices)  = cell.mesh.vertices.row(v).eval();
      number[static_cast<std::size_t>(v)] = n_vertices++;
    }
  cell.mesh.vertices.conservativeResize(n_vertices, 2);
  for (int k = 0; k < 3 * n_kept; ++k)
    cell.mesh.triangles(k / 3, k % 3) = its_number(k);
  return cell;
}
} // namespace

TEST(exact_bending_bracket, holes_are_the_limit_of_stiff_parts_of_the_analogous_membrane)
{
  // A square hole of a third of the side, and a pattern of several on a skewed lattice.
  const Eigen::Matrix3d D = plate(1., 0.3, 1.), ct = analogous_membrane(D);
  const auto square  = [](const int i, const int j) { return i > 2 && i < 6 && j > 2 && j < 6; };
  const auto several = [](const int i, const int j)
  { return (i == 1 && j == 1) || (i > 3 && i < 6 && j == 4) || (i == 7 && j == 6); };
  const auto compare = [&](const meshes::Lattice &lattice, const auto &is_hole)
  {
    const tests::BracketCell holes = with_holes(lattice, 9, D, is_hole);
    const BendingBracket b         = bent(holes);
    EXPECT_TRUE(is_ordered(b.lower, b.upper));
    EXPECT_TRUE(is_ordered(b.upper, D)); // less than the solid plate
    EXPECT_LT(b.lower(0, 0), 0.95 * D(0, 0));
    EXPECT_LT(b.width, 0.35);
    double before = 0.;
    for (const double stiff : {1e5, 1e7})
    {
      const tests::BracketCell filled =
        tests::bracket_cell(lattice, 9, 9, {ct, stiff * ct},
                            [&](double f1, double f2) {
                              return is_hole(static_cast<int>(9. * f1), static_cast<int>(9. * f2));
                            });
      const Bracket near  = tests::bracketed(filled, 2),
                    limit = bracket(glued(holes.mesh, holes.lattice), {ct}, 2, Holes::rigid);
      // Each side of the membrane; what is left falls with the compliance of the stiff part.
      const double left = std::max(relative_difference(near.stiffness, limit.stiffness),
                                   relative_difference(near.compliance, limit.compliance));
      EXPECT_LT(left, 20. / stiff);
      EXPECT_TRUE(before == 0. || std::abs(left / before - 0.01) < 1e-3) << left;
      before = left;
    }
  };
  compare(tests::square_lattice(1.), square);
  compare(tests::skewed_lattice(), several);
}

TEST(exact_bending_bracket, gaps_of_the_triangles_add_up_with_holes_too)
{
  const tests::BracketCell cell = with_holes(
    tests::skewed_lattice(), 9, yarn(20., 1.),
    [](const int i, const int j) { return (i > 2 && i < 6 && j == 4) || (i == 7 && j == 7); });
  for (const unsigned order : {1u, 2u})
  {
    const Bracket b = bracket(glued(cell.mesh, cell.lattice), analogous_membranes(cell.stiffness),
                              order, Holes::rigid);
    EXPECT_GE(b.gaps.minCoeff(), 0.);
    const double gap = (b.stiffness.inverse() * (b.stiffness - b.compliance.inverse())).trace();
    EXPECT_NEAR(b.gaps.sum(), gap, 1e-10 * gap);
  }
}

TEST(bound_bending_bracket, brackets_of_sheets_with_holes_close_by_adaptivity)
{
  const tests::BracketCell cell =
    with_holes(tests::square_lattice(1.), 6, plate(1., 0.3, 1.),
               [](const int i, const int j) { return i > 1 && i < 4 && j > 1 && j < 4; });
  const BendingBracket coarse = bent(cell);
  AdaptiveOptions options;
  options.tolerance                   = 2e-3;
  options.max_dofs                    = 60000;
  const AdaptiveBendingBracket narrow = adaptive_bending_bracket(
    glued(cell.mesh, cell.lattice), cell.stiffness, options, [](const BendingBracket &) {});
  EXPECT_EQ(narrow.ending, AdaptiveEnd::tolerance);
  EXPECT_TRUE(is_ordered(coarse.lower, narrow.bracket.lower));
  EXPECT_TRUE(is_ordered(narrow.bracket.upper, coarse.upper));
}
