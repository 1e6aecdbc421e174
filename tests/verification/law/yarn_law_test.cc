// SPDX-License-Identifier: MIT
// The law of yarns: its axes, its formula, where it is elliptic.
#include "shell/membrane/yarn_energy.h"
#include "tests/verification/law/law_cases.h"
#include "verification/ellipticity/ellipticity.h"
#include "verification/ellipticity/first_loss.h"
#include "verification/law/laws.h"
#include "verification/law/space_laws.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace homespun;
using meshes::yarn_axes;
using meshes::YarnAxes;
using tests::orthotropic;
using tests::rotation;
using tests::some_gradient;
using namespace homespun::verification;

namespace
{
/// A stiffness in axes turned by an angle, as tensor components from a sum over all indices.
Eigen::Matrix3d turned(const Eigen::Matrix3d &C, const double angle)
{
  constexpr int voigt[2][2] = {{0, 2}, {2, 1}};
  const double R[2][2] = {{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}};
  Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
  const int pairs[3][2]  = {{0, 0}, {1, 1}, {0, 1}};
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int i = 0; i < 16; ++i)
      {
        const int p = i / 8, q = i / 4 % 2, r = i / 2 % 2, s = i % 2;
        result(a, b) += R[pairs[a][0]][p] * R[pairs[a][1]][q] * R[pairs[b][0]][r] *
                        R[pairs[b][1]][s] * C(voigt[p][q], voigt[r][s]);
      }
  return result;
}

std::vector<Eigen::Matrix3d> five_materials()
{
  return {orthotropic(52500., 1500., 0.3, 90.), orthotropic(2035., 2017., 0.005, 105.),
          orthotropic(1e4, 1e2, 0.2, 1.), orthotropic(1014., 205., 0.01, 20.),
          orthotropic(300., 200., -0.4, 25.)};
}

/// The element of the coarse cloth against a reference's energy, stress (dim,2) and tangent, whose
/// entries are in the order F11, F12, F21, ...; in the element they stand column by column.
template <int dim>
void expect_alike(const YarnAxes &yarns, const shell::DeformationGradient<dim> &F,
                  const double energy, const shell::DeformationGradient<dim> &stress,
                  const shell::GradientHessian<dim> &tangent)
{
  const auto P = shell::yarn_energy_gradient<dim>(F, yarns);
  const auto H = shell::yarn_energy_hessian<dim>(F, yarns);
  EXPECT_NEAR(shell::yarn_energy_density<dim>(F, yarns), energy, 1e-12 * energy);
  EXPECT_LT((P - stress).norm(), 1e-12 * P.norm());
  shell::GradientHessian<dim> in_order;
  for (int k = 0; k < 2 * dim; ++k)
    for (int l = 0; l < 2 * dim; ++l)
      in_order(k, l) = H(dim * (k % 2) + k / 2, dim * (l % 2) + l / 2);
  EXPECT_LT((in_order - tangent).norm(), 1e-12 * H.norm());
}
} // namespace

TEST(exact_yarn_law, the_element_of_the_coarse_cloth_written_apart_is_the_same_law)
{
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> random(-0.3, 0.3);
  for (const Eigen::Matrix3d &C : five_materials())
    for (const double angle : {0., 0.4, -1.2})
    {
      const Eigen::Matrix3d there = turned(C, angle);
      const YarnAxes yarns        = yarn_axes(there);
      for (int k = 0; k < 10; ++k)
      {
        SpaceGradient F = SpaceGradient::Identity();
        F = F.unaryExpr([&](const double entry) { return entry + random(generator); }).eval();
        const Eigen::Matrix2d in_plane = rotation(k) * F.topRows<2>();
        const Response there_in_plane  = response(Law::yarn, there, in_plane);
        Eigen::Matrix2d stress;
        stress << there_in_plane.stress(0), there_in_plane.stress(1), there_in_plane.stress(2),
          there_in_plane.stress(3);
        expect_alike<2>(yarns, in_plane, there_in_plane.energy, stress, there_in_plane.tangent);
        const SpaceResponse in_space = space_response(Law::yarn, there, F, Tangent::exact);
        expect_alike<3>(yarns, F, in_space.energy, in_space.stress, in_space.tangent);
      }
    }
}

TEST(exact_yarn_law, axes_are_those_of_an_orthotropic_stiffness_and_an_isotropic_one_has_none)
{
  for (const Eigen::Matrix3d &C : five_materials())
    for (const double angle : {0., 0.3, 1.2, -0.9})
    {
      const YarnAxes yarns = yarn_axes(turned(C, angle));
      ASSERT_TRUE(yarns.are_there);
      const Eigen::Vector2d expected = rotation(angle).col(0);
      EXPECT_NEAR(std::abs(yarns.axes.col(0).dot(expected)), 1., 1e-12) << angle;
      EXPECT_LT((yarns.C - C).cwiseAbs().maxCoeff(), 1e-9 * C.norm());
    }
  EXPECT_FALSE(yarn_axes(orthotropic(1., 1., 0.3, 0.5 / 1.3)).are_there);
  const Eigen::Matrix3d alike = orthotropic(3., 3., 0.3, 1.5 / 1.3);
  EXPECT_EQ(response(Law::yarn, alike, some_gradient()).energy,
            response(Law::biot, alike, some_gradient()).energy);
}

TEST(exact_yarn_law, the_energy_is_that_of_stretches_and_of_the_angle_between_the_yarns)
{
  const Eigen::Matrix3d C = five_materials()[3];
  const double angle = 0.4, l1 = 1.1, l2 = 0.95, gamma = 0.7;
  // Yarns at 0.2 and at a right angle less gamma from it.
  Eigen::Matrix2d yarns;
  yarns.col(0)              = l1 * rotation(0.2).col(0);
  yarns.col(1)              = l2 * rotation(0.2 - gamma).col(1);
  const Eigen::Matrix2d F   = yarns * rotation(angle).transpose();
  const Eigen::Vector3d e   = Eigen::Vector3d(l1 - 1., l2 - 1., gamma);
  const double energy       = 0.5 * e.dot(C * e);
  const Eigen::Matrix3d off = turned(C, angle);
  EXPECT_NEAR(response(Law::yarn, off, F).energy, energy, 1e-12 * energy);
  SpaceGradient in_space = SpaceGradient::Zero();
  in_space.topRows<2>()  = F;
  EXPECT_NEAR(space_response(Law::yarn, off, in_space, Tangent::none).energy, energy,
              1e-12 * energy);
}

TEST(exact_yarn_law, it_is_kept_in_tension_and_shear_and_lost_where_a_yarn_is_compressed)
{
  using Path                    = Eigen::Matrix2d (*)(double);
  const std::vector<Path> pulls = {
    [](const double s) -> Eigen::Matrix2d { return Eigen::Vector2d(1. + s, 1.).asDiagonal(); },
    [](const double s) -> Eigen::Matrix2d { return Eigen::Vector2d(1., 1. + s).asDiagonal(); },
    [](const double s) -> Eigen::Matrix2d { return Eigen::Vector2d(1. + s, 1. + s).asDiagonal(); },
    [](const double s) -> Eigen::Matrix2d
    {
      Eigen::Matrix2d F = Eigen::Matrix2d::Identity();
      F(0, 1)           = s;
      return F;
    }};
  for (const Eigen::Matrix3d &C : five_materials())
  {
    for (std::size_t k = 0; k < pulls.size(); ++k)
    {
      const double loss = first_loss(Law::yarn, C, pulls[k], 0.5);
      if (C(0, 1) > 0. || k > 1)
        EXPECT_EQ(loss, never) << k;
      else // what widens when pulled is compressed where its width is held
        EXPECT_NEAR(response(Law::yarn, C, pulls[k](loss)).stress(k == 0 ? 3 : 0), -C(2, 2),
                    1e-6 * C(2, 2));
    }
    for (const int axis : {1, 2})
    {
      EXPECT_EQ(uniaxial_loss(Law::yarn, C, axis), never);
      const double loss       = uniaxial_loss(Law::yarn, C, axis, Direction::compression);
      const Eigen::Matrix2d F = uniaxial_gradient(Law::yarn, C, axis, Direction::compression, loss);
      const double T          = response(Law::yarn, C, F).stress(axis == 1 ? 0 : 3);
      EXPECT_NEAR(T, -C(2, 2) / (1. - loss), 1e-6 * std::abs(T));
    }
  }
}

TEST(invariant_yarn_law, it_turns_with_the_cloth)
{
  for (const Eigen::Matrix3d &C : five_materials())
  {
    const Response straight = response(Law::yarn, C, some_gradient());
    for (const double angle : {0.3, -1.1})
    {
      const Response there =
        response(Law::yarn, turned(C, angle), some_gradient() * rotation(angle).transpose());
      EXPECT_NEAR(there.energy, straight.energy, 1e-11 * straight.energy);
    }
  }
}

TEST(bound_yarn_law, a_triangle_that_is_turned_over_costs_energy_in_the_plane)
{
  const Eigen::Matrix3d C = five_materials()[1];
  double last             = 0.;
  for (const double angle : {0.5, 1.5, 1.6, 2.5, 3.1})
  {
    Eigen::Matrix2d F;
    F.col(0) = Eigen::Vector2d::UnitX();
    F.col(1) = rotation(-angle).col(1);
    EXPECT_GT(response(Law::yarn, C, F).energy, last);
    last = response(Law::yarn, C, F).energy;
  }
  EXPECT_NEAR(last, 0.5 * C(2, 2) * 3.1 * 3.1, 1e-9 * last);
}
