// SPDX-License-Identifier: MIT
#include "shell/contact/obstacles.h"

#include "meshes/plain/errors.h"
#include "tests/refusal.h"
#include "tests/shell/contact/solids.h"
#include "tests/shell/terms/term_cases.h"

#include <gtest/gtest.h>

#include <iostream>

using namespace homespun;
using namespace homespun::shell;
using homespun::tests::refusal;

namespace
{
const Eigen::Vector3d down(0., 0., -9.81);

ContactParameters with_gravity(const Eigen::Vector3d &gravity = down)
{
  ContactParameters parameters;
  parameters.gravity = gravity;
  return parameters;
}

/// Points without a cloth, moved by linearly implicit Euler: (M/h² + H) dx = M v/h + M g − dE/dx.
struct Points
{
  Vectors x, v;
  Eigen::VectorXd masses;
  double time = 0.;

  explicit Points(const Vectors &positions, const double mass = 1e-4)
      : x(positions)
      , v(Vectors::Zero(positions.rows(), 3))
      , masses(Eigen::VectorXd::Constant(positions.rows(), mass))
  {
  }

  void step(Term &term, const double h, const Eigen::Vector3d &acceleration = down)
  {
    const int n        = static_cast<int>(x.rows());
    BlockMatrix matrix = tests::matrix_for(term, n);
    term.begin_step({x, v, time, h});
    Vectors gradient = Vectors::Zero(n, 3);
    term.add_derivatives(x, Hessian::projected, gradient, matrix);
    for (int i = 0; i < n; ++i)
    {
      const double inertia = masses(i) / (h * h);
      const Eigen::Matrix3d A =
        inertia * Eigen::Matrix3d::Identity() + Eigen::Matrix3d(matrix.diagonal(i));
      const Eigen::Vector3d b =
        (inertia * h * v.row(i) - gradient.row(i)).transpose() + masses(i) * acceleration;
      const Eigen::RowVector3d dx = A.ldlt().solve(b).transpose();
      ASSERT_TRUE(dx.allFinite());
      x.row(i) += dx;
      v.row(i) = dx / h;
    }
    time += h;
  }
};

Vectors one(const double x1, const double x2, const double x3)
{
  Vectors x(1, 3);
  x << x1, x2, x3;
  return x;
}

Obstacle floor_at(const double height)
{
  return {"floor", plane({0., 0., height}, {0., 0., 2.}), 0., nullptr};
}

std::shared_ptr<const Shape> thin_plate(const Eigen::Vector3d &half = {0.5, 0.5, 0.001})
{
  const tests::Solid solid = tests::box(half);
  return closed_mesh(ClosedSurface(solid.vertices, solid.triangles, "plate"));
}
} // namespace

TEST(bound_obstacles, a_vertex_comes_to_rest_on_a_plane_from_any_height_at_any_step)
{
  for (const double h : {1e-3, 1e-2, 5e-2})
    for (const double height : {0.0005, 0.0011, 0.01, 0.3})
      for (const double lift : {0., 0.7})
      {
        Points points(one(0., 0., height));
        points.v(0, 2)    = lift;
        const auto term   = obstacle_term(floor_at(0.), points.masses, with_gravity());
        double lowest     = height;
        const int n_steps = static_cast<int>(2. / h);
        for (int step = 0; step < n_steps; ++step)
        {
          points.step(*term, h);
          lowest = std::min(lowest, points.x(0, 2));
        }
        // m g/k = g h²/1000 below the thickness; 0.025 mm at 50 ms.
        EXPECT_NEAR(points.x(0, 2), 1e-3 - 9.81 * h * h / 1000., 1e-9) << h << ' ' << height;
        EXPECT_LT(points.v.norm(), 1e-6);
        // One that turns round within a step may dip in by the fall of one step.
        EXPECT_GT(lowest, std::min(height, 1e-3) - (lift > 0. ? 9.81 * h * h : 0.015 * h))
          << h << ' ' << height;
      }
}

TEST(bound_obstacles, a_vertex_that_begins_in_the_skin_is_not_thrown_at_any_step)
{
  for (const double h : {1e-4, 1e-3, 1e-2})
    for (const double height : {-0.002, 0., 0.0005})
    {
      Points points(one(0., 0., height));
      const auto term = obstacle_term(floor_at(0.), points.masses, with_gravity());
      double highest  = height;
      for (int step = 0; step < static_cast<int>(0.3 / h); ++step)
      {
        points.step(*term, h);
        highest = std::max(highest, points.x(0, 2));
      }
      // What a last step of the way out leaves of its speed rises no higher than it went.
      EXPECT_LT(highest, 1e-3 + (1e-3 - height)) << h << ' ' << height;
      EXPECT_NEAR(points.x(0, 2), 1e-3, 1e-5) << h << ' ' << height;
    }
}

TEST(exact_obstacles, a_held_vertex_has_no_contact)
{
  const Vectors x = Vectors::Zero(2, 3);
  const auto term = obstacle_term(floor_at(0.), Eigen::VectorXd::Constant(2, 1e-4), with_gravity());
  const BlockMatrix matrix = tests::matrix_for(*term, 2, {true, false});
  term->begin_step({x, x, 0., 0.01});
  const Vectors gradient = tests::gradient_of(*term, x);
  EXPECT_EQ(gradient.row(0).norm(), 0.);
  EXPECT_LT(gradient(1, 2), 0.);
}

TEST(bound_obstacles, nothing_goes_through_a_thin_plate_at_five_metres_per_second_and_50_ms)
{
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> random(0., 1.);
  Vectors start(400, 3);
  for (int v = 0; v < start.rows(); ++v)
    start.row(v) << 0.8 * random(generator) - 0.4, 0.8 * random(generator) - 0.4,
      0.002 + 0.4 * random(generator);
  start.row(0) << 0., 0., 0.2; // on the diagonal of a face
  Points points(start);
  points.v.col(2).setConstant(-5.);
  points.v.col(0).setConstant(0.3);
  const auto term =
    obstacle_term({"plate", thin_plate(), 0.5, nullptr}, points.masses, with_gravity());
  double lowest = 1.;
  for (int step = 0; step < 40; ++step)
  {
    points.step(*term, 0.05);
    lowest = std::min(lowest, points.x.col(2).minCoeff());
  }
  std::cout << "5 m/s onto a plate of 2 mm: deepest " << 1e3 * (0.002 - lowest)
            << " mm into the thickness of 1 mm\n";
  EXPECT_GT(lowest, 0.001); // never below the surface
  EXPECT_LT(points.v.cwiseAbs().maxCoeff(), 2e-3);
}

TEST(bound_obstacles, a_moving_plate_takes_along_what_lies_on_it)
{
  Points points(one(0.1, 0.05, 0.0021));
  const auto motion = [](const double time)
  { return Eigen::Vector3d(0.2 * (1. - std::cos(time)), 0., 1. * time); };
  const auto term =
    obstacle_term({"lift", thin_plate(), 2., motion}, points.masses, with_gravity());
  for (int step = 0; step < 100; ++step)
    points.step(*term, 0.02);
  EXPECT_NEAR(points.x(0, 2), 2.002, 1e-4);
  EXPECT_NEAR(points.x(0, 0) - 0.1, motion(2.)(0), 5e-3);
}

TEST(exact_obstacles, a_block_on_a_slope_sticks_below_the_angle_of_friction)
{
  for (const double mu : {0.2, 0.5, 1.})
    for (const double h : {2e-3, 2e-2})
    {
      const double angle = 0.9 * std::atan(mu);
      const Eigen::Vector3d n(-std::sin(angle), 0., std::cos(angle)); // uphill is +1
      // Resting already: what falls upon the slope slides a little.
      const double depth          = 9.81 * std::cos(angle) * h * h / 1000.;
      const Eigen::Vector3d place = (1e-3 - depth) * n;
      Points points(one(place(0), place(1), place(2)));
      const Eigen::RowVector3d start = points.x.row(0);
      const auto term = obstacle_term({"slope", plane({0., 0., 0.}, n), mu, nullptr}, points.masses,
                                      with_gravity());
      for (int step = 0; step < static_cast<int>(1. / h); ++step)
        points.step(*term, h);
      const double crept = (points.x.row(0) - start).norm();
      EXPECT_LT(crept, 1e-3) << mu; // slip speed times one second
      EXPECT_LT(points.v.norm(), 1e-3);
    }
}

TEST(exact_obstacles, a_block_on_a_slope_slides_with_the_acceleration_of_coulomb)
{
  for (const double mu : {0.2, 0.5})
    for (const double h : {2e-3, 1e-2})
    {
      const double angle = 1.5 * std::atan(mu);
      const Eigen::Vector3d n(std::sin(angle), 0., std::cos(angle)),
        downhill(std::cos(angle), 0., -std::sin(angle));
      Points points(one(1e-3 * n(0), 0., 1e-3 * n(2)));
      points.v.row(0) = 0.5 * downhill.transpose();
      const auto term = obstacle_term({"slope", plane({0., 0., 0.}, n), mu, nullptr}, points.masses,
                                      with_gravity());
      const double g_slope = 9.81 * (std::sin(angle) - mu * std::cos(angle));
      for (int step = 0; step < static_cast<int>(2. / h); ++step)
        points.step(*term, h);
      const double begin = downhill.dot(points.v.row(0).transpose());
      for (int step = 0; step < static_cast<int>(1. / h); ++step)
        points.step(*term, h);
      const double acceleration = downhill.dot(points.v.row(0).transpose()) - begin;
      std::cout << "slope, mu " << mu << ", h " << h << ": acceleration off by "
                << acceleration / g_slope - 1. << '\n';
      const double a = mu * 9.81 * std::cos(angle);
      EXPECT_LT(acceleration / g_slope, 1. + 1e-9);
      EXPECT_GT(acceleration / g_slope, begin / (begin + a * h));
    }
}

TEST(exact_obstacles, a_sliding_block_stops_and_never_turns_back)
{
  Points points(one(0., 0., 1e-3));
  points.v(0, 0)  = 1.;
  Obstacle ground = floor_at(0.);
  ground.friction = 0.5;
  const auto term = obstacle_term(ground, points.masses, with_gravity());
  for (int step = 0; step < 500; ++step)
  {
    points.step(*term, 1e-3);
    EXPECT_GE(points.v(0, 0), 0.);
  }
  EXPECT_NEAR(points.x(0, 0), 1. / (2. * 0.5 * 9.81), 0.01); // v²/(2 mu g)
  EXPECT_LT(points.v(0, 0), 1e-3);
}

TEST(bound_obstacles, a_vertex_that_is_pulled_away_is_let_go_after_one_step)
{
  Points points(one(0., 0., 1e-3));
  const auto term = obstacle_term(floor_at(0.), points.masses, with_gravity());
  for (int step = 0; step < 50; ++step)
    points.step(*term, 0.02);
  const Eigen::Vector3d pull(0., 0., 1.); // its weight, and a little more
  const double begin = points.x(0, 2);
  for (int step = 0; step < 11; ++step)
    points.step(*term, 0.02, pull);
  EXPECT_NEAR(points.x(0, 2) - begin, 0.5 * 0.02 * 0.02 * 10. * 11., 1e-4);
}

TEST(bound_obstacles, a_vertex_beside_a_wall_is_not_pulled_to_it)
{
  Points points(one(0., 0., 0.01)); // within h² g = 25 mm of the floor, held up by its cloth
  const auto term = obstacle_term(floor_at(0.), points.masses, with_gravity());
  points.v(0, 2)  = -1e-6;
  points.step(*term, 0.05, Eigen::Vector3d::Zero());
  EXPECT_GT(points.x(0, 2), 0.01 - 1e-6);
  EXPECT_LT(points.x(0, 2) - 0.01, 9.81 * 0.05 * 0.05); // what it feels is not more than its weight
}

TEST(bound_obstacles, a_vertex_that_slides_into_a_corner_stays_out_of_both_walls)
{
  // An L: the floor is the top of a box, the wall the side of another; joined as one closed
  // surface.
  tests::Solid base = tests::box({0.5, 0.5, 0.01}), wall = tests::box({0.001, 0.4, 0.2});
  wall.vertices.rowwise() += Eigen::RowVector3d(0.3, 0., 0.3);
  base.vertices.conservativeResize(16, 3);
  base.vertices.bottomRows(8) = wall.vertices;
  base.triangles.conservativeResize(24, 3);
  base.triangles.bottomRows(12) = wall.triangles.array() + 8;
  Points points(one(0., 0.05, 0.2)); // the wall begins at height 0.1
  points.v(0, 0)  = 5.;
  const auto term = obstacle_term(
    {"walls", closed_mesh(ClosedSurface(base.vertices, base.triangles, "walls")), 0.3, nullptr},
    points.masses, with_gravity());
  double farthest = 0.;
  for (int step = 0; step < 12; ++step)
  {
    points.step(*term, 0.02);
    if (points.x(0, 2) > 0.1)
      farthest = std::max(farthest, points.x(0, 0));
  }
  EXPECT_LT(farthest, 0.299);
  EXPECT_GT(farthest, 0.29);
}

TEST(bound_obstacles, what_is_inside_is_pushed_out_at_a_bounded_speed)
{
  Points points(one(0.01, 0.02, -0.05));
  const auto term =
    obstacle_term({"ball", sphere({0., 0., 0.}, 0.1), 0., nullptr}, points.masses, with_gravity());
  double fastest = 0.;
  for (int step = 0; step < 100; ++step)
  {
    points.step(*term, 0.01, Eigen::Vector3d::Zero());
    fastest = std::max(fastest, points.v.norm());
  }
  EXPECT_GT(points.x.row(0).norm(), 0.1);
  EXPECT_LT(fastest, 1.01);
}

TEST(exact_obstacles, a_sphere_is_entered_where_the_quadratic_says)
{
  const auto ball  = sphere({0.1, 0., 0.}, 0.2);
  const auto entry = ball->first_entry({-0.9, 0., 0.}, {1.1, 0., 0.});
  ASSERT_TRUE(entry);
  EXPECT_NEAR(entry->part, 0.4, 1e-15);
  EXPECT_NEAR(entry->normal(0), -1., 1e-15);
  EXPECT_FALSE(ball->first_entry({-0.9, 0.21, 0.}, {1.1, 0.21, 0.}));
  EXPECT_FALSE(ball->first_entry({0.1, 0., 0.}, {1.1, 0., 0.}));
}

TEST(tripwire_obstacles, places_without_a_normal_give_finite_forces)
{
  const tests::Solid cube = tests::box({0.1, 0.1, 0.1});
  const auto mesh         = closed_mesh(ClosedSurface(cube.vertices, cube.triangles, "cube"));
  Vectors x(6, 3);
  x << 0., 0., 0., 0.1, 0.1, 0.1, 0.1, 0.1, 0.03, 0.1, 0., 0., 0.1, 0.2, 0.1, 1e-300, 0., 0.1;
  for (const auto &shape : {mesh, sphere({0., 0., 0.}, 0.1), plane({0., 0., 0.}, {1e-100, 0., 0.})})
    for (const double speed : {0., 5.})
      for (const double h : {1e-3, 0.05})
      {
        Points points(x);
        points.v.col(1).setConstant(-speed);
        const auto term =
          obstacle_term({"odd", shape, 0.5, nullptr}, points.masses, with_gravity());
        for (int step = 0; step < 5; ++step)
          points.step(*term, h);
        EXPECT_TRUE(points.x.allFinite());
      }
}

TEST(derivative_obstacles, taylor_remainders_vanish_for_a_quadratic_energy)
{
  std::mt19937 generator(2);
  const Vectors x = 0.11 * tests::random_matrix<Vectors>(generator, 30, 3),
                v = tests::random_matrix<Vectors>(generator, 30, 3);
  const auto term = obstacle_term({"ball", sphere({0., 0., 0.}, 0.1), 0.4, nullptr},
                                  Eigen::VectorXd::Constant(30, 1e-4), with_gravity());
  term->begin_step({x, v, 0., 0.01});
  BlockMatrix matrix = tests::matrix_for(*term, 30);
  Vectors gradient   = Vectors::Zero(30, 3), product;
  const Vectors way  = 1e-4 * v;
  term->add_derivatives(x, Hessian::projected, gradient, matrix);
  matrix.multiply(way, product);
  EXPECT_GT(tests::smallest_eigenvalue_ratio(matrix), -1e-14);
  const double change = term->energy(x + way) - term->energy(x),
               taylor = gradient.cwiseProduct(way).sum() + 0.5 * product.cwiseProduct(way).sum();
  EXPECT_GT(gradient.norm(), 0.);
  EXPECT_NEAR(change, taylor, 1e-10 * std::abs(term->energy(x)));
  EXPECT_LT((tests::gradient_of(*term, x + way) - gradient - product).norm(),
            1e-10 * gradient.norm());
}

TEST(exact_obstacles, an_equilibrium_rests_at_its_weight_over_its_stiffness)
{
  ContactParameters parameters = with_gravity();
  parameters.stiffness         = 5.;
  Points points(one(0., 0., 0.2));
  const auto term = obstacle_term(floor_at(0.), points.masses, parameters);
  term->begin_step({points.x, points.v, 0., std::numeric_limits<double>::infinity()});
  const double depth = points.masses(0) * 9.81 / 5.;
  const Vectors rest = one(0., 0., 1e-3 - depth);
  EXPECT_NEAR(tests::gradient_of(*term, rest)(0, 2), -points.masses(0) * 9.81, 1e-15);
  EXPECT_EQ(tests::gradient_of(*term, points.x).norm(), 0.);
}

TEST(tripwire_obstacles, faults_are_named)
{
  const Eigen::VectorXd masses = Eigen::VectorXd::Constant(1, 1e-4);
  ContactParameters bad;
  bad.thickness          = 0.;
  Obstacle rough         = floor_at(0.);
  rough.friction         = -1.;
  const std::string text = refusal([&] { obstacle_term(rough, masses, bad); });
  EXPECT_NE(text.find("thickness is 0; expected"), std::string::npos);
  EXPECT_NE(text.find("friction is -1; expected"), std::string::npos);
  EXPECT_NE(refusal([&] { obstacle_term(floor_at(0.), 0. * masses, {}); }).find("vertex mass"),
            std::string::npos);
  EXPECT_NE(refusal([] { plane({0., 0., 0.}, {0., 0., 0.}); }).find("not zero"), std::string::npos);
  EXPECT_NE(refusal([] { sphere({0., 0., 0.}, -1.); }).find("positive radius"), std::string::npos);
  const auto term = obstacle_term(floor_at(0.), masses, {});
  const Vectors x = one(0., 0., 0.);
  EXPECT_NE(refusal(
              [&] {
                term->begin_step({x, x, 0., std::numeric_limits<double>::infinity()});
              })
              .find("give a stiffness in N/m"),
            std::string::npos);
}
