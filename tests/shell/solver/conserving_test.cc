// SPDX-License-Identifier: MIT
// The conserving integrator: what its forces do over a step, what it keeps, what it refuses; and
// that forces which are nearly right are noticed.
#include "meshes/plain/errors.h"
#include "shell/algebra/vertex_matrix.h"
#include "shell/contact/obstacles.h"
#include "shell/membrane/discrete_gradient.h"
#include "shell/terms/bending.h"
#include "shell/terms/lagged_load.h"
#include "shell/terms/warping.h"
#include "shell/terms/wind.h"
#include "tests/refusal.h"
#include "tests/shell/solver/cloth_cases.h"
#include "tests/shell/terms/term_cases.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::shell;
using namespace homespun::tests;

namespace
{
/// Two states of a triangle: each stretched, folded over and turned in its own way.
struct TwoStates
{
  RestTriangle rest;
  Eigen::Matrix3d before, after;
};

TwoStates two_states(std::mt19937 &generator)
{
  Eigen::Matrix<double, 3, 2> corners;
  corners << 0., 0., 0.01, 0.001, 0.003, 0.012;
  const auto state = [&]() -> Eigen::Matrix3d {
    return corners * random_matrix<Eigen::Matrix<double, 3, 2>>(generator, 3, 2).transpose() * 1.5;
  };
  return {rest_triangle(corners), state(), state()};
}

ClothOptions conserving()
{
  ClothOptions options;
  options.integrator = Integrator::conserving;
  return options;
}
} // namespace

TEST(exact_conserving, forces_of_a_triangle_do_the_work_that_its_energy_takes_whatever_the_step)
{
  std::mt19937 generator(2);
  for (int k = 0; k < 200; ++k)
  {
    const TwoStates states  = two_states(generator);
    const Eigen::Matrix3d D = anisotropic();
    const Eigen::Matrix3d g =
      triangle_step(states.rest, states.before, states.after, D, {}).gradient;
    const double before = triangle_energy<3>(states.rest, states.before, D),
                 after  = triangle_energy<3>(states.rest, states.after, D);
    // Round-off of a stress that two nearly flat states share is larger by how flat they are.
    const double work = g.cwiseProduct(states.after - states.before).sum(),
                 size = std::max({before, after, g.norm() * 0.01});
    EXPECT_NEAR(work, after - before, 1e-12 * size) << k;
    EXPECT_LT(g.colwise().sum().norm(), 1e-13 * g.norm());
    EXPECT_LT(torque(0.5 * (states.before + states.after), g).norm(), 1e-13 * g.norm() * 0.02);
    // At rest they are the gradient.
    EXPECT_LT((triangle_step(states.rest, states.after, states.after, D, {}).gradient -
               triangle_gradient<3>(states.rest, states.after, D))
                .norm(),
              1e-9 * triangle_gradient<3>(states.rest, states.after, D).norm());
  }
}

TEST(exact_conserving, a_viscous_triangle_takes_the_work_of_its_rate_of_strain)
{
  std::mt19937 generator(3);
  const double rate = 0.3; // β/h
  for (int k = 0; k < 50; ++k)
  {
    const TwoStates states  = two_states(generator);
    const Eigen::Matrix3d D = anisotropic();
    const Eigen::Matrix3d g =
      triangle_step(states.rest, states.before, states.after, D, {-rate, rate}).gradient;
    const auto strain = [&](const Eigen::Matrix3d &corners)
    { return biot_strain<3>(deformation_gradient<3>(states.rest, corners)); };
    const Eigen::Vector3d change = strain(states.after) - strain(states.before);
    const double expected        = states.rest.area * rate * change.dot(D * change);
    EXPECT_NEAR(g.cwiseProduct(states.after - states.before).sum(), expected,
                1e-12 * std::max(expected, g.norm() * 0.01));
  }
}

TEST(exact_conserving, a_triangle_on_a_line_at_both_ends_of_the_step_has_finite_forces)
{
  Eigen::Matrix<double, 3, 2> corners;
  corners << 0., 0., 0.01, 0.001, 0.003, 0.012;
  const RestTriangle rest      = rest_triangle(corners);
  const Eigen::Vector3d one    = Eigen::Vector3d(0.4, 0.5, -0.3),
                        other  = Eigen::Vector3d(0.1, -0.8, 0.5);
  const Eigen::Matrix3d D      = anisotropic();
  const Eigen::Vector3d places = corners * Eigen::Vector2d(1., 0.7);
  for (const auto &[before, after] :
       {std::pair(Eigen::Matrix3d(places * one.transpose()),
                  Eigen::Matrix3d(1.3 * places * other.transpose())),
        std::pair(Eigen::Matrix3d(places * one.transpose()), Eigen::Matrix3d::Zero().eval()),
        std::pair(Eigen::Matrix3d::Zero().eval(), Eigen::Matrix3d::Zero().eval())})
  {
    const TriangleStep step = triangle_step(rest, before, after, D, {});
    ASSERT_TRUE(step.gradient.allFinite() && step.jacobian.allFinite());
    const double change = triangle_energy<3>(rest, after, D) - triangle_energy<3>(rest, before, D);
    EXPECT_NEAR(step.gradient.cwiseProduct(after - before).sum(), change,
                1e-12 * triangle_energy<3>(rest, before, D));
  }
}

TEST(derivative_conserving, the_matrix_of_a_triangle_is_the_derivative_of_its_forces)
{
  std::mt19937 generator(4);
  for (const StrainWeights &weights : {StrainWeights{}, StrainWeights{-0.3, 0.3}})
  {
    const TwoStates states       = two_states(generator);
    const Eigen::Matrix3d change = 1e-3 * random_matrix<Eigen::Matrix3d>(generator, 3, 3);
    const TriangleStep at =
      triangle_step(states.rest, states.before, states.after, anisotropic(), weights);
    Eigen::Matrix<double, 9, 1> direction;
    for (int k = 0; k < 3; ++k)
      direction.segment<3>(3 * k) = change.row(k).transpose();
    const Eigen::Matrix<double, 9, 1> slopes = at.jacobian * direction;
    std::vector<double> steps, remainders;
    for (double h = 1. / 16.; h > 1e-3; h *= 0.5)
    {
      const Eigen::Matrix3d g =
        triangle_step(states.rest, states.before, states.after + h * change, anisotropic(), weights)
          .gradient;
      Eigen::Matrix3d remainder = g - at.gradient;
      for (int k = 0; k < 3; ++k)
        remainder.row(k) -= h * slopes.segment<3>(3 * k).transpose();
      steps.push_back(h);
      remainders.push_back(remainder.norm());
    }
    EXPECT_NEAR(slope(steps, remainders), 2., 0.1);
  }
}

TEST(invariant_conserving, the_work_of_every_term_is_the_change_of_its_energy_and_it_turns_nothing)
{
  const meshes::ClothMesh mesh = lying_sheet(5);
  std::mt19937 generator(5);
  const int n          = mesh.n_vertices();
  const Vectors before = mesh.positions + 0.01 * random_matrix<Vectors>(generator, n, 3);
  const Vectors after =
    (before + 0.02 * random_matrix<Vectors>(generator, n, 3)) * rotation<3>(2.).transpose();
  const Eigen::VectorXd masses = lumped_masses(mesh, {0.2});
  std::vector<std::unique_ptr<Term>> terms;
  terms.push_back(membrane_term(mesh, {anisotropic()}));
  terms.push_back(membrane_term(mesh, {anisotropic()}, 0.01));
  terms.push_back(viscosity_term(mesh, {anisotropic()}, 0.01));
  terms.push_back(bending_term(mesh, {PlateStiffness::isotropic(1e-4, 0.3)}));
  terms.push_back(gravity_term(masses, earth));
  terms.push_back(mass_damping_term(masses, 2.));
  for (const auto &term : terms)
  {
    ASSERT_TRUE(term->has_discrete_gradient());
    term->begin_step({before, before, 0., 0.005});
    const Vectors g    = discrete_gradient(*term, before, after);
    const double size  = g.rowwise().norm().sum();
    const double taken = g.cwiseProduct(after - before).sum() -
                         (term->stored_energy(after) - term->stored_energy(before));
    const bool is_dissipative =
      term->name() == "viscosity" || term->name() == "damping" || term == terms[1];
    if (is_dissipative)
      EXPECT_GT(taken, 0.) << term->name();
    else
      EXPECT_NEAR(taken, 0., 1e-12 * size * 0.3) << term->name();
    if (term->is_internal())
    {
      EXPECT_LT(g.colwise().sum().norm(), 1e-13 * size) << term->name();
      EXPECT_LT(torque(0.5 * (before + after), g).norm(), 1e-13 * size) << term->name();
    }
  }
}

TEST(invariant_conserving, an_undamped_sheet_keeps_its_energy_however_long_the_step)
{
  const meshes::ClothMesh mesh = lying_sheet(6);
  std::mt19937 generator(6);
  for (const bool is_held : {false, true})
    for (const double h : {1e-4, 1e-3, 5e-3})
    {
      Fabric fabric(mesh, is_held ? std::vector<int>{0, 6} : std::vector<int>{}, conserving(),
                    isotropic(1000., 0.3));
      Cloth &cloth = fabric.cloth;
      cloth.add(bending_term(mesh, {PlateStiffness::isotropic(1e-4, 0.3)}));
      if (is_held)
        cloth.add(gravity_term(fabric.masses, earth));
      Vectors v = 0.5 * random_matrix<Vectors>(generator, mesh.n_vertices(), 3);
      if (is_held)
        v.row(0).setZero(), v.row(6).setZero();
      cloth.set_state(mesh.positions, v, 0.);
      const double energy        = cloth.kinetic_energy() + cloth.stored_energy();
      const Eigen::RowVector3d p = cloth.momentum(), L = cloth.angular_momentum();
      double gained = 0.;
      for (int k = 0; k < 100; ++k)
        gained += cloth.step(h).energy_gained;
      // A hundred steps, each solved to a hundred-thousandth of the tolerance by its last
      // iteration.
      EXPECT_NEAR(cloth.kinetic_energy() + cloth.stored_energy(), energy, 1e-9 * energy) << h;
      EXPECT_LT(gained, 1e-9 * energy) << h;
      if (!is_held)
      {
        EXPECT_LT((cloth.momentum() - p).norm(), 1e-11 * p.norm()) << h;
        EXPECT_LT((cloth.angular_momentum() - L).norm(), 1e-9 * L.norm()) << h;
      }
    }
}

TEST(exact_conserving, a_fall_is_exact_and_the_air_slows_by_the_midpoint_rule)
{
  const meshes::ClothMesh mesh = lying_sheet(4);
  const double h = 0.01, rate = 2.;
  const int n = 100;
  Fabric falling(mesh, {}, conserving()), slowed(mesh, {}, conserving());
  falling.cloth.add(gravity_term(falling.masses, earth));
  slowed.cloth.add(mass_damping_term(slowed.masses, rate));
  Vectors v = Vectors::Zero(mesh.n_vertices(), 3);
  v.rowwise() += Eigen::RowVector3d(0.3, 0.1, -0.2);
  slowed.cloth.set_state(mesh.positions, v, 0.);
  for (int k = 0; k < n; ++k)
  {
    falling.cloth.step(h);
    slowed.cloth.step(h);
  }
  const Vectors expected = mesh.positions.rowwise() + 0.5 * std::pow(n * h, 2) * earth;
  EXPECT_LT((falling.cloth.positions() - expected).cwiseAbs().maxCoeff(), 1e-11);
  const double left = std::pow((1. - 0.5 * rate * h) / (1. + 0.5 * rate * h), n);
  EXPECT_LT((slowed.cloth.velocities() - left * v).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(exact_conserving, a_load_that_is_known_where_a_step_begins_does_its_work)
{
  std::mt19937 generator(4);
  const Vectors before = random_matrix<Vectors>(generator, 5, 3), force = 2. * before;
  const auto term = lagged_load_term("load", [](const Vectors &x) -> Vectors { return 2. * x; });
  term->begin_step({before, before, 0., 0.1});
  ASSERT_TRUE(term->has_discrete_gradient());
  const Vectors after = random_matrix<Vectors>(generator, 5, 3);
  EXPECT_EQ(discrete_gradient(*term, before, after), -force);
  EXPECT_NEAR(term->energy(after) - term->energy(before), -force.cwiseProduct(after - before).sum(),
              1e-13);
}

TEST(bound_conserving, a_step_that_cannot_be_solved_is_cut_counted_and_keeps_what_it_should)
{
  // Three iterations are too few for a step of 5 ms, and enough for a part of it.
  const meshes::ClothMesh mesh  = lying_sheet(6);
  ClothOptions options          = conserving();
  options.max_newton_iterations = 3;
  Fabric fabric(mesh, {}, options, isotropic(1000., 0.3), 1e-3);
  Cloth &cloth = fabric.cloth;
  std::mt19937 generator(8);
  cloth.set_state(mesh.positions, random_matrix<Vectors>(generator, mesh.n_vertices(), 3), 0.);
  const Eigen::RowVector3d p = cloth.momentum(), L = cloth.angular_momentum();
  double energy = cloth.kinetic_energy();
  int cuts      = 0;
  for (int k = 0; k < 5; ++k)
  {
    cuts += cloth.step(5e-3).cuts;
    const double after = cloth.kinetic_energy() + cloth.stored_energy();
    EXPECT_LE(after, energy * (1. + 1e-10));
    energy = after;
  }
  EXPECT_GT(cuts, 0);
  EXPECT_LT((cloth.momentum() - p).norm(), 1e-10 * p.norm());
  EXPECT_LT((cloth.angular_momentum() - L).norm(), 1e-10 * L.norm());
}

TEST(bound_conserving, terms_without_a_discrete_gradient_are_refused_by_name)
{
  const meshes::ClothMesh mesh = lying_sheet(3);
  const auto refused           = [&](std::unique_ptr<Term> term)
  {
    const std::string name = term->name();
    Fabric fabric(mesh, {}, conserving());
    const std::string text = refusal([&] { fabric.cloth.add(std::move(term)); });
    EXPECT_NE(text.find("`" + name + "`"), std::string::npos) << name << ": " << text;
    EXPECT_NE(text.find("discrete gradient"), std::string::npos) << text;
  };
  const Eigen::VectorXd masses = lumped_masses(mesh, {0.2});
  refused(wind_term(mesh, {}));
  refused(pressure_term(mesh, [](double) { return 1.; }));
  refused(obstacle_term({"floor", plane({0., 0., -1.}, {0., 0., 1.}), 0.3, {}}, masses, {}));
  refused(nodal_warping_term(mesh, {isotropic(100., 0.3)}, masses));
}

namespace
{
enum class Fault
{
  none,
  gradient_half_way, ///< the correction is missing: no discrete gradient
  gradient_at_end    ///< and at the wrong place
};

/// A membrane whose forces over a step are nearly right.
class NearlyRight : public Term
{
public:
  NearlyRight(const meshes::ClothMesh &mesh, const Fault fault)
      : membrane(membrane_term(mesh, {isotropic(1000., 0.3)}))
      , fault(fault)
  {
  }
  std::string name() const override
  {
    return membrane->name();
  }
  double energy(const Vectors &x) const override
  {
    return membrane->energy(x);
  }
  void add_gradient(const Vectors &x, Vectors &gradient) const override
  {
    membrane->add_gradient(x, gradient);
  }
  void add_derivatives(const Vectors &, Hessian, Vectors &, BlockMatrix &) const override
  {
  }
  bool has_discrete_gradient() const override
  {
    return true;
  }
  void add_discrete_gradient(const Vectors &old, const Vectors &x, Vectors &gradient,
                             VertexMatrix &jacobian) const override
  {
    // The right matrix: Newton's method converges as fast as it then can.
    Vectors right = Vectors::Zero(x.rows(), 3);
    membrane->add_discrete_gradient(old, x, right, jacobian);
    if (fault == Fault::none)
      gradient += right;
    else if (fault == Fault::gradient_half_way)
      membrane->add_gradient(0.5 * (old + x), gradient);
    else
      membrane->add_gradient(x, gradient);
  }
  std::size_t bytes() const override
  {
    return 0;
  }

private:
  const std::unique_ptr<Term> membrane;
  const Fault fault;
};
} // namespace

TEST(tripwire_conserving, forces_that_are_nearly_right_lose_energy_or_momentum)
{
  const meshes::ClothMesh mesh = lying_sheet(4);
  for (const Fault fault : {Fault::none, Fault::gradient_half_way, Fault::gradient_at_end})
  {
    const Eigen::VectorXd masses = lumped_masses(mesh, {0.2});
    Cloth cloth(mesh.positions, masses, {}, conserving());
    cloth.add(std::make_unique<NearlyRight>(mesh, fault));
    std::mt19937 generator(9);
    Vectors v = 2. * random_matrix<Vectors>(generator, mesh.n_vertices(), 3);
    v += 30. * (mesh.positions * Eigen::Matrix3d(rotation<3>(M_PI / 2.)));
    cloth.set_state(mesh.positions, v, 0.);
    const double energy        = cloth.kinetic_energy();
    const Eigen::RowVector3d L = cloth.angular_momentum();
    for (int k = 0; k < 30; ++k)
      cloth.step(5e-4);
    const double drift = std::abs(cloth.kinetic_energy() + cloth.stored_energy() - energy) / energy,
                 turned = (cloth.angular_momentum() - L).norm() / L.norm();
    if (fault == Fault::none)
    {
      EXPECT_LT(drift, 1e-11);
      EXPECT_LT(turned, 1e-11);
    }
    else
    {
      EXPECT_GT(drift, 1e-5) << static_cast<int>(fault);
    }
    if (fault == Fault::gradient_at_end)
    {
      EXPECT_GT(turned, 1e-5);
    }
  }
}
