// SPDX-License-Identifier: MIT
// Waves of a pressed sheet on a foundation against those of one material, and of stripes, whose
// waves an ordinary differential equation has.
#include "homogenization/bracket/plate_waves.h"
#include "tests/homogenization/bracket/bending_cells.h"
#include "tests/homogenization/cell/cells.h"

#include <gtest/gtest.h>

#include <unsupported/Eigen/MatrixFunctions>

#include <cmath>
#include <complex>

using namespace homespun;
using namespace homespun::homogenization;

namespace
{
constexpr double poisson = 0.3, period = 0.01, gauge = 5e-4;
const double pi = std::acos(-1.);
const Eigen::Vector2d x(1., 0.), y(0., 1.);

Eigen::Matrix3d bends(const double E)
{
  return tests::plate(E, poisson, gauge);
}

Eigen::Matrix3d stretches(const double E)
{
  return gauge * tests::isotropic_stiffness(E, poisson);
}

/// Stripes along x, of both stiffnesses [Pa] one half each.
struct Stripes
{
  Stripes(const double soft, const double hard, const Eigen::Vector2d &pressed_along,
          const int n_along = 4, const int n_across = 20)
      : cell(tests::bracket_cell(tests::square_lattice(period), n_along, n_across, {},
                                 [](double, double f2) { return f2 < 0.5 ? 0 : 1; }))
      , mesh(glued(cell.mesh, cell.lattice))
      , stress(stress_of_compression(mesh, {stretches(soft), stretches(hard)}, pressed_along))
      , waves(mesh, {bends(soft), bends(hard)}, stress)
      , D(solve_plate_cell(mesh, {bends(soft), bends(hard)}).stiffness)
  {
  }

  const tests::BracketCell cell;
  const TorusMesh mesh;
  const Eigen::Matrix3Xd stress;
  const PlateWaves waves;
  const Eigen::Matrix3d D; ///< D^H
};

/// det(T − exp(i k a)) exp(−2 i k a), real, T over a cell of w, w', M = D w'', V = M' + s w', with
/// V' = −K w: zero where D w'''' + s w'' + K w = 0 has a wave.
double determinant_of_stripes(const double wavenumber, const double compression,
                              const double foundation)
{
  Eigen::Matrix4d over_cell = Eigen::Matrix4d::Identity();
  for (const double E : {1e6, 1e7})
  {
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    A(0, 1)           = 1.;
    A(1, 2)           = 1. / bends(E)(1, 1);
    A(2, 3)           = 1.;
    A(2, 1)           = -compression;
    A(3, 0)           = -foundation;
    over_cell         = ((A * (0.5 * period)).exp() * over_cell).eval();
  }
  const auto turn = std::polar(1., wavenumber * period);
  const Eigen::Matrix4cd less =
    over_cell.cast<std::complex<double>>() - turn * Eigen::Matrix4cd::Identity();
  return std::real(less.determinant() / (turn * turn));
}
} // namespace

TEST(exact_plate_waves, of_one_material_are_those_of_its_stiffness_in_any_direction)
{
  const double E = 1e6, D = bends(E)(1, 1);
  for (const double angle : {0., 0.5 * pi, 0.3})
  {
    const Eigen::Vector2d n(std::cos(angle), std::sin(angle));
    const Stripes one(E, E, n, 12, 12);
    const double k = 2. * pi / (4. * period), K = D * std::pow(k, 4);
    for (const double part : {0.6, 1., 1.7})
    {
      const double q        = part * k;
      const double expected = D * q * q + K / (q * q), found = one.waves.compression(q * n, K);
      EXPECT_NEAR(found / expected, 1., 2e-4) << angle << ' ' << part;
      EXPECT_GT(found, expected * (1. - 1e-9)) << "conforming triangles are too stiff";
    }
    const WrinkleOnset onset = one.waves.onset(n, 1.1 * k, K);
    EXPECT_NEAR(onset.wavenumber / k, 1., 2e-4);
    EXPECT_NEAR(onset.compression / (2. * std::sqrt(K * D)), 1., 2e-4);
  }
}

TEST(exact_plate_waves, across_stripes_are_those_of_an_ordinary_differential_equation)
{
  const Stripes stripes(1e6, 1e7, y);
  for (const double cells : {2.5, 4., 8.})
  {
    const double k = 2. * pi / (cells * period), K = stripes.D(1, 1) * std::pow(k, 4);
    const double found = stripes.waves.compression(k * y, K);
    EXPECT_LT(determinant_of_stripes(k, found * (1. - 1e-3), K) *
                determinant_of_stripes(k, found * (1. + 1e-5), K),
              0.)
      << cells;
    // None begins before.
    const double sign = determinant_of_stripes(k, 1e-6 * found, K);
    for (double part = 0.02; part < 0.995; part += 0.02)
      EXPECT_GT(determinant_of_stripes(k, part * found, K) * sign, 0.) << cells << ' ' << part;
  }
}

// With a foundation that makes D^H wrinkle in waves of so many cells.
TEST(order_plate_waves, the_homogenized_sheet_errs_by_order_two_in_cells_per_wave)
{
  const Stripes stripes(1e6, 1e7, y);
  const auto off = [&](const double cells)
  {
    const double k = 2. * pi / (cells * period), K = stripes.D(1, 1) * std::pow(k, 4);
    const WrinkleOnset onset = stripes.waves.onset(y, k, K);
    return Eigen::Vector2d(k / onset.wavenumber - 1.,
                           onset.compression / (2. * std::sqrt(K * stripes.D(1, 1))) - 1.);
  };
  const Eigen::Vector2d few = off(10.), many = off(20.);
  for (int what = 0; what < 2; ++what)
    EXPECT_NEAR(std::log2(few(what) / many(what)), 2., 0.1) << what << few << many;
  // Of the differential equation, by numpy.
  const Eigen::Vector2d fewest = off(4.);
  EXPECT_NEAR(fewest(0), -0.027, 0.001);
  EXPECT_NEAR(fewest(1), -0.043, 0.001);
}

TEST(exact_plate_waves, stress_of_a_compression_is_in_equilibrium_with_it)
{
  for (const double angle : {0., 0.7, 2.})
  {
    const Eigen::Vector2d n(std::cos(angle), std::sin(angle));
    const Stripes stripes(1e6, 1e7, n);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (int t = 0; t < stripes.mesh.n_triangles(); ++t)
      mean += stripes.stress.col(t) / stripes.mesh.n_triangles(); // all are as large
    EXPECT_NEAR((mean + Eigen::Vector3d(n(0) * n(0), n(1) * n(1), n(0) * n(1))).norm(), 0., 1e-9);
    // Across the stripes it is the same in both.
    EXPECT_NEAR((stripes.stress.row(1).array() - mean(1)).abs().maxCoeff(), 0., 1e-9);
  }
}
