// SPDX-License-Identifier: MIT
// The law of yarns that cannot be pressed: against the element of the coarse cloth, which is
// written apart; its derivatives; what a solver adds; which triangles it relaxes.
#include "meshes/plain/yarn_axes.h"
#include "shell/membrane/tension_field.h"
#include "tests/verification/reference/law_cases.h"
#include "verification/laws/ellipticity.h"
#include "verification/laws/worst_triangle.h"
#include "verification/reference/space_laws.h"
#include "verification/yarns/tension_field.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

using namespace homespun;
using meshes::yarn_axes;
using tests::orthotropic;
using namespace homespun::verification;

namespace
{
/// Yarns of a weave, two fabrics, and a stiffness with couplings [N/m].
std::vector<Eigen::Matrix3d> some_stiffnesses()
{
  Eigen::Matrix3d coupled;
  coupled << 5., 1.1, 0.4, 1.1, 2., -0.3, 0.4, -0.3, 0.9;
  return {orthotropic(52500., 1500., 0.3, 90.), orthotropic(2035., 2017., 0.005, 105.),
          orthotropic(300., 200., -0.4, 25.), coupled};
}

SpaceGradient some_gradient(std::mt19937 &generator)
{
  std::uniform_real_distribution<double> random(-0.2, 0.2);
  SpaceGradient F = SpaceGradient::Identity();
  return F.unaryExpr([&](const double entry) { return entry + random(generator); });
}

Eigen::Matrix2d in_plane(const SpaceGradient &F)
{
  return Eigen::Rotation2Dd(0.7).toRotationMatrix() * F.topRows<2>();
}

/// A reference's answers against the element, whose entries stand column by column.
template <int dim>
void expect_alike(const shell::TensionField<dim> &element, const double energy,
                  const shell::DeformationGradient<dim> &stress,
                  const shell::GradientHessian<dim> &tangent, const double size)
{
  EXPECT_NEAR(element.energy, energy, 1e-11 * size);
  EXPECT_LT((element.gradient - stress).norm(), 1e-9 * size);
  shell::GradientHessian<dim> in_order;
  for (int k = 0; k < 2 * dim; ++k)
    for (int l = 0; l < 2 * dim; ++l)
      in_order(k, l) = element.hessian(dim * (k % 2) + k / 2, dim * (l % 2) + l / 2);
  EXPECT_LT((in_order - tangent).norm(), 1e-6 * size);
}

int number_of(const shell::TensionState state)
{
  return static_cast<int>(state);
}
} // namespace

TEST(exact_tension_law, the_element_of_the_coarse_cloth_written_apart_is_the_same_law)
{
  std::mt19937 generator(7);
  std::array<int, 3> n = {0, 0, 0};
  for (const Eigen::Matrix3d &C : some_stiffnesses())
    for (int k = 0; k < 100; ++k)
    {
      const SpaceGradient F    = some_gradient(generator);
      const Eigen::Matrix2d F2 = in_plane(F);
      const auto flat          = shell::tension_field<2>(F2, yarn_axes(C));
      const Response there     = response(Law::yarn_tension, C, F2);
      Eigen::Matrix2d P;
      P << there.stress(0), there.stress(1), there.stress(2), there.stress(3);
      expect_alike<2>(flat, there.energy, P, there.tangent, C.norm());
      EXPECT_EQ(number_of(flat.state), static_cast<int>(cloth_state(C, F2)));
      ++n[static_cast<std::size_t>(number_of(flat.state))];
      const SpaceResponse in_space = space_response(Law::yarn_tension, C, F, Tangent::exact);
      expect_alike<3>(shell::tension_field<3>(F, yarn_axes(C)), in_space.energy, in_space.stress,
                      in_space.tangent, C.norm());
    }
  for (const int of_state : n)
    EXPECT_GT(of_state, 20);
}

TEST(exact_tension_law, a_phase_without_axes_keeps_biot)
{
  const Eigen::Matrix3d alike = orthotropic(3., 3., 0.3, 1.5 / 1.3);
  Eigen::Matrix2d F;
  F << 0.9, 0.1, 0., 1.1;
  EXPECT_EQ(response(Law::yarn_tension, alike, F).energy, response(Law::biot, alike, F).energy);
  EXPECT_EQ(cloth_state(alike, F), ClothState::taut);
}

TEST(derivative_tension_law, stress_and_tangent_leave_remainders_of_order_two_and_three)
{
  std::mt19937 generator(9);
  Eigen::Vector4d direction(0.7, -0.5, 0.9, 0.4);
  int n_wrinkled = 0;
  for (const Eigen::Matrix3d &C : some_stiffnesses())
    for (int k = 0; k < 60; ++k)
    {
      const Eigen::Matrix2d F = in_plane(some_gradient(generator));
      const auto moved        = [&](const double h) -> Eigen::Matrix2d
      {
        Eigen::Matrix2d by;
        by << direction(0), direction(1), direction(2), direction(3);
        return F + h * by;
      };
      const ClothState state = cloth_state(C, F);
      if (state == ClothState::slack || cloth_state(C, moved(0.005)) != state)
        continue;
      n_wrinkled += state == ClothState::wrinkled ? 1 : 0;
      const Response at    = response(Law::yarn_tension, C, F);
      const auto remainder = [&](const double h, const double second)
      {
        return std::abs(response(Law::yarn_tension, C, moved(h)).energy - at.energy -
                        h * at.stress.dot(direction) -
                        0.5 * second * h * h * direction.dot(at.tangent * direction));
      };
      const auto order = [&](const double second)
      { return std::log2(remainder(0.002, second) / remainder(0.002 / 16., second)) / 4.; };
      EXPECT_NEAR(order(0.), 2., 0.1) << name_of(Law::yarn_tension) << k;
      EXPECT_NEAR(order(1.), 3., 0.3) << name_of(Law::yarn_tension) << k;
    }
  EXPECT_GT(n_wrinkled, 40);
}

TEST(exact_tension_law, no_state_is_lost_and_what_is_relaxed_is_counted)
{
  // Three triangles: at rest, pulled along a yarn and pressed across it, pressed both ways.
  meshes::TriangleMesh mesh;
  mesh.vertices.resize(9, 2);
  meshes::Points moved(9, 2);
  const std::array<Eigen::Vector2d, 3> stretch = {
    Eigen::Vector2d(1., 1.), Eigen::Vector2d(1.01, 0.98), Eigen::Vector2d(0.99, 0.98)};
  mesh.triangles.resize(3, 3);
  mesh.material = Eigen::VectorXi::Zero(3);
  for (int t = 0; t < 3; ++t)
  {
    mesh.triangles.row(t) << 3 * t, 3 * t + 1, 3 * t + 2;
    mesh.vertices.middleRows<3>(3 * t) << 0., 0., 1., 0., 0., 1.;
    moved.middleRows<3>(3 * t) =
      mesh.vertices.middleRows<3>(3 * t) * stretch[static_cast<std::size_t>(t)].asDiagonal();
  }
  const Eigen::Matrix3d C = some_stiffnesses()[0];
  const PhaseEllipticity relaxed =
    ellipticity_of_phases(mesh, {C}, Law::yarn_tension, moved).front();
  EXPECT_EQ(relaxed.n_lost, 0);
  EXPECT_EQ(relaxed.n_wrinkled, 1);
  EXPECT_EQ(relaxed.n_slack, 1);
  EXPECT_FALSE(worst_triangle(mesh, {C}, Law::yarn_tension, moved).is_lost);
  const PhaseEllipticity carried = ellipticity_of_phases(mesh, {C}, Law::yarn, moved).front();
  EXPECT_EQ(carried.n_lost, 1); // the one that is pressed both ways
  EXPECT_EQ(carried.n_wrinkled + carried.n_slack, 0);
}

TEST(bound_tension_law, the_law_is_elliptic_or_neutral_in_every_state)
{
  std::mt19937 generator(11);
  for (const Eigen::Matrix3d &C : some_stiffnesses())
  {
    const EllipticityOfLaw ellipticity(Law::yarn_tension, C);
    for (int k = 0; k < 500; ++k)
      EXPECT_GE(ellipticity.at(in_plane(some_gradient(generator))), -1e-9);
  }
}
