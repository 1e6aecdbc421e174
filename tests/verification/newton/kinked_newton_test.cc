// SPDX-License-Identifier: MIT
#include "verification/newton/kinked_newton.h"

#include "meshes/plain/errors.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace homespun;
using namespace homespun::verification;

namespace
{
/// f(x) + ½ max(y, 0)². The slope of f is 4 x up to |x| = 1 and grows by ½ from there on, so that
/// whole steps of Newton's method go from 7 to −7 and back; for y < 0 nothing resists.
class Kinked final : public KinkedProblem
{
public:
  NewtonState state() override
  {
    return summary(x);
  }

  double find_step(Tangent, double) override
  {
    const Eigen::Vector2d r = gradient(x);
    const Eigen::Vector2d K(std::abs(x(0)) < 1. ? 4. : 0.5, x(1) > 0. ? 1. : 0.);
    step = -r.cwiseQuotient(K + Eigen::Vector2d::Constant(1e-3 * times));
    all_times.push_back(times);
    return step.dot(r);
  }

  NewtonState at(const double length) override
  {
    trial = x + length * step;
    return summary(trial);
  }

  void keep(double, double) override
  {
    x = trial;
  }

  void steady(const double how_often) override
  {
    times = is_steadied ? how_often : 0.;
  }

  double slope_there() const override
  {
    return gradient(trial).dot(step);
  }

  Eigen::Vector2d x = {7., 3.};
  std::vector<double> all_times;
  bool is_steadied = true;

private:
  static Eigen::Vector2d gradient(const Eigen::Vector2d &at)
  {
    const double a = std::abs(at(0));
    return {std::copysign(a < 1. ? 4. * a : 4. + 0.5 * (a - 1.), at(0)), std::max(at(1), 0.)};
  }

  static NewtonState summary(const Eigen::Vector2d &at)
  {
    const double a = std::abs(at(0)), up = std::max(at(1), 0.);
    NewtonState state;
    state.energy =
      (a < 1. ? 2. * a * a : 2. + 4. * (a - 1.) + 0.25 * (a - 1.) * (a - 1.)) + 0.5 * up * up;
    state.energy_round_off = 1e-15;
    state.residual         = gradient(at).norm();
    state.least            = 1e-12;
    return state;
  }

  Eigen::Vector2d trial, step;
  double times = 0.;
};
} // namespace

TEST(exact_kinked_newton,
     a_minimum_between_kinks_is_found_and_what_nothing_resists_stays_where_it_is)
{
  Kinked problem;
  minimize_with_kinks(problem, {});
  EXPECT_NEAR(problem.x(0), 0., 1e-12);
  EXPECT_LE(problem.x(1), 1e-12); // wherever below
  EXPECT_GT(problem.x(1), -3.);   // and not far: no force goes there
  EXPECT_LT(problem.all_times.size(), 15u);
  // What makes the matrix regular falls, so that the last steps are those of the problem itself.
  EXPECT_LT(problem.all_times.back(), 0.1 * problem.all_times.front());
}

TEST(tripwire_kinked_newton, a_matrix_that_is_not_made_regular_is_noticed)
{
  Kinked problem;
  problem.is_steadied = false;
  problem.x           = {7., -1.}; // where nothing resists the second
  EXPECT_THROW(minimize_with_kinks(problem, {}), meshes::NotConverged);
}
