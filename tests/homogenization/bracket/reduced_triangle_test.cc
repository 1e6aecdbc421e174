// SPDX-License-Identifier: MIT
// Stress functions whose normal derivatives are linear along the sides of triangles: what holds for
// brackets of linear displacements beside all tests of brackets, which are made with both orders.
#include "homogenization/bracket/equilibrated_stress.h"
#include "homogenization/cell/corners.h"
#include "tests/homogenization/bracket/bracket_cells.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::homogenization;

namespace
{
EquilibratedStress stress_on(const TorusMesh &mesh, const std::vector<Eigen::Matrix3d> &stiffness,
                             const NormalDerivatives normal_derivatives)
{
  return {mesh, stiffness, {}, Holes::empty, normal_derivatives};
}

/// A cell with two holes that are not alike.
tests::BracketCell with_holes()
{
  tests::BracketCell cell =
    tests::bracket_cell(tests::skewed_lattice(), 8, 8, tests::contrasting(10.), tests::odd_pattern);
  int n_kept = 0;
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
  {
    const int column = t / 2 % 8, row = t / 2 / 8;
    if ((column == 6 && row == 1) || (column == 1 && (row == 5 || row == 6)))
      continue;
    cell.mesh.material(n_kept)        = cell.mesh.material(t);
    cell.mesh.triangles.row(n_kept++) = cell.mesh.triangles.row(t);
  }
  cell.mesh.triangles.conservativeResize(n_kept, 3);
  cell.mesh.material.conservativeResize(n_kept);
  return cell;
}
} // namespace

TEST(bound_reduced_triangle, stresses_are_some_of_those_of_whole_triangles)
{
  // The minimum over fewer of them is no smaller, for any mean stress.
  for (const tests::BracketCell &cell :
       {tests::square_inclusion_cell(8, 100.), tests::checkerboard_cell(8, 100.), with_holes()})
  {
    const TorusMesh mesh           = glued(cell.mesh, cell.lattice);
    const EquilibratedStress whole = stress_on(mesh, cell.stiffness, NormalDerivatives::quadratic);
    const EquilibratedStress reduced = stress_on(mesh, cell.stiffness, NormalDerivatives::linear);
    EXPECT_GE(whole.n_dofs, reduced.n_dofs + mesh.triangles.size());
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> ratio(reduced.compliance,
                                                                          whole.compliance);
    EXPECT_GE(ratio.eigenvalues()(0), 1. - 1e-12);
    EXPECT_GT(ratio.eigenvalues()(2), 1. + 1e-6); // and there are fewer indeed
  }
}

TEST(bound_reduced_triangle, holes_leave_stresses_in_equilibrium)
{
  // lambda det(sigma) integrates over the cell to lambda det(Sigma) for every stress in equilibrium
  // that is none in holes (Cherkaev, Lurie and Milton): compliances shift by the same constants.
  const double lambda   = 0.02;
  Eigen::Matrix3d shift = Eigen::Matrix3d::Zero();
  shift(0, 1) = shift(1, 0)     = 0.5 * lambda;
  shift(2, 2)                   = -lambda;
  const tests::BracketCell cell = with_holes();
  std::vector<Eigen::Matrix3d> shifted;
  for (const Eigen::Matrix3d &c : cell.stiffness)
    shifted.push_back((c.inverse() + shift).inverse());
  const TorusMesh mesh = glued(cell.mesh, cell.lattice);
  for (const auto element : {NormalDerivatives::linear, NormalDerivatives::quadratic})
  {
    const Eigen::Matrix3d before = stress_on(mesh, cell.stiffness, element).compliance,
                          after  = stress_on(mesh, shifted, element).compliance;
    EXPECT_LT((after - before - shift).norm(), 1e-11 * before.norm());
  }
}

TEST(order_reduced_triangle, the_compliance_converges_as_the_stiffness_of_linear_displacements_does)
{
  // With the order of the corners, twice their exponent, which all loads excite. The limit lies
  // between the two sides of an adaptive bracket, and so does the order.
  const auto cell_of       = [](const int n) { return tests::square_inclusion_cell(n, 10.); };
  const auto compliance_of = [&](const int n)
  {
    const tests::BracketCell cell = cell_of(n);
    const TorusMesh mesh          = glued(cell.mesh, cell.lattice);
    return stress_on(mesh, cell.stiffness, NormalDerivatives::linear).compliance;
  };
  const tests::BracketCell corners = cell_of(8);
  AdaptiveOptions narrow;
  narrow.tolerance    = 1e-5;
  const Bracket found = adaptive_bracket(corners.mesh, corners.lattice, corners.stiffness, narrow,
                                         [](const Bracket &) {})
                          .bracket;
  const Eigen::Matrix3d limits[2] = {found.stiffness.inverse(), found.compliance};
  const double corners_leave =
    2. * singularity_of(corners_of(corners.mesh, corners.lattice, corners.stiffness)).strongest;
  ASSERT_LT(corners_leave, 1.9);
  const Eigen::Matrix3d from = compliance_of(20), to = compliance_of(40);
  for (int a = 0; a < 3; ++a)
  {
    const auto order_to = [&](const Eigen::Matrix3d &limit)
    { return std::log2((from(a, a) - limit(a, a)) / (to(a, a) - limit(a, a))); };
    for (const Eigen::Matrix3d &limit : limits)
      EXPECT_NEAR(order_to(limit), corners_leave, 0.1) << a;
  }
}
