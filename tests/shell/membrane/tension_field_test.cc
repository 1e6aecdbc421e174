// SPDX-License-Identifier: MIT
#include "shell/membrane/tension_field.h"
#include "shell/membrane/yarn_energy.h"
#include "tests/shell/dimensions.h"
#include "tests/shell/shell_cases.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace homespun;
using namespace homespun::shell;
using homespun::tests::Dimensions;
using homespun::tests::InPlaneAndSpace;
using meshes::yarn_axes;
using meshes::YarnAxes;

namespace
{
// gtest's typed suites carry their label as every suite does: by the first word of their name.
template <typename Dim>
using exact_tension_field = InPlaneAndSpace<Dim>;
TYPED_TEST_SUITE(exact_tension_field, Dimensions);
template <typename Dim>
using derivative_tension_field = InPlaneAndSpace<Dim>;
TYPED_TEST_SUITE(derivative_tension_field, Dimensions);
template <typename Dim>
using invariant_tension_field = InPlaneAndSpace<Dim>;
TYPED_TEST_SUITE(invariant_tension_field, Dimensions);
template <typename Dim>
using bound_tension_field = InPlaneAndSpace<Dim>;
TYPED_TEST_SUITE(bound_tension_field, Dimensions);
template <typename Dim>
using tripwire_tension_field = InPlaneAndSpace<Dim>;
TYPED_TEST_SUITE(tripwire_tension_field, Dimensions);

/// A weave of unequal yarns that contracts across a pull, along the axes [N/m].
Eigen::Matrix3d weave()
{
  Eigen::Matrix3d C;
  C << 2000., 300., 0., 300., 900., 0., 0., 0., 40.;
  return C;
}

std::vector<YarnAxes> some_yarns()
{
  return {yarn_axes(tests::anisotropic()), yarn_axes(weave())};
}

/// Random gradients, turned; a fifth of each stretch, in all states.
template <int dim>
DeformationGradient<dim> some_gradient(std::mt19937 &generator)
{
  const DeformationGradient<dim> F =
    DeformationGradient<dim>::Identity() +
    0.2 * tests::random_matrix<DeformationGradient<dim>>(generator);
  return tests::rotation<dim>(3. * generator() / double(std::mt19937::max())) * F;
}

constexpr std::array<TensionState, 3> all_states = {TensionState::taut, TensionState::wrinkled,
                                                    TensionState::slack};

/// Second Piola-Kirchhoff stress of a gradient of full rank.
template <int dim>
Eigen::Matrix2d second_piola(const DeformationGradient<dim> &F, const DeformationGradient<dim> &P)
{
  return (F.transpose() * F).inverse() * F.transpose() * P;
}
} // namespace

TYPED_TEST(exact_tension_field, is_the_law_of_yarns_wherever_both_principal_stresses_pull)
{
  constexpr int dim = TypeParam::value;
  std::mt19937 generator(1);
  int n_taut = 0, n_relaxed = 0;
  for (int k = 0; k < 400; ++k)
    for (const YarnAxes &yarns : some_yarns())
    {
      DeformationGradient<dim> F = some_gradient<dim>(generator);
      if (k % 2 == 0)
        F *= 1.2; // more of them in tension
      const TensionField<dim> field    = tension_field<dim>(F, yarns);
      const DeformationGradient<dim> P = yarn_energy_gradient<dim>(F, yarns);
      const double least =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(second_piola<dim>(F, P)).eigenvalues()(0);
      const double size = yarns.C.norm();
      EXPECT_EQ(field.state == TensionState::taut, least >= 0.) << least;
      if (least >= 0.)
      {
        ++n_taut;
        EXPECT_NEAR(field.energy, yarn_energy_density<dim>(F, yarns), 1e-13 * size);
        EXPECT_LT((field.gradient - P).norm(), 1e-13 * size);
        EXPECT_LT((field.hessian - yarn_energy_hessian<dim>(F, yarns)).norm(), 1e-11 * size);
      }
      else
      {
        ++n_relaxed;
        EXPECT_LT(field.energy, yarn_energy_density<dim>(F, yarns));
      }
    }
  EXPECT_GT(n_taut, 50);
  EXPECT_GT(n_relaxed, 50);
}

TYPED_TEST(exact_tension_field, carries_nothing_where_all_stretches_are_below_one)
{
  constexpr int dim = TypeParam::value;
  for (const YarnAxes &yarns : some_yarns())
    for (const Eigen::Vector2d &stretch :
         {Eigen::Vector2d(0.9, 1.), Eigen::Vector2d(0.5, 0.7), Eigen::Vector2d(0.3, 0.)})
      for (const double angle : {0., 0.3, 1.2})
      {
        const Eigen::Matrix2d R       = tests::rotation<2>(angle);
        DeformationGradient<dim> F    = DeformationGradient<dim>::Zero();
        F.template topRows<2>()       = 0.9999999 * R * stretch.asDiagonal() * R.transpose();
        const TensionField<dim> field = tension_field<dim>(F, yarns);
        EXPECT_EQ(field.state, TensionState::slack);
        EXPECT_EQ(field.energy, 0.);
        EXPECT_EQ(field.gradient.norm(), 0.);
        EXPECT_EQ(field.hessian.norm(), 0.);
      }
}

TYPED_TEST(exact_tension_field, pulled_along_a_yarn_the_width_is_free_as_long_as_it_is_too_narrow)
{
  // Free sides: e2 = −C12/C22 e1. A sheet that is narrower is wrinkled and carries the same.
  constexpr int dim       = TypeParam::value;
  const YarnAxes yarns    = yarn_axes(weave());
  const Eigen::Matrix3d C = weave();
  const double young      = C(0, 0) - C(0, 1) * C(0, 1) / C(1, 1);
  for (const double strain : {1e-6, 1e-3, 0.05, 0.3})
  {
    const double natural = 1. - C(0, 1) / C(1, 1) * strain;
    for (const double width : {natural - 1e-7, 0.99 * natural, 0.6 * natural, 0.01})
    {
      const DeformationGradient<dim> F =
        DeformationGradient<dim>::Identity() * Eigen::Vector2d(1. + strain, width).asDiagonal();
      const TensionField<dim> field = tension_field<dim>(F, yarns);
      EXPECT_EQ(field.state, TensionState::wrinkled);
      // A strain is known up to a rounding of 1.
      constexpr double rounding = std::numeric_limits<double>::epsilon();
      EXPECT_NEAR(field.energy, 0.5 * young * strain * strain,
                  young * strain * (1e-11 * strain + 4. * rounding));
      DeformationGradient<dim> P = DeformationGradient<dim>::Zero();
      P(0, 0)                    = young * strain;
      EXPECT_LT((field.gradient - P).norm(), 1e-9 * young * strain) << strain << " " << width;
      EXPECT_NEAR(field.hessian(0, 0), young, 1e-6 * young) << strain << " " << width;
    }
    const DeformationGradient<dim> wide = DeformationGradient<dim>::Identity() *
                                          Eigen::Vector2d(1. + strain, natural + 1e-7).asDiagonal();
    EXPECT_EQ(tension_field<dim>(wide, yarns).state, TensionState::taut);
  }
}

TEST(exact_tension_field_search, no_wrinkle_of_a_search_costs_less)
{
  std::mt19937 generator(3);
  int n_wrinkled = 0;
  for (int k = 0; k < 60; ++k)
    for (const YarnAxes &yarns : some_yarns())
    {
      const DeformationGradient<2> F = some_gradient<2>(generator);
      const TensionField<2> field    = tension_field<2>(F, yarns);
      if (field.state != TensionState::wrinkled)
        continue;
      ++n_wrinkled;
      double least = std::numeric_limits<double>::infinity();
      for (int i = 0; i < 90; ++i)
        for (int j = 0; j <= 60; ++j)
        {
          const double angle = M_PI * i / 90., size = 1.5 * j / 60.;
          DeformationGradient<3> with_wrinkle;
          with_wrinkle << F, size * Eigen::RowVector2d(std::cos(angle), std::sin(angle));
          least = std::min(least, yarn_energy_density<3>(with_wrinkle, yarns));
        }
      EXPECT_LE(field.energy, least * (1. + 1e-12));
    }
  EXPECT_GT(n_wrinkled, 30);
}

TYPED_TEST(derivative_tension_field, taylor_remainders_are_of_second_and_third_order_in_each_state)
{
  constexpr int dim = TypeParam::value;
  std::mt19937 generator(4);
  std::array<int, 2> n = {0, 0};
  for (int k = 0; k < 200; ++k)
  {
    const YarnAxes yarns          = some_yarns()[k % 2 ? 0 : 1];
    const auto F                  = some_gradient<dim>(generator);
    const auto direction          = tests::random_matrix<DeformationGradient<dim>>(generator);
    const TensionField<dim> field = tension_field<dim>(F, yarns);
    // Away from the borders, where the second derivative jumps.
    const auto state_at = [&](const double h)
    { return tension_field<dim>(DeformationGradient<dim>(F + h * direction), yarns).state; };
    if (field.state == TensionState::slack || state_at(0.004) != field.state ||
        state_at(0.002) != field.state || state_at(-0.002) != field.state)
      continue;
    const Eigen::Map<const Eigen::Matrix<double, 2 * dim, 1>> d(direction.data());
    const double slope     = field.gradient.cwiseProduct(direction).sum(),
                 curvature = d.dot(field.hessian * d);
    // Energies are sums of terms of the size of C, however little the relaxed cloth resists.
    const double rounded = 16. * std::numeric_limits<double>::epsilon() * yarns.C.norm();
    std::vector<double> steps, without_second, with_second;
    for (double h = 1. / 512.; h > 1e-4; h *= 0.5)
    {
      const double remainder =
        tension_field<dim>(DeformationGradient<dim>(F + h * direction), yarns).energy -
        field.energy - h * slope;
      if (const double third = std::abs(remainder - 0.5 * h * h * curvature); third > rounded)
      {
        steps.push_back(h);
        without_second.push_back(std::abs(remainder));
        with_second.push_back(third);
      }
    }
    if (steps.size() < 3)
      continue;
    ++n[field.state == TensionState::taut ? 0 : 1];
    EXPECT_NEAR(tests::slope(steps, without_second), 2., 0.15) << "case " << k;
    // More where the third derivative happens to be small.
    EXPECT_GT(tests::slope(steps, with_second), 2.75) << "case " << k;
  }
  EXPECT_GT(n[0], 5);
  EXPECT_GT(n[1], 20);
}

TYPED_TEST(derivative_tension_field, the_stress_has_no_jump_where_the_state_changes)
{
  // Along lines through all three states: what the stress changes by over a step goes with the
  // step.
  constexpr int dim = TypeParam::value;
  std::mt19937 generator(5);
  int n_changes = 0;
  for (int k = 0; k < 20; ++k)
  {
    const YarnAxes yarns = some_yarns()[k % 2 ? 0 : 1];
    const auto from = some_gradient<dim>(generator), to = some_gradient<dim>(generator);
    const int n              = 4000;
    TensionField<dim> before = tension_field<dim>(from, yarns);
    for (int i = 1; i <= n; ++i)
    {
      const double t = static_cast<double>(i) / n;
      const TensionField<dim> here =
        tension_field<dim>(DeformationGradient<dim>((1. - t) * from + t * to), yarns);
      if (here.state != before.state)
      {
        ++n_changes;
        const double bound = (here.hessian.norm() + before.hessian.norm()) * (to - from).norm() / n;
        EXPECT_LT((here.gradient - before.gradient).norm(), 1.1 * bound);
      }
      before = here;
    }
  }
  EXPECT_GT(n_changes, 30);
}

TYPED_TEST(invariant_tension_field, rotations_turn_the_stress_and_the_tangent_and_keep_the_energy)
{
  constexpr int dim = TypeParam::value;
  std::mt19937 generator(6);
  for (int k = 0; k < 50; ++k)
    for (const YarnAxes &yarns : some_yarns())
    {
      const auto F                   = some_gradient<dim>(generator);
      const auto R                   = tests::rotation<dim>(0.7 * k);
      const TensionField<dim> field  = tension_field<dim>(F, yarns),
                              turned = tension_field<dim>(DeformationGradient<dim>(R * F), yarns);
      const double size              = yarns.C.norm();
      EXPECT_EQ(turned.state, field.state);
      EXPECT_NEAR(turned.energy, field.energy, 1e-12 * size);
      EXPECT_LT((turned.gradient - R * field.gradient).norm(), 1e-9 * size);
      GradientHessian<dim> turn                   = GradientHessian<dim>::Zero();
      turn.template topLeftCorner<dim, dim>()     = R;
      turn.template bottomRightCorner<dim, dim>() = R;
      EXPECT_LT((turned.hessian - turn * field.hessian * turn.transpose()).norm(), 1e-8 * size);
      // Turned over in its plane, a triangle is what it is.
      DeformationGradient<dim> over = F;
      over.row(0) *= -1.;
      EXPECT_NEAR(tension_field<dim>(over, yarns).energy, field.energy, 1e-12 * size);
    }
}

TYPED_TEST(bound_tension_field, carries_no_compression_and_its_positive_part_is_one)
{
  constexpr int dim = TypeParam::value;
  std::mt19937 generator(7);
  for (int k = 0; k < 300; ++k)
    for (const YarnAxes &yarns : some_yarns())
    {
      const auto F                     = some_gradient<dim>(generator);
      const TensionField<dim> field    = tension_field<dim>(F, yarns),
                              positive = tension_field<dim>(F, yarns, Hessian::projected);
      // A sum of terms of the size of C, however little is left of them.
      const double size = std::max(field.hessian.norm(), yarns.C.norm());
      EXPECT_GE(field.energy, 0.);
      const Eigen::Vector2d stress =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(second_piola<dim>(F, field.gradient))
          .eigenvalues();
      EXPECT_GE(stress(0), -1e-10 * yarns.C.norm());
      const Eigen::SelfAdjointEigenSolver<GradientHessian<dim>> eigen(positive.hessian);
      EXPECT_GE(eigen.eigenvalues()(0), -1e-12 * size);
      // Not below what it is the positive part of.
      const Eigen::SelfAdjointEigenSolver<GradientHessian<dim>> more(positive.hessian -
                                                                     field.hessian);
      EXPECT_GE(more.eigenvalues()(0), -1e-11 * size);
    }
}

TYPED_TEST(bound_tension_field, folds_never_pay_however_deep)
{
  // Convex along every a n, which strong ellipticity asks for point by point: midpoints of pairs.
  constexpr int dim = TypeParam::value;
  std::mt19937 generator(8);
  int n_of_yarn = 0;
  for (int k = 0; k < 4000; ++k)
  {
    const YarnAxes yarns = some_yarns()[k % 2 ? 0 : 1];
    const auto F         = some_gradient<dim>(generator);
    const double depth   = k % 3 == 0 ? 0.3 : k % 3 == 1 ? 0.03 : 0.003;
    const DeformationGradient<dim> fold =
      depth * tests::random_matrix<Eigen::Matrix<double, dim, 1>>(generator) *
      tests::random_matrix<Eigen::RowVector2d>(generator).normalized();
    const auto gain = [&](const auto &energy)
    {
      return 0.5 * (energy(DeformationGradient<dim>(F + fold)) +
                    energy(DeformationGradient<dim>(F - fold))) -
             energy(F);
    };
    const auto relaxed = [&](const DeformationGradient<dim> &at)
    { return tension_field<dim>(at, yarns).energy; };
    EXPECT_GE(gain(relaxed), -1e-12 * (yarns.C.norm() + relaxed(F)));
    n_of_yarn += gain([&](const DeformationGradient<dim> &at)
                      { return yarn_energy_density<dim>(at, yarns); }) < -1e-9 * yarns.C.norm()
                   ? 1
                   : 0;
  }
  EXPECT_GT(n_of_yarn, 100); // the law of yarns itself is lost in many of them
}

TYPED_TEST(tripwire_tension_field, what_is_no_number_or_has_no_size_is_answered)
{
  constexpr int dim                    = TypeParam::value;
  const YarnAxes yarns                 = yarn_axes(weave());
  const DeformationGradient<dim> point = DeformationGradient<dim>::Zero();
  EXPECT_EQ(tension_field<dim>(point, yarns).energy, 0.);
  DeformationGradient<dim> line = point; // both yarns along one line, one of them pulled
  line(0, 0)                    = 1.2;
  line(0, 1)                    = 0.4;
  const TensionField<dim> field = tension_field<dim>(line, yarns);
  EXPECT_TRUE(std::isfinite(field.energy) && field.gradient.allFinite() &&
              field.hessian.allFinite());
  EXPECT_EQ(field.state, TensionState::wrinkled);
  line(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(tension_field<dim>(line, yarns).energy));
}
