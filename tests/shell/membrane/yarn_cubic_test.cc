// SPDX-License-Identifier: MIT
// A cubic energy beside the law of yarns: its derivatives, its third order, and what the
// corotational law with the same one has in common with it.
#include "shell/membrane/membrane.h"
#include "shell/membrane/yarn_energy.h"
#include "tests/refusal.h"
#include "tests/shell/dimensions.h"
#include "tests/shell/shell_cases.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::shell;
using homespun::tests::Dimensions;
using homespun::tests::InPlaneAndSpace;
using homespun::tests::refusal;

namespace
{
/// Of moderate anisotropy, its axes askew, so that the next order is small at some per cent.
Eigen::Matrix3d stiffness()
{
  Eigen::Matrix3d C;
  C << 9., 2., 1.5, 2., 4., 0.5, 1.5, 0.5, 3.;
  return C;
}

meshes::CubicForm some_form()
{
  meshes::CubicForm form;
  form.derivatives << 1., -2., 0.5, 3., 0.7, -1.1, 2.2, 0.3, -0.6, 1.9;
  return form;
}

/// One triangle of a membrane with axes that are not those of the sheet.
Membrane sheet(const bool of_yarns, const meshes::CubicForm &form)
{
  Membrane result = membrane(tests::irregular_sheet(2), {stiffness()});
  add_cubic_energy(result, {form});
  if (of_yarns)
    take_yarn_law(result);
  return result;
}
} // namespace

template <typename Dim>
using derivative_yarn_cubic = InPlaneAndSpace<Dim>;
TYPED_TEST_SUITE(derivative_yarn_cubic, Dimensions);

// Within the reach of the cubic form, and where it is damped.
TYPED_TEST(derivative_yarn_cubic, taylor_remainders_are_of_second_and_third_order)
{
  constexpr int dim            = TypeParam::value;
  const meshes::YarnAxes yarns = meshes::yarn_axes(stiffness());
  const GuardedCubic cubic(cubic_of_yarn_strain(some_form(), yarns), yarns.C);
  std::mt19937 generator(11);
  int n_trusted = 0;
  for (int k = 0; k < 20; ++k)
  {
    const DeformationGradient<dim> F =
      tests::rotation<dim>(0.4 * k) *
      (DeformationGradient<dim>(DeformationGradient<dim>::Identity()) +
       (k % 2 ? 0.4 : 0.05) * tests::random_matrix<DeformationGradient<dim>>(generator));
    n_trusted += cubic.is_trusted(yarn_strain<dim>(F, yarns));
    const auto direction = tests::random_matrix<DeformationGradient<dim>>(generator);
    const Eigen::Map<const Eigen::Matrix<double, 2 * dim, 1>> d(direction.data());
    const double value  = yarn_energy_density<dim>(F, yarns, &cubic),
                 first  = yarn_energy_gradient<dim>(F, yarns, &cubic).cwiseProduct(direction).sum(),
                 second = d.dot(yarn_energy_hessian<dim>(F, yarns, Hessian::exact, &cubic) * d);
    std::vector<double> steps, without_second, with_second;
    for (double h = 1. / 1024.; h > 5e-5; h *= 0.5)
    {
      const double remainder =
        yarn_energy_density<dim>(DeformationGradient<dim>(F + h * direction), yarns, &cubic) -
        value - h * first;
      steps.push_back(h);
      without_second.push_back(std::abs(remainder));
      with_second.push_back(std::abs(remainder - 0.5 * h * h * second));
    }
    EXPECT_NEAR(tests::slope(steps, without_second), 2., 0.1) << "case " << k;
    // More where the third derivative happens to be small.
    EXPECT_GT(tests::slope(steps, with_second), 2.85) << "case " << k;
  }
  EXPECT_GT(n_trusted, 5);
  EXPECT_LT(n_trusted, 20);
}

// Whatever the law, ½ E.C.E + W3(E) is what it has up to third order: what is left is of fourth,
// and of third where the cubic form of the yarns is left out.
TEST(order_yarn_cubic, yarns_and_corotational_law_agree_up_to_the_fourth_order)
{
  const Membrane corotational = sheet(false, some_form()), yarns = sheet(true, some_form());
  Membrane without = yarns;
  without.cubic.clear();
  const auto difference = [&](const Membrane &of, const double strain)
  {
    Positions<2> x = of.vertices;
    x.col(0) += strain * (0.7 * of.vertices.col(0) + 0.4 * of.vertices.col(1));
    x.col(1) += strain * (-0.3 * of.vertices.col(1) + 0.1 * of.vertices.col(0));
    return std::abs(membrane_energy<2>(of, x) - membrane_energy<2>(corotational, x));
  };
  const auto order = [&](const Membrane &of)
  { return std::log2(difference(of, 2e-3) / difference(of, 1e-3)); };
  EXPECT_NEAR(order(yarns), 4., 0.1);
  EXPECT_NEAR(order(without), 3., 0.1);
}

TEST(exact_yarn_cubic, a_stiffness_without_axes_keeps_the_cubic_energy_of_the_corotational_law)
{
  Membrane plain = membrane(tests::irregular_sheet(2), {tests::isotropic(2., 0.3)});
  add_cubic_energy(plain, {some_form()});
  const Membrane before = plain;
  take_yarn_law(plain);
  const Positions<2> x = 1.02 * plain.vertices;
  EXPECT_EQ(membrane_energy<2>(plain, x), membrane_energy<2>(before, x));
}

TYPED_TEST(derivative_yarn_cubic, of_a_mesh_forces_and_stiffness_are_those_of_its_energy)
{
  constexpr int dim               = TypeParam::value;
  const Membrane of_yarns         = sheet(true, some_form());
  const meshes::TriangleMesh mesh = tests::irregular_sheet(2);
  std::mt19937 generator(12);
  const auto some = [&]()
  { return tests::random_matrix<Positions<dim>>(generator, mesh.n_vertices(), dim); };
  const Positions<dim> x = 1.05 * tests::embedded<dim>(mesh) + 3e-4 * some(), d = 1e-2 * some();
  const double work = membrane_gradient<dim>(of_yarns, x).gradient.cwiseProduct(d).sum();
  double curvature  = 0.;
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    Eigen::Matrix<double, 3 * dim, 1> local;
    for (int k = 0; k < 3; ++k)
      local.template segment<dim>(k * dim) = d.row(of_yarns.triangles(t, k)).transpose();
    curvature += local.dot(membrane_hessian<dim>(of_yarns, t, x, Hessian::exact) * local);
  }
  std::vector<double> steps, without_second, with_second;
  for (double h = 1. / 64.; h > 1e-3; h *= 0.5)
  {
    const double remainder = membrane_energy<dim>(of_yarns, Positions<dim>(x + h * d)) -
                             membrane_energy<dim>(of_yarns, x) - h * work;
    steps.push_back(h);
    without_second.push_back(std::abs(remainder));
    with_second.push_back(std::abs(remainder - 0.5 * h * h * curvature));
  }
  EXPECT_NEAR(tests::slope(steps, without_second), 2., 0.1);
  EXPECT_NEAR(tests::slope(steps, with_second), 3., 0.2);
}
