// SPDX-License-Identifier: MIT
#include "meshes/plain/symmetric_eigen.h"
#include "shell/membrane/yarn_energy.h"
#include "tests/shell/dimensions.h"
#include "tests/shell/shell_cases.h"

#include <gtest/gtest.h>

#include <limits>

using namespace homespun;
using namespace homespun::shell;
using homespun::tests::Dimensions;
using homespun::tests::InPlaneAndSpace;
using meshes::yarn_axes;
using meshes::YarnAxes;

namespace
{
/// A stiffness with all couplings, and that of a weave.
std::vector<YarnAxes> some_yarns()
{
  return {yarn_axes(tests::anisotropic()), yarn_axes(tests::plain_weave())};
}

template <int dim>
DeformationGradient<dim> at_rest()
{
  return DeformationGradient<dim>::Identity();
}

/// A stretch of moderate size, turned by an angle; not inverted.
template <int dim>
DeformationGradient<dim> some_gradient(std::mt19937 &generator)
{
  const DeformationGradient<dim> F =
    at_rest<dim>() + 0.3 * tests::random_matrix<DeformationGradient<dim>>(generator);
  return tests::rotation<dim>(3. * generator() / double(std::mt19937::max())) * F;
}

/// Orders of the Taylor remainders with the given gradient and tangent along a direction.
template <int dim>
std::pair<double, double>
taylor_orders(const DeformationGradient<dim> &F, const DeformationGradient<dim> &direction,
              const YarnAxes &yarns, const DeformationGradient<dim> &gradient,
              const GradientHessian<dim> &hessian)
{
  const Eigen::Map<const Eigen::Matrix<double, 2 * dim, 1>> d(direction.data());
  const double value = yarn_energy_density<dim>(F, yarns),
               first = gradient.cwiseProduct(direction).sum(), second = d.dot(hessian * d);
  std::vector<double> steps, without_second, with_second;
  for (double h = 1. / 1024.; h > 5e-5; h *= 0.5)
  {
    const double remainder =
      yarn_energy_density<dim>(DeformationGradient<dim>(F + h * direction), yarns) - value -
      h * first;
    steps.push_back(h);
    without_second.push_back(std::abs(remainder));
    with_second.push_back(std::abs(remainder - 0.5 * h * h * second));
  }
  return {tests::slope(steps, without_second), tests::slope(steps, with_second)};
}
} // namespace

// gtest's typed suites carry their label as every suite does: by the first word of their name.
template <typename Dim>
using exact_yarn_energy = InPlaneAndSpace<Dim>;
TYPED_TEST_SUITE(exact_yarn_energy, Dimensions);
template <typename Dim>
using derivative_yarn_energy = InPlaneAndSpace<Dim>;
TYPED_TEST_SUITE(derivative_yarn_energy, Dimensions);
template <typename Dim>
using invariant_yarn_energy = InPlaneAndSpace<Dim>;
TYPED_TEST_SUITE(invariant_yarn_energy, Dimensions);
template <typename Dim>
using bound_yarn_energy = InPlaneAndSpace<Dim>;
TYPED_TEST_SUITE(bound_yarn_energy, Dimensions);
template <typename Dim>
using tripwire_yarn_energy = InPlaneAndSpace<Dim>;
TYPED_TEST_SUITE(tripwire_yarn_energy, Dimensions);

TYPED_TEST(exact_yarn_energy, is_that_of_the_stretches_and_of_the_angle_between_the_yarns)
{
  // Yarns laid down at 0.2 and at a right angle less gamma from it: the closed form is what went
  // in.
  constexpr int dim = TypeParam::value;
  const double l1 = 1.1, l2 = 0.95;
  for (const double gamma : {0.7, -0.4, 0.})
    for (const YarnAxes &yarns : some_yarns())
    {
      Eigen::Matrix2d f;
      f.col(0)                   = l1 * tests::rotation<2>(0.2).col(0);
      f.col(1)                   = l2 * tests::rotation<2>(0.2 - gamma).col(1);
      DeformationGradient<dim> F = at_rest<dim>();
      F.template topRows<2>()    = f * yarns.axes.transpose();
      F                          = tests::rotation<dim>(1.1) * F;
      const Eigen::Vector3d e(l1 - 1., l2 - 1., gamma);
      EXPECT_LT((yarn_strain<dim>(F, yarns) - e).norm(), 1e-14);
      const double energy = 0.5 * e.dot(yarns.C * e);
      EXPECT_NEAR(yarn_energy_density<dim>(F, yarns), energy, 1e-12 * energy);
    }
}

TYPED_TEST(derivative_yarn_energy, taylor_remainders_are_of_second_and_third_order)
{
  constexpr int dim = TypeParam::value;
  std::mt19937 generator(2);
  for (int k = 0; k < 20; ++k)
  {
    const auto F               = some_gradient<dim>(generator);
    const auto direction       = tests::random_matrix<DeformationGradient<dim>>(generator);
    const YarnAxes yarns       = some_yarns()[k % 2 ? 0 : 1];
    const auto [first, second] = taylor_orders<dim>(
      F, direction, yarns, yarn_energy_gradient<dim>(F, yarns), yarn_energy_hessian<dim>(F, yarns));
    EXPECT_NEAR(first, 2., 0.1) << "case " << k;
    EXPECT_NEAR(second, 3., 0.1) << "case " << k;
  }
}

TYPED_TEST(tripwire_yarn_energy, a_hessian_without_its_geometric_term_is_noticed)
{
  constexpr int dim = TypeParam::value;
  std::mt19937 generator(3);
  const auto F         = some_gradient<dim>(generator);
  const auto direction = tests::random_matrix<DeformationGradient<dim>>(generator);
  const YarnAxes yarns = some_yarns()[0];
  const auto [first, second] =
    taylor_orders<dim>(F, direction, yarns, yarn_energy_gradient<dim>(F, yarns),
                       yarn_energy_hessian<dim>(at_rest<dim>(), yarns));
  EXPECT_NEAR(first, 2., 0.1);
  EXPECT_LT(second, 2.5);
}

TEST(derivative_yarn_energy_inverted, taylor_remainders_in_the_plane_of_a_triangle_turned_over)
{
  DeformationGradient<2> F, direction;
  F << 0.9, 0.3, 0.2, -0.4;
  direction << 0.3, 0.7, -0.5, 0.4;
  for (const YarnAxes &yarns : some_yarns())
  {
    const auto [first, second] = taylor_orders<2>(
      F, direction, yarns, yarn_energy_gradient<2>(F, yarns), yarn_energy_hessian<2>(F, yarns));
    EXPECT_NEAR(first, 2., 0.1);
    EXPECT_NEAR(second, 3., 0.1);
  }
}

TYPED_TEST(invariant_yarn_energy, rotations_turn_the_stress_and_the_tangent_and_keep_the_energy)
{
  constexpr int dim = TypeParam::value;
  std::mt19937 generator(4);
  for (int k = 0; k < 20; ++k)
    for (const YarnAxes &yarns : some_yarns())
    {
      const auto F                      = some_gradient<dim>(generator);
      const auto R                      = tests::rotation<dim>(0.7 * k);
      const DeformationGradient<dim> RF = R * F;
      const double size                 = yarns.C.norm();
      EXPECT_NEAR(yarn_energy_density<dim>(RF, yarns), yarn_energy_density<dim>(F, yarns),
                  1e-12 * size);
      EXPECT_LT(
        (yarn_energy_gradient<dim>(RF, yarns) - R * yarn_energy_gradient<dim>(F, yarns)).norm(),
        1e-12 * size);
      GradientHessian<dim> turn                   = GradientHessian<dim>::Zero();
      turn.template topLeftCorner<dim, dim>()     = R;
      turn.template bottomRightCorner<dim, dim>() = R;
      EXPECT_LT((yarn_energy_hessian<dim>(RF, yarns) -
                 turn * yarn_energy_hessian<dim>(F, yarns) * turn.transpose())
                  .norm(),
                1e-12 * size);
      // What is at rest stays so.
      const DeformationGradient<dim> turned = R * at_rest<dim>();
      EXPECT_LT(yarn_energy_density<dim>(turned, yarns), 1e-26 * size);
      EXPECT_LT(yarn_energy_gradient<dim>(turned, yarns).norm(), 1e-14 * size);
    }
}

TYPED_TEST(exact_yarn_energy, the_hessian_at_rest_is_that_of_the_corotational_energy)
{
  constexpr int dim = TypeParam::value;
  for (const Eigen::Matrix3d &C : {tests::anisotropic(), tests::plain_weave()})
    EXPECT_LT((yarn_energy_hessian<dim>(at_rest<dim>(), yarn_axes(C)) -
               energy_hessian<dim>(at_rest<dim>(), C))
                .norm(),
              1e-13 * C.norm());
}

TYPED_TEST(bound_yarn_energy, the_projected_hessian_is_positive_and_changes_nothing_positive)
{
  constexpr int dim = TypeParam::value;
  std::mt19937 generator(5);
  int n_projected = 0, n_kept = 0;
  for (int k = 0; k < 200; ++k)
    for (const YarnAxes &yarns : some_yarns())
    {
      const DeformationGradient<dim> F = (k % 2 ? 0.6 : 1.4) * some_gradient<dim>(generator);
      const double size                = yarns.C.norm();
      const auto exact                 = yarn_energy_hessian<dim>(F, yarns);
      const auto projected             = yarn_energy_hessian<dim>(F, yarns, Hessian::projected);
      const Eigen::VectorXd before     = meshes::symmetric_eigen<Eigen::Dynamic>(exact).values,
                            after      = meshes::symmetric_eigen<Eigen::Dynamic>(projected).values,
                            added =
                              meshes::symmetric_eigen<Eigen::Dynamic>(projected - exact).values;
      EXPECT_GE(after(0), -1e-12 * size);
      EXPECT_GE(added(0), -1e-12 * size);
      if (before(0) >= 0.)
      {
        ++n_kept;
        EXPECT_LT((exact - projected).norm(), 1e-13 * size);
      }
      else
        ++n_projected;
      // The nearest one: what is added is the negative part, eigenvalue by eigenvalue.
      EXPECT_NEAR((projected - exact).norm(), before.cwiseMin(0.).norm(), 1e-12 * size);
    }
  EXPECT_GT(n_projected, 20);
  EXPECT_GT(n_kept, 20);
}

TYPED_TEST(bound_yarn_energy, degenerate_gradients_have_finite_symmetric_derivatives)
{
  constexpr int dim = TypeParam::value;
  std::vector<DeformationGradient<dim>> cases;
  const auto add = [&](const double a, const double b, const double c, const double d)
  {
    DeformationGradient<dim> F = DeformationGradient<dim>::Zero();
    F.template topRows<2>() << a, b, c, d;
    cases.push_back(F);
  };
  add(0., 0., 0., 0.);   // a point
  add(1., 0., 0., 0.);   // a line, the second yarn gone
  add(1., 1., 1., 1.);   // a line
  add(1., -1., 1., -1.); // a line, the yarns opposite
  add(1., 0., 0., -1.);  // a reflection
  add(-1., 0., 0., -1.); // 180 degrees
  for (const double scale : {1e-30, 1e-10, 1e10, 1e30})
    add(scale, 0.1 * scale, 0., -0.5 * scale);
  const YarnAxes yarns = yarn_axes(tests::plain_weave());
  for (const auto &F : cases)
  {
    const auto hessian   = yarn_energy_hessian<dim>(F, yarns),
               projected = yarn_energy_hessian<dim>(F, yarns, Hessian::projected);
    EXPECT_GE(yarn_energy_density<dim>(F, yarns), 0.) << F;
    EXPECT_TRUE((yarn_energy_gradient<dim>(F, yarns).allFinite())) << F;
    EXPECT_TRUE(hessian.allFinite()) << F;
    EXPECT_TRUE(projected.allFinite()) << F;
    EXPECT_LE((hessian - hessian.transpose()).norm(), 1e-12 * hessian.norm()) << F;
  }
  EXPECT_EQ(yarn_energy_density<dim>(cases[1], yarns), std::numeric_limits<double>::infinity());
}

TYPED_TEST(bound_yarn_energy, not_a_number_comes_out_as_such)
{
  constexpr int dim          = TypeParam::value;
  DeformationGradient<dim> F = at_rest<dim>();
  F(1, 0)                    = std::numeric_limits<double>::quiet_NaN();
  const YarnAxes yarns       = yarn_axes(tests::plain_weave());
  EXPECT_TRUE(std::isnan(yarn_energy_density<dim>(F, yarns)));
  EXPECT_FALSE((yarn_energy_gradient<dim>(F, yarns).allFinite()));
  EXPECT_FALSE((yarn_energy_hessian<dim>(F, yarns, Hessian::projected).allFinite()));
}
