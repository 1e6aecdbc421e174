// SPDX-License-Identifier: MIT
#include "meshes/plain/symmetric_eigen.h"
#include "tests/shell/dimensions.h"
#include "tests/shell/shell_cases.h"

#include <gtest/gtest.h>

#include <limits>

using namespace homespun;
using namespace homespun::shell;
using homespun::tests::Dimensions;
using homespun::tests::InPlaneAndSpace;

namespace
{
/// A stretch of moderate size, turned by an angle; not inverted.
template <int dim>
DeformationGradient<dim> some_gradient(std::mt19937 &generator)
{
  DeformationGradient<dim> F = 0.3 * tests::random_matrix<DeformationGradient<dim>>(generator);
  F(0, 0) += 1.;
  F(1, 1) += 1.;
  return tests::rotation<dim>(3. * generator() / double(std::mt19937::max())) * F;
}

/// ½ (U − I):D:(U − I) by way of the eigenvectors of C, nothing of the closed form.
template <int dim>
double energy_by_eigenvalues(const DeformationGradient<dim> &F, const Eigen::Matrix3d &D)
{
  const auto eigen = meshes::symmetric_eigen<2>(F.transpose() * F);
  const Eigen::Matrix2d E =
    eigen.vectors * eigen.values.cwiseSqrt().asDiagonal() * eigen.vectors.transpose() -
    Eigen::Matrix2d::Identity();
  const Eigen::Vector3d e(E(0, 0), E(1, 1), 2. * E(0, 1));
  return 0.5 * e.dot(D * e);
}

/// Orders of the Taylor remainders with the given gradient and tangent along a direction.
template <int dim>
std::pair<double, double>
taylor_orders(const DeformationGradient<dim> &F, const DeformationGradient<dim> &direction,
              const Eigen::Matrix3d &D, const DeformationGradient<dim> &gradient,
              const GradientHessian<dim> &hessian)
{
  const Eigen::Map<const Eigen::Matrix<double, 2 * dim, 1>> d(direction.data());
  const double value = energy_density<dim>(F, D), first = gradient.cwiseProduct(direction).sum(),
               second = d.dot(hessian * d);
  std::vector<double> steps, without_second, with_second;
  for (double h = 1. / 256.; h > 2e-4; h *= 0.5)
  {
    const double remainder =
      energy_density<dim>(DeformationGradient<dim>(F + h * direction), D) - value - h * first;
    steps.push_back(h);
    without_second.push_back(std::abs(remainder));
    with_second.push_back(std::abs(remainder - 0.5 * h * h * second));
  }
  return {tests::slope(steps, without_second), tests::slope(steps, with_second)};
}
} // namespace

// gtest's typed suites carry their label as every suite does: by the first word of their name.
template <typename Dim>
using exact_corotational_energy = InPlaneAndSpace<Dim>;
TYPED_TEST_SUITE(exact_corotational_energy, Dimensions);
template <typename Dim>
using derivative_corotational_energy = InPlaneAndSpace<Dim>;
TYPED_TEST_SUITE(derivative_corotational_energy, Dimensions);
template <typename Dim>
using invariant_corotational_energy = InPlaneAndSpace<Dim>;
TYPED_TEST_SUITE(invariant_corotational_energy, Dimensions);
template <typename Dim>
using bound_corotational_energy = InPlaneAndSpace<Dim>;
TYPED_TEST_SUITE(bound_corotational_energy, Dimensions);
template <typename Dim>
using tripwire_corotational_energy = InPlaneAndSpace<Dim>;
TYPED_TEST_SUITE(tripwire_corotational_energy, Dimensions);

TYPED_TEST(exact_corotational_energy, equals_the_energy_of_the_eigen_decomposition)
{
  constexpr int dim = TypeParam::value;
  std::mt19937 generator(1);
  for (int k = 0; k < 100; ++k)
  {
    const auto F          = some_gradient<dim>(generator);
    const double expected = energy_by_eigenvalues<dim>(F, tests::anisotropic());
    EXPECT_NEAR(energy_density<dim>(F, tests::anisotropic()), expected, 1e-12 * (expected + 1.));
  }
}

TYPED_TEST(derivative_corotational_energy, taylor_remainders_are_of_second_and_third_order)
{
  constexpr int dim = TypeParam::value;
  std::mt19937 generator(2);
  for (int k = 0; k < 20; ++k)
  {
    const auto F            = some_gradient<dim>(generator);
    const auto direction    = tests::random_matrix<DeformationGradient<dim>>(generator);
    const Eigen::Matrix3d D = k % 2 ? tests::anisotropic() : tests::isotropic(2., 0.3);
    const auto [first, second] =
      taylor_orders<dim>(F, direction, D, energy_gradient<dim>(F, D), energy_hessian<dim>(F, D));
    EXPECT_NEAR(first, 2., 0.1) << "case " << k;
    EXPECT_NEAR(second, 3., 0.1) << "case " << k;
  }
}

TEST(derivative_corotational_energy_inverted, taylor_remainders_in_the_plane_beyond_the_collapse)
{
  DeformationGradient<2> F, direction;
  F << 0.9, 0.3, 0.2, -0.4;
  direction << 0.3, 0.7, -0.5, 0.4;
  const auto D = tests::anisotropic();
  const auto [first, second] =
    taylor_orders<2>(F, direction, D, energy_gradient<2>(F, D), energy_hessian<2>(F, D));
  EXPECT_NEAR(first, 2., 0.1);
  EXPECT_NEAR(second, 3., 0.1);
}

TYPED_TEST(tripwire_corotational_energy, a_hessian_without_its_geometric_term_is_noticed)
{
  constexpr int dim = TypeParam::value;
  std::mt19937 generator(3);
  const auto F         = some_gradient<dim>(generator);
  const auto direction = tests::random_matrix<DeformationGradient<dim>>(generator);
  const auto D         = tests::isotropic(2., 0.3);
  // The rest Hessian, turned with the triangle: what stiffness warping uses.
  DeformationGradient<dim> rest = DeformationGradient<dim>::Zero();
  rest(0, 0) = rest(1, 1) = 1.;
  const auto [first, second] =
    taylor_orders<dim>(F, direction, D, energy_gradient<dim>(F, D), energy_hessian<dim>(rest, D));
  EXPECT_NEAR(first, 2., 0.1);
  EXPECT_LT(second, 2.5);
}

TYPED_TEST(invariant_corotational_energy, any_rotation_of_the_rest_state_has_no_energy_and_no_force)
{
  constexpr int dim             = TypeParam::value;
  DeformationGradient<dim> rest = DeformationGradient<dim>::Zero();
  rest(0, 0) = rest(1, 1) = 1.;
  const auto D            = tests::anisotropic();
  for (const double angle : {0., 1e-8, 0.3, 1.5707963267948966, 3.1415926535897931, 4., 6.28})
  {
    const DeformationGradient<dim> F = tests::rotation<dim>(angle) * rest;
    EXPECT_LT(energy_density<dim>(F, D), 1e-26 * D.norm()) << angle;
    EXPECT_LT(energy_gradient<dim>(F, D).norm(), 1e-14 * D.norm()) << angle;
  }
}

TYPED_TEST(invariant_corotational_energy, rotations_turn_the_stress_and_keep_the_energy)
{
  constexpr int dim = TypeParam::value;
  std::mt19937 generator(4);
  const auto D = tests::anisotropic();
  for (int k = 0; k < 20; ++k)
  {
    const auto F                      = some_gradient<dim>(generator);
    const auto R                      = tests::rotation<dim>(0.7 * k);
    const DeformationGradient<dim> RF = R * F;
    EXPECT_NEAR(energy_density<dim>(RF, D), energy_density<dim>(F, D), 1e-12 * D.norm());
    EXPECT_LT((energy_gradient<dim>(RF, D) - R * energy_gradient<dim>(F, D)).norm(),
              1e-12 * D.norm());
  }
}

TYPED_TEST(exact_corotational_energy, the_hessian_at_rest_is_the_linear_stiffness)
{
  constexpr int dim             = TypeParam::value;
  DeformationGradient<dim> rest = DeformationGradient<dim>::Zero();
  rest(0, 0) = rest(1, 1)                 = 1.;
  Eigen::Matrix<double, 3, 2 *dim> strain = Eigen::Matrix<double, 3, 2 * dim>::Zero();
  strain(0, 0) = strain(1, dim + 1) = strain(2, 1) = strain(2, dim) = 1.;
  const auto D                                                      = tests::anisotropic();
  const GradientHessian<dim> stiffness = strain.transpose() * D * strain;
  EXPECT_LT((energy_hessian<dim>(rest, D) - stiffness).norm(), 1e-14 * D.norm());
}

TYPED_TEST(bound_corotational_energy,
           the_projected_hessian_is_positive_and_changes_nothing_positive)
{
  constexpr int dim = TypeParam::value;
  std::mt19937 generator(5);
  const auto D    = tests::anisotropic();
  int n_projected = 0;
  for (int k = 0; k < 50; ++k)
  {
    const DeformationGradient<dim> F = (k % 2 ? 0.6 : 1.2) * some_gradient<dim>(generator);
    const auto exact                 = energy_hessian<dim>(F, D);
    const auto projected             = energy_hessian<dim>(F, D, Hessian::projected);
    const Eigen::VectorXd before     = meshes::symmetric_eigen<Eigen::Dynamic>(exact).values,
                          after      = meshes::symmetric_eigen<Eigen::Dynamic>(projected).values;
    EXPECT_GE(after(0), -1e-12 * D.norm());
    if (before(0) >= 0.)
      EXPECT_EQ((exact - projected).norm(), 0.);
    else
    {
      EXPECT_LT(after(0), 1e-11 * D.norm());
      ++n_projected;
    }
    // It only adds, and no more than it must: what was negative becomes singular.
    const Eigen::VectorXd added = meshes::symmetric_eigen<Eigen::Dynamic>(projected - exact).values;
    EXPECT_GE(added(0), -1e-11 * D.norm());
  }
  EXPECT_GT(n_projected, 0);
}

TYPED_TEST(bound_corotational_energy, degenerate_gradients_have_finite_symmetric_answers)
{
  constexpr int dim = TypeParam::value;
  std::vector<DeformationGradient<dim>> cases;
  const auto add = [&](const double a, const double b, const double c, const double d)
  {
    DeformationGradient<dim> F = DeformationGradient<dim>::Zero();
    F.template topRows<2>() << a, b, c, d;
    cases.push_back(F);
  };
  add(0., 0., 0., 0.);    // a point
  add(1., 0., 0., 0.);    // a line
  add(1., 1., 1., 1.);    // another line
  add(1., 0., 0., -1.);   // a reflection
  add(0., 2., 2., 0.);    // a reflection, scaled
  add(-1., 0., 0., -1.);  // 180 degrees
  add(1., 0., 0., 1e-17); // a line to round-off
  for (const double scale : {1e-30, 1e-10, 1e10, 1e30})
    add(scale, 0.1 * scale, 0., -0.5 * scale);
  for (const auto &F : cases)
  {
    const auto D         = tests::anisotropic();
    const auto hessian   = energy_hessian<dim>(F, D),
               projected = energy_hessian<dim>(F, D, Hessian::projected);
    EXPECT_TRUE(std::isfinite(energy_density<dim>(F, D))) << F;
    EXPECT_GE(energy_density<dim>(F, D), 0.) << F;
    EXPECT_TRUE((energy_gradient<dim>(F, D).allFinite())) << F;
    EXPECT_TRUE(hessian.allFinite()) << F;
    EXPECT_TRUE(projected.allFinite()) << F;
    EXPECT_LE((hessian - hessian.transpose()).norm(), 1e-12 * hessian.norm()) << F;
  }
}

TYPED_TEST(bound_corotational_energy, not_a_number_comes_out_as_such)
{
  constexpr int dim          = TypeParam::value;
  DeformationGradient<dim> F = DeformationGradient<dim>::Identity();
  F(1, 0)                    = std::numeric_limits<double>::quiet_NaN();
  const auto D               = tests::isotropic(1., 0.3);
  EXPECT_TRUE(std::isnan(energy_density<dim>(F, D)));
  EXPECT_FALSE((energy_gradient<dim>(F, D).allFinite()));
  EXPECT_FALSE((energy_hessian<dim>(F, D, Hessian::projected).allFinite()));
}

TEST(exact_corotational_energy_inverted,
     in_the_plane_a_mirrored_triangle_costs_energy_in_space_it_is_at_rest)
{
  const auto D = tests::isotropic(1., 0.3);
  DeformationGradient<2> mirrored;
  mirrored << 1., 0., 0., -0.9;
  DeformationGradient<3> folded = DeformationGradient<3>::Zero();
  folded(0, 0)                  = 1.;
  folded(1, 1)                  = -1.;
  EXPECT_GT(energy_density<2>(mirrored, D), 0.5);
  EXPECT_LT(energy_density<3>(folded, D), 1e-30);
  // Along the way through the collapse the energy in the plane only grows, without a kink.
  double before = 0.;
  for (double stretch = 1.; stretch > -0.9; stretch -= 0.1)
  {
    mirrored(1, 1) = stretch;
    EXPECT_GE(energy_density<2>(mirrored, D), before);
    before = energy_density<2>(mirrored, D);
  }
}
