// SPDX-License-Identifier: MIT
// The two sides of a bracket as quadratic forms, against long double arithmetic: what round-off
// takes from the soft directions must be in what is declared.
#include "homogenization/bracket/loewner.h"
#include "tests/homogenization/bracket/bracket_cells.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

using namespace homespun;
using namespace homespun::homogenization;

namespace
{
using Exact = Eigen::Matrix<long double, 3, 3>;

/// Smallest and largest v.(B − A).v / v.B.v.
Eigen::Vector2d gaps(const Exact &A, const Exact &B)
{
  const Eigen::LLT<Exact> factors(B);
  const Exact half = factors.matrixL().solve(Exact(B - A));
  const Exact both = factors.matrixL().solve(Exact(half.transpose()));
  const auto all   = Eigen::SelfAdjointEigenSolver<Exact>(both).eigenvalues();
  return {static_cast<double>(all(0)), static_cast<double>(all(2))};
}

/// C^H of equal layers of isotropic phases that are stacked along (−1, 1): Backus' averages, turned
/// by 45 degrees.
Exact diagonal_laminate(const std::vector<Eigen::Matrix3d> &layers)
{
  using Number    = long double;
  Number flexible = 0, flux = 0, rest = 0, shear = 0;
  for (const Eigen::Matrix3d &c : layers)
  {
    const Number c11 = c(0, 0), c12 = c(0, 1), c66 = c(2, 2), part = 1.L / layers.size();
    flexible += part / c11;
    flux += part * c12 / c11;
    rest += part * (c11 - c12 * c12 / c11);
    shear += part / c66;
  }
  Exact upright = Exact::Zero();
  upright(1, 1) = 1 / flexible;
  upright(0, 1) = upright(1, 0) = flux / flexible;
  upright(0, 0)                 = rest + flux * flux / flexible;
  upright(2, 2)                 = 1 / shear;
  // Strains along and across the layers from those along the axes.
  Exact turn;
  turn << 0.5L, 0.5L, 0.5L, 0.5L, 0.5L, -0.5L, -1.L, 1.L, 0.L;
  return turn.transpose() * upright * turn;
}

/// Layers along (1, 1): the lattice vectors (1, 1) and (−1, 1) are exact.
tests::BracketCell diagonal_layers(const double contrast)
{
  meshes::Lattice lattice;
  lattice.vectors << 1., 1., -1., 1.;
  return tests::bracket_cell(lattice, 4, 4, tests::contrasting(contrast),
                             [](double, double f2) { return f2 < 0.5 ? 0 : 1; });
}
} // namespace

TEST(bound_loewner, the_lower_side_of_a_turned_laminate_stays_below_the_exact_stiffness)
{
  for (const double contrast : {1., 1e3, 1e5, 1e6, 1e7})
  {
    const tests::BracketCell cell = diagonal_layers(contrast);
    const Exact exact             = diagonal_laminate(cell.stiffness);
    for (const unsigned order : {1u, 2u})
    {
      const Bracket b  = tests::bracketed(cell, order);
      const auto below = gaps(b.lower.cast<long double>(), exact),
                 above = gaps(exact, b.upper.cast<long double>());
      EXPECT_GE(below(0), 0.) << contrast;
      EXPECT_GE(above(0), 0.) << contrast;
      // Nothing but round-off is between them, and it is declared.
      EXPECT_LE(std::max(below(1), above(1)), b.round_off) << contrast;
      EXPECT_LT(b.round_off, 1e-12 * weakness(b.compliance) + 1e-12 * weakness(b.stiffness));
    }
  }
}

TEST(bound_loewner, an_inverse_is_off_by_no_more_than_it_declares)
{
  for (const double contrast : {1., 1e4, 1e8, 1e12})
    for (const double angle : {0., 0.3, M_PI / 4., 1.2})
    {
      const Eigen::Matrix3d T   = stiffness_rotation(angle);
      Eigen::Matrix3d A         = Eigen::Vector3d(contrast, 1., 0.4).asDiagonal();
      A                         = T * A * T.transpose();
      A                         = (0.5 * (A + A.transpose())).eval();
      const RoundedInverse X    = inverse_of(A);
      const Exact exact         = Eigen::LLT<Exact>(A.cast<long double>()).solve(Exact::Identity());
      const Eigen::Vector2d off = gaps(X.value.cast<long double>(), exact);
      EXPECT_LE(std::max(-off(0), off(1)), X.round_off) << contrast << " at " << angle;
      EXPECT_LE(X.round_off, 1e-12 * contrast);
      EXPECT_EQ(X.value, X.value.transpose());
    }
}

TEST(tripwire_loewner, a_lower_side_above_the_upper_one_is_an_error_not_a_width)
{
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  EXPECT_DOUBLE_EQ(relative_width(0.75 * I, I, 0.), 0.25);
  EXPECT_NO_THROW(relative_width((1. + 1e-13) * I, I, 1e-12));
  EXPECT_THROW(relative_width((1. + 1e-11) * I, I, 1e-12), std::logic_error);
  // One soft direction is enough, though all others have room.
  Eigen::Matrix3d upper = Eigen::Vector3d(1e8, 1., 1.).asDiagonal(), lower = 0.5 * upper;
  lower(1, 1) = 1.0001;
  EXPECT_THROW(relative_width(lower, upper, 1e-9), std::logic_error);
  const Eigen::Matrix3d none = Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(relative_width(none, I, 1e-9), std::logic_error);
  EXPECT_THROW(relative_width(I, none, 1e-9), std::logic_error);
}
