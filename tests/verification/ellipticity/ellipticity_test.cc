// SPDX-License-Identifier: MIT
// Ellipticity against closed forms and a search of all directions.
#include "verification/ellipticity/ellipticity.h"

#include "meshes/plain/sheet.h"
#include "meshes/plain/triangle_kinematics.h"
#include "tests/verification/law/law_cases.h"
#include "verification/ellipticity/first_loss.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace homespun;
using namespace homespun::verification;
using tests::orthotropic;

namespace
{
/// A yarn of plain-weave, a stiff woven shirt, E/G = 1e4, a soft weft, a negative Poisson's ratio.
std::vector<Eigen::Matrix3d> five_materials()
{
  return {orthotropic(52500., 1500., 0.3, 90.), orthotropic(2017., 2035., 0.005, 105.),
          orthotropic(1e4, 1e2, 0.2, 1.), orthotropic(205., 1014., 0.01, 20.),
          orthotropic(300., 200., -0.4, 25.)};
}

/// The stress (a n):A:(a n) over many directions of both.
double searched(const Eigen::Matrix4d &A, const int n_directions)
{
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n_directions; ++i)
    for (int j = 0; j < n_directions; ++j)
    {
      const double n = M_PI * i / n_directions, a = M_PI * j / n_directions;
      Eigen::Vector4d wave;
      wave << std::cos(a) * std::cos(n), std::cos(a) * std::sin(n), std::sin(a) * std::cos(n),
        std::sin(a) * std::sin(n);
      least = std::min(least, wave.dot(A * wave));
    }
  return least;
}

Eigen::Matrix2d diagonal(const double l1, const double l2)
{
  return Eigen::Vector2d(l1, l2).asDiagonal();
}
} // namespace

TEST(exact_ellipticity, the_least_wave_is_that_of_a_search_of_all_directions)
{
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 200; ++k)
  {
    Eigen::Matrix4d A =
      Eigen::Matrix4d::NullaryExpr([&](Eigen::Index, Eigen::Index) { return normal(random); });
    A                     = (A + A.transpose()).eval();
    const LeastWave found = least_wave(A);
    Eigen::Vector4d wave;
    wave << found.motion(0) * found.normal, found.motion(1) * found.normal;
    const double size = A.norm();
    EXPECT_NEAR(wave.dot(A * wave), found.stiffness, 1e-12 * size);
    const double by_search = searched(A, 360);
    EXPECT_LE(found.stiffness, by_search + 1e-13 * size);
    // A search that is off by half a step in both angles errs by at most 2 |A| (pi/720)² ~ 4e-5.
    EXPECT_GE(found.stiffness, by_search - 4e-5 * 4. * size);
  }
}

TEST(bound_ellipticity, what_is_certainly_above_is_above_and_most_of_it_is_told)
{
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  int n_told = 0;
  for (int k = 0; k < 2000; ++k)
  {
    // Definite ones, some of them nearly those of an isotropic phase, and any.
    Eigen::Matrix4d A =
      Eigen::Matrix4d::NullaryExpr([&](Eigen::Index, Eigen::Index) { return normal(random); });
    A = (k % 2 == 0 ? Eigen::Matrix4d(A * A.transpose()) : Eigen::Matrix4d(A + A.transpose()));
    if (k % 4 == 0)
      A = 1e-3 * A +
          response(Law::biot, orthotropic(2.6, 2.6, 0.3, 1.), Eigen::Matrix2d::Identity()).tangent;
    const double least = least_wave(A).stiffness;
    for (const double part : {0., 0.5, 0.9, 0.99, 0.9999, 1., 1.0001, 2.})
    {
      const double bound = part * std::abs(least);
      if (!every_wave_is_above(A, bound))
        continue;
      EXPECT_GT(least, bound);
      ++n_told;
    }
    if (k % 4 == 0) // and not told too seldom
    {
      EXPECT_TRUE(every_wave_is_above(A, (1. - 1e-4) * least)) << k;
    }
  }
  EXPECT_GT(n_told, 1000);
}

TEST(exact_ellipticity, a_mesh_has_the_least_of_its_triangles)
{
  // Told for most of them without a search, and the same to the last bit.
  meshes::TriangleMesh mesh = meshes::coarse_sheet({0., 0.}, Eigen::Matrix2d::Identity(), 12, 12);
  const std::vector<Eigen::Matrix3d> stiffness = {orthotropic(2.6, 2.6, 0.3, 1.),
                                                  orthotropic(1e4, 1e2, 0., 1.)};
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    mesh.material(t) = t % 2;
  for (const Law law : {Law::biot, Law::green, Law::yarn})
    for (const double size : {1e-5, 1e-4, 1e-3, 1e-2})
    {
      meshes::Points moved = mesh.vertices;
      for (Eigen::Index v = 0; v < moved.rows(); ++v)
        moved.row(v) += size * Eigen::RowVector2d(normal(random), normal(random));
      const auto found = ellipticity_of_phases(mesh, stiffness, law, moved);
      for (const int phase : {0, 1})
      {
        const EllipticityOfLaw its(law, stiffness[static_cast<std::size_t>(phase)]);
        double least = 1.;
        int n_lost   = 0;
        for (int t = phase; t < mesh.n_triangles(); t += 2)
        {
          const double value = its.at(meshes::deformation_gradient<2>(mesh, t, moved));
          least              = std::min(least, value);
          n_lost += value > 0. ? 0 : 1;
        }
        EXPECT_EQ(found[static_cast<std::size_t>(phase)].least, least) << name_of(law) << size;
        EXPECT_EQ(found[static_cast<std::size_t>(phase)].n_lost, n_lost) << name_of(law) << size;
      }
    }
}

TEST(exact_ellipticity, the_tangent_of_biot_across_the_axes_has_its_closed_form)
{
  for (const Eigen::Matrix3d &C : five_materials())
    for (const auto &[l1, l2] : {std::pair{1.2, 0.9}, {0.8, 1.1}, {1.3, 1.25}})
    {
      const Response here = response(Law::biot, C, diagonal(l1, l2));
      const double T1 = here.stress(0), T2 = here.stress(3);
      EXPECT_NEAR(here.tangent(1, 1),
                  (4. * C(2, 2) * l1 * l1 - T1 * l1 + T2 * (l2 + 2. * l1)) / std::pow(l1 + l2, 2),
                  1e-14 * C.norm());
      EXPECT_NEAR(response(Law::green, C, diagonal(l1, l2)).tangent(2, 2),
                  response(Law::green, C, diagonal(l1, l2)).stress(0) / l1 + C(2, 2) * l2 * l2,
                  1e-14 * C.norm());
    }
}

TEST(exact_ellipticity, biot_is_lost_in_tension_where_the_stress_is_four_times_the_shear)
{
  for (const Eigen::Matrix3d &C : five_materials())
    for (const int axis : {1, 2})
    {
      const double loss = uniaxial_loss(Law::biot, C, axis);
      const double E = 1. / C.inverse()(axis - 1, axis - 1), ratio = 4. * C(2, 2) / E;
      if (ratio / (1. - ratio) > 1. || ratio > 1.)
      {
        EXPECT_EQ(loss, never);
        continue;
      }
      const Eigen::Matrix2d F = uniaxial_gradient(Law::biot, C, axis, Direction::tension, loss);
      const double T          = response(Law::biot, C, F).stress(axis == 1 ? 0 : 3);
      EXPECT_NEAR(T, 4. * C(2, 2) * (1. + loss), 1e-6 * T);
      EXPECT_NEAR(loss, ratio / (1. - ratio), 1e-6 * loss);
    }
}

TEST(exact_ellipticity, biot_and_green_are_lost_in_compression_where_fibres_kink)
{
  for (const Eigen::Matrix3d &C : five_materials())
  {
    const double biot          = uniaxial_loss(Law::biot, C, 1, Direction::compression);
    const Eigen::Matrix2d at_b = uniaxial_gradient(Law::biot, C, 1, Direction::compression, biot);
    const double T             = response(Law::biot, C, at_b).stress(0);
    EXPECT_NEAR(T * (at_b(0, 0) + 2. * at_b(1, 1)), -4. * C(2, 2) * std::pow(at_b(1, 1), 2),
                1e-6 * std::abs(T) * 3.);
    const double green         = uniaxial_loss(Law::green, C, 1, Direction::compression);
    const Eigen::Matrix2d at_g = uniaxial_gradient(Law::green, C, 1, Direction::compression, green);
    const double S             = response(Law::green, C, at_g).stress(0) / at_g(0, 0);
    EXPECT_NEAR(S, -C(2, 2) * std::pow(at_g(1, 1), 2), 1e-6 * std::abs(S));
  }
}

TEST(exact_ellipticity, green_is_kept_in_tension_and_so_is_biot_where_shear_is_stiff)
{
  const auto kept_to = [](const Law law, const Eigen::Matrix3d &C, const double largest)
  {
    for (const int axis : {1, 2})
      EXPECT_EQ(first_loss(
                  law, C,
                  [&](const double s)
                  { return uniaxial_gradient(law, C, axis, Direction::tension, s); },
                  largest),
                never);
  };
  for (const Eigen::Matrix3d &C : five_materials())
    kept_to(Law::green, C, 0.5);
  kept_to(Law::biot, orthotropic(4., 4., 0.3, 1.), 1.);
  for (const double nu : {0., 0.3, 0.49})
    kept_to(Law::biot, orthotropic(1., 1., nu, 0.5 / (1. + nu)), 1.);
}

TEST(exact_ellipticity, an_isotropic_biot_is_lost_under_equal_pressure_at_twice_the_shear)
{
  const Eigen::Matrix3d C = orthotropic(1., 1., 0.3, 0.5 / 1.3);
  const auto pressed      = [](const double s) { return diagonal(1. - s, 1. - s); };
  const double loss       = first_loss(Law::biot, C, pressed, 0.9);
  EXPECT_NEAR(response(Law::biot, C, pressed(loss)).stress(0), -2. * C(2, 2) * (1. - loss), 1e-6);
}

TEST(invariant_ellipticity, it_turns_with_the_cloth_and_is_one_at_rest)
{
  const double c = std::cos(0.6), s = std::sin(0.6);
  Eigen::Matrix3d T; // of the stress, into axes turned by 0.6
  T << c * c, s * s, -2. * c * s, s * s, c * c, 2. * c * s, c * s, -c * s, c * c - s * s;
  Eigen::Matrix2d R;
  R << c, -s, s, c;
  for (const Eigen::Matrix3d &C : five_materials())
    for (const Law law : {Law::biot, Law::green})
    {
      const EllipticityOfLaw straight(law, C), turned(law, T * C * T.transpose());
      EXPECT_DOUBLE_EQ(straight.at(Eigen::Matrix2d::Identity()), 1.);
      for (const double l1 : {0.9, 1.001, 1.01, 1.1})
      {
        const double value = straight.at(diagonal(l1, 0.97));
        // Q(n) is formed from terms as large as C, of which the least wave keeps C66.
        const double limit = 1e-13 * C.norm() / C(2, 2) * (1. + std::abs(value));
        EXPECT_NEAR(turned.at(R * diagonal(l1, 0.97) * R.transpose()), value, limit);
        EXPECT_NEAR(straight.at(R * diagonal(l1, 0.97)), value, limit);
      }
    }
}

TEST(exact_ellipticity, triangles_are_counted_by_phase)
{
  meshes::TriangleMesh mesh = meshes::coarse_sheet({0., 0.}, Eigen::Matrix2d::Identity(), 1, 1);
  mesh.material << 0, 1;
  meshes::Points moved = mesh.vertices;
  moved.col(0) *= 1.01;
  const auto found = ellipticity_of_phases(
    mesh, {orthotropic(1e4, 1e2, 0., 1.), orthotropic(4., 4., 0., 2.)}, Law::biot, moved);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].n_triangles + found[1].n_triangles, 2);
  EXPECT_EQ(found[0].n_lost, 1);
  EXPECT_EQ(found[1].n_lost, 0);
  EXPECT_LT(found[0].least, 0.);
  EXPECT_GT(found[1].least, 0.9);
}
