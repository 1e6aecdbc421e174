// SPDX-License-Identifier: MIT
#include "verification/newton/arc_length.h"

#include "meshes/plain/errors.h"
#include "verification/law/laws.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>

using namespace homespun;
using namespace homespun::verification;

namespace
{
/// Two triangles on a base that is held, (−1,0), (0,0), (1,0), and their common apex (0,1), which a
/// spring presses down whose other end moves by the parameter.
class TrianglePair final : public PathProblem
{
public:
  TrianglePair(const Law law, const double spring)
      : law(law)
      , spring(spring)
  {
    C.diagonal() << 1., 1., 0.5; // isotropic, nu = 0
  }

  PathLinearization linearize() override
  {
    Eigen::Vector2d r(spring * x(0), spring * (x(1) + s));
    Eigen::Matrix2d K = spring * Eigen::Matrix2d::Identity();
    for (int t = 0; t < 2; ++t)
    {
      // F of the triangle that the apex belongs to: its hat has the gradient (0, 1).
      Eigen::Matrix2d F = Eigen::Matrix2d::Identity();
      F.col(1) += x;
      const Response here = response(law, C, F);
      r += 0.5 * Eigen::Vector2d(here.stress(1), here.stress(3));
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
          K(i, j) += 0.5 * here.tangent(1 + 2 * i, 1 + 2 * j);
    }
    a = -K.inverse() * r;
    b = -K.inverse() * Eigen::Vector2d(0., spring);
    PathLinearization here;
    here.residual = r.norm();
    here.least    = 1e-14;
    here.a_t      = a.dot(t);
    here.b_t      = b.dot(t);
    here.b_b      = b.squaredNorm();
    here.n_negative =
      static_cast<int>((K.selfadjointView<Eigen::Lower>().eigenvalues().array() < 0.).count());
    return here;
  }

  void move(const double of_a, const double of_b, const double of_t, const double by) override
  {
    x += of_a * a + of_b * b + of_t * t;
    s += by;
  }

  void take_tangent(const double factor) override
  {
    t = factor * b;
  }

  void mark() override
  {
    kept = {x, t, s};
  }

  void return_to_mark() override
  {
    x = kept.x;
    t = kept.t;
    s = kept.s;
  }

  double parameter() const override
  {
    return s;
  }

  Eigen::Vector2d x = Eigen::Vector2d::Zero();

private:
  Law law;
  double spring;
  Eigen::Matrix3d C = Eigen::Matrix3d::Zero();
  Eigen::Vector2d a, b, t = Eigen::Vector2d::Zero();
  double s = 0.;
  struct
  {
    Eigen::Vector2d x, t;
    double s;
  } kept;
};
} // namespace

TEST(exact_arc_length, a_pair_of_triangles_turns_back_where_its_closed_form_does)
{
  // Under green the apex at the height l pushes with l (1 − l²)/2, most at l = 1/sqrt(3); the end
  // of the spring is at 1 − s = l − l (1 − l²)/(2 c), which turns at 3 l² = 1 − 2 c.
  for (const double c : {0.05, 0.1, 0.2})
  {
    TrianglePair pair(Law::green, c);
    const FollowedPath path = follow_path(pair, 10., 0.02, 200);
    ASSERT_EQ(path.end, PathEnd::turned) << c;
    const double l = std::sqrt((1. - 2. * c) / 3.);
    EXPECT_NEAR(path.farthest, 1. - l + l * (1. - l * l) / (2. * c), 1e-10) << c;
    // A minimum before it, none behind it.
    EXPECT_EQ(path.points.front().n_negative, 0);
    EXPECT_GT(path.points.back().n_negative, 0);
    EXPECT_LT(path.points.back().parameter, path.farthest);
  }
}

TEST(exact_arc_length, where_nothing_turns_the_goal_is_reached)
{
  // A spring too stiff to let go, and biot, whose force in compression never falls.
  for (const auto &[law, c] : {std::pair{Law::green, 0.6}, {Law::biot, 0.05}})
  {
    TrianglePair pair(law, c);
    const FollowedPath path = follow_path(pair, 0.5, 0.02, 200);
    EXPECT_EQ(path.end, PathEnd::reached) << name_of(law);
    EXPECT_GE(path.farthest, 0.5);
    for (const PathPoint &point : path.points)
      EXPECT_EQ(point.n_negative, 0) << name_of(law);
  }
}

TEST(tripwire_arc_length, a_path_that_ends_is_not_taken_for_one_that_turns)
{
  // Equations that cannot be solved beyond a height.
  class WithAnEnd final : public PathProblem
  {
  public:
    PathLinearization linearize() override
    {
      if (s > 0.3)
        throw meshes::NotConverged("no matrix", {});
      PathLinearization here;
      here.residual = std::abs(x - s);
      here.least    = 1e-15;
      a             = s - x;
      here.a_t      = a * t;
      here.b_t      = t;
      here.b_b      = 1.;
      return here;
    }
    void move(const double of_a, const double of_b, const double of_t, const double by) override
    {
      x += of_a * a + of_b + of_t * t;
      s += by;
    }
    void take_tangent(const double factor) override
    {
      t = factor;
    }
    void mark() override
    {
      kept_x = x, kept_s = s, kept_t = t;
    }
    void return_to_mark() override
    {
      x = kept_x, s = kept_s, t = kept_t;
    }
    double parameter() const override
    {
      return s;
    }

  private:
    double x = 0., s = 0., t = 0., a = 0., kept_x = 0., kept_s = 0., kept_t = 0.;
  } problem;
  const FollowedPath path = follow_path(problem, 1., 0.1, 200);
  EXPECT_EQ(path.end, PathEnd::lost);
  EXPECT_NEAR(path.farthest, 0.3, 1e-3);
}
