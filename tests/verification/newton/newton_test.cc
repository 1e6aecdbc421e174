// SPDX-License-Identifier: MIT
#include "verification/newton/newton.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/symmetric_eigen.h"
#include "verification/newton/halved_parts.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

using namespace homespun;
using namespace homespun::verification;

namespace
{
/// A function of two numbers with its derivatives.
struct Valley
{
  std::function<double(const Eigen::Vector2d &)> value;
  std::function<Eigen::Vector2d(const Eigen::Vector2d &)> gradient;
  std::function<Eigen::Matrix2d(const Eigen::Vector2d &)> hessian;
};

class InValley final : public NewtonProblem
{
public:
  InValley(Valley valley, const Eigen::Vector2d &start)
      : x(start)
      , valley(std::move(valley))
  {
  }

  NewtonState state() override
  {
    return summary(x);
  }

  double find_step(const Tangent tangent, double) override
  {
    Eigen::Matrix2d K = valley.hessian(x);
    if (tangent == Tangent::projected)
    {
      ++n_projected;
      const auto modes = meshes::symmetric_eigen<2>(K);
      K = modes.vectors * modes.values.cwiseMax(1e-3).asDiagonal() * modes.vectors.transpose();
    }
    const Eigen::LLT<Eigen::Matrix2d> factor(K);
    if (factor.info() != Eigen::Success)
      throw meshes::NotConverged("not definite", {});
    step = -factor.solve(valley.gradient(x));
    return step.dot(valley.gradient(x));
  }

  NewtonState at(const double length) override
  {
    trial = x + length * step;
    return summary(trial);
  }

  void keep(double, double) override
  {
    x = trial;
    residuals.push_back(valley.gradient(x).norm());
  }

  Eigen::Vector2d x;
  std::vector<double> residuals; ///< after each step
  int n_projected = 0;

private:
  NewtonState summary(const Eigen::Vector2d &at) const
  {
    NewtonState state;
    state.energy           = valley.value(at);
    state.energy_round_off = 4. * std::numeric_limits<double>::epsilon();
    state.residual         = valley.gradient(at).norm();
    state.least            = 1e-12;
    return state;
  }

  Valley valley;
  Eigen::Vector2d trial, step;
};

/// (1 − x)² + 100 (y − x²)², whose minimum is (1, 1).
Valley rosenbrock()
{
  return {[](const Eigen::Vector2d &p)
          { return std::pow(1. - p(0), 2) + 100. * std::pow(p(1) - p(0) * p(0), 2); },
          [](const Eigen::Vector2d &p)
          {
            const double off = p(1) - p(0) * p(0);
            return Eigen::Vector2d(-2. * (1. - p(0)) - 400. * p(0) * off, 200. * off);
          },
          [](const Eigen::Vector2d &p)
          {
            Eigen::Matrix2d K;
            K << 2. - 400. * (p(1) - 3. * p(0) * p(0)), -400. * p(0), -400. * p(0), 200.;
            return K;
          }};
}

/// ¼ (x² − 1)² + ½ y²: a saddle at 0, minima at x = ±1.
Valley double_well()
{
  return {[](const Eigen::Vector2d &p)
          { return 0.25 * std::pow(p(0) * p(0) - 1., 2) + 0.5 * p(1) * p(1); },
          [](const Eigen::Vector2d &p) { return Eigen::Vector2d(p(0) * (p(0) * p(0) - 1.), p(1)); },
          [](const Eigen::Vector2d &p)
          { return Eigen::Matrix2d(Eigen::Vector2d(3. * p(0) * p(0) - 1., 1.).asDiagonal()); }};
}

/// x − log x, which ends at x = 0, + ½ y².
Valley with_an_end()
{
  return {[](const Eigen::Vector2d &p)
          {
            return p(0) > 0. ? p(0) - std::log(p(0)) + 0.5 * p(1) * p(1)
                             : std::numeric_limits<double>::infinity();
          },
          [](const Eigen::Vector2d &p) { return Eigen::Vector2d(1. - 1. / p(0), p(1)); },
          [](const Eigen::Vector2d &p)
          { return Eigen::Matrix2d(Eigen::Vector2d(1. / (p(0) * p(0)), 1.).asDiagonal()); }};
}
} // namespace

TEST(order_newton, it_ends_quadratically)
{
  InValley problem(with_an_end(), {0.6, 0.});
  minimize(problem, {});
  // |r_n+1| = C |r_n|²: of the last three residuals above round-off.
  const std::vector<double> &r = problem.residuals;
  std::size_t last             = r.size() - 1;
  while (r[last] < 1e-11)
    --last;
  ASSERT_GE(last, 2u);
  const double order = std::log(r[last] / r[last - 1]) / std::log(r[last - 1] / r[last - 2]);
  EXPECT_NEAR(order, 2., 0.1) << r[last - 2] << " " << r[last - 1] << " " << r[last];
}

TEST(exact_newton, a_curved_valley_is_followed_to_its_end)
{
  InValley problem(rosenbrock(), {-1.2, 1.});
  NewtonOptions options;
  options.most_steps = 60;
  minimize(problem, options);
  EXPECT_LT((problem.x - Eigen::Vector2d(1., 1.)).norm(), 1e-10);
}

TEST(exact_newton,
     where_the_tangent_is_indefinite_it_goes_downhill_and_then_ends_with_the_exact_one)
{
  InValley problem(double_well(), {0.1, 0.7});
  minimize(problem, {});
  EXPECT_LT((problem.x - Eigen::Vector2d(1., 0.)).norm(), 1e-11);
  EXPECT_GT(problem.n_projected, 0);
  EXPECT_LT(problem.n_projected, static_cast<int>(problem.residuals.size()));
}

TEST(exact_newton, a_full_step_over_the_end_of_the_energy_is_shortened)
{
  InValley problem(with_an_end(), {3., 1.}); // Newton's own step ends at x = −3
  minimize(problem, {});
  EXPECT_LT((problem.x - Eigen::Vector2d(1., 0.)).norm(), 1e-11);
}

TEST(tripwire_newton, what_has_no_minimum_is_refused_with_the_history_of_its_residuals)
{
  const Valley slope = {
    [](const Eigen::Vector2d &p) { return std::exp(-p(0)) + p(1) * p(1); },
    [](const Eigen::Vector2d &p) { return Eigen::Vector2d(-std::exp(-p(0)), 2. * p(1)); },
    [](const Eigen::Vector2d &p)
    { return Eigen::Matrix2d(Eigen::Vector2d(std::exp(-p(0)), 2.).asDiagonal()); }};
  InValley falls(slope, {0., 1.});
  NewtonOptions few;
  few.most_steps = 12;
  try
  {
    minimize(falls, few);
    FAIL();
  }
  catch (const meshes::NotConverged &failure)
  {
    EXPECT_EQ(failure.residual_history().size(), 13u);
    EXPECT_NE(std::string(failure.what()).find("stalls"), std::string::npos);
  }
  // A gradient of the wrong sign finds nothing lower.
  Valley wrong   = rosenbrock();
  const auto own = wrong.gradient;
  wrong.gradient = [own](const Eigen::Vector2d &p) { return Eigen::Vector2d(-own(p)); };
  InValley uphill(wrong, {0.5, 0.2});
  EXPECT_THROW(minimize(uphill, {}), meshes::NotConverged);
  Valley broken = rosenbrock();
  broken.value  = [](const Eigen::Vector2d &) { return std::nan(""); };
  InValley nowhere(broken, {0., 0.});
  EXPECT_THROW(minimize(nowhere, {}), meshes::NotConverged);
}

TEST(exact_halved_parts, parts_are_halved_where_they_fail_and_grow_again_behind_it)
{
  using Parts = std::vector<std::pair<double, double>>;
  // Within [1/4, 1/2] no part longer than an eighth is gone.
  Parts gone;
  const GoneWay way = go_in_halves(4,
                                   [&](const double from, const double to)
                                   {
                                     if (from < 0.5 && to > 0.25 && to - from > 0.125)
                                       throw meshes::NotConverged("too long", {});
                                     gone.emplace_back(from, to);
                                   });
  EXPECT_EQ(way.reached, 1.);
  EXPECT_EQ(way.n_parts, 4u);
  EXPECT_EQ(gone, (Parts{{0., 0.25}, {0.25, 0.375}, {0.375, 0.5}, {0.5, 1.}}));
}

TEST(exact_halved_parts, a_way_that_ends_is_gone_up_to_the_shortest_part_before_its_end)
{
  for (const double end : {0.3, 0.7, 0.95})
  {
    const GoneWay way = go_in_halves(5,
                                     [&](double, const double to)
                                     {
                                       if (to > end)
                                         throw meshes::NotConverged("beyond the end", {});
                                     });
    EXPECT_EQ(way.reached, std::floor(end * 32.) / 32.) << end;
    ASSERT_TRUE(way.failure.has_value());
    EXPECT_NE(std::string(way.failure->what()).find("beyond the end"), std::string::npos);
  }
}
