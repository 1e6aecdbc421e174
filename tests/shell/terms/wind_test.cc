// SPDX-License-Identifier: MIT
#include "shell/terms/wind.h"

#include "meshes/plain/errors.h"
#include "tests/shell/contact/solids.h"
#include "tests/shell/terms/term_cases.h"

#include <gtest/gtest.h>

#include <iostream>

using namespace homespun;
using namespace homespun::shell;

namespace
{
constexpr double infinite = std::numeric_limits<double>::infinity();

/// A square plate of 1 dm, its normal along `normal`.
meshes::ClothMesh plate(const Eigen::Vector3d &normal)
{
  const Eigen::Quaterniond turn =
    Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal);
  return meshes::placed_sheet(tests::irregular_sheet(4, 0.1), turn.toRotationMatrix().leftCols<2>(),
                              {0.1, 0.2, 0.3});
}

meshes::ClothMesh closed(const tests::Solid &solid)
{
  meshes::ClothMesh mesh;
  mesh.positions = solid.vertices;
  mesh.triangles = solid.triangles;
  return mesh;
}

Vectors uniform(const Eigen::Index n, const Eigen::Vector3d &velocity)
{
  return velocity.transpose().replicate(n, 1);
}

Air blowing(const Eigen::Vector3d &velocity)
{
  Air air;
  air.velocity = [velocity](const Eigen::Vector3d &, double) { return velocity; };
  return air;
}

/// Force on a cloth at rest, as an equilibrium feels it.
Vectors force_of(Term &term, const meshes::ClothMesh &mesh)
{
  const Vectors rest = Vectors::Zero(mesh.n_vertices(), 3);
  term.begin_step({mesh.positions, rest, 0., infinite});
  return -tests::gradient_of(term, mesh.positions);
}
} // namespace

TEST(invariant_wind, pressure_on_a_closed_surface_has_no_resultant_and_no_torque)
{
  meshes::ClothMesh mesh = closed(tests::torus(0.3, 0.1, 11, 7));
  std::mt19937 generator(1);
  mesh.positions += 0.03 * tests::random_matrix<Vectors>(generator, mesh.n_vertices(), 3);
  mesh.positions.rowwise() += Eigen::RowVector3d(1., 2., 3.);
  const auto term     = pressure_term(mesh, [](double) { return 100.; });
  const Vectors force = force_of(*term, mesh);
  const double size   = force.rowwise().norm().sum();
  ASSERT_GT(size, 1.);
  EXPECT_LT(force.colwise().sum().norm(), 1e-14 * size);
  EXPECT_LT(tests::torque(mesh.positions, force).norm(), 1e-14 * size * 4.);
}

TEST(exact_wind, pressure_pushes_a_plate_with_pressure_times_area_along_its_normal)
{
  const Eigen::Vector3d n = Eigen::Vector3d(1., -2., 3.).normalized();
  meshes::ClothMesh mesh  = plate(n);
  const auto term         = pressure_term(mesh, [](const double time) { return 10. + time; });
  EXPECT_LT((force_of(*term, mesh).colwise().sum().transpose() - 10. * 0.01 * n).norm(), 1e-15);
  const Vectors rest = Vectors::Zero(mesh.n_vertices(), 3);
  term->begin_step({mesh.positions, rest, 1., 0.5}); // that at the end of the step
  EXPECT_NEAR(tests::gradient_of(*term, mesh.positions).colwise().sum().norm(), 11.5 * 0.01, 1e-15);
  EXPECT_TRUE(term->does_work());
}

TEST(exact_wind, a_plate_at_rest_across_the_wind_has_the_drag_of_its_coefficient)
{
  const Eigen::Vector3d n = Eigen::Vector3d(1., 2., -2.) / 3.;
  const auto mesh         = plate(n);
  for (const double speed : {0.1, 7.})
  {
    Air air             = blowing(speed * n);
    air.tangential_drag = 0.1;
    const auto term     = wind_term(mesh, air);
    const double drag   = 0.5 * 1.2 * 1.28 * 0.01 * speed * speed; // ½ rho Cd A v²
    EXPECT_LT((force_of(*term, mesh).colwise().sum().transpose() - drag * n).norm(), 1e-13 * drag);
  }
  // Along the wind only friction is left.
  const Eigen::Vector3d along = n.unitOrthogonal();
  Air air                     = blowing(3. * along);
  air.tangential_drag         = 0.1;
  const double friction       = 0.5 * 1.2 * 0.1 * 0.01 * 9.;
  EXPECT_LT(
    (force_of(*wind_term(mesh, air), mesh).colwise().sum().transpose() - friction * along).norm(),
    1e-13 * friction);
}

TEST(exact_wind, an_inclined_plate_is_lifted_by_the_sine_square_law)
{
  const double angle = 0.4; // between plate and wind
  const auto mesh    = plate({std::sin(angle), 0., std::cos(angle)});
  const Eigen::RowVector3d force =
    force_of(*wind_term(mesh, blowing({5., 0., 0.})), mesh).colwise().sum();
  const double normal = 0.5 * 1.2 * 1.28 * 0.01 * 25. * std::sin(angle) * std::sin(angle);
  EXPECT_NEAR(force(0), normal * std::sin(angle), 1e-15);
  EXPECT_NEAR(force(2), normal * std::cos(angle), 1e-15);
}

TEST(invariant_wind, a_cloth_that_moves_with_the_wind_feels_nothing)
{
  const Eigen::Vector3d w(3., -1., 2.);
  const auto mesh     = plate({1., 1., 1.});
  Air air             = blowing(w);
  air.tangential_drag = 1.;
  const auto term     = wind_term(mesh, air);
  const Vectors v     = uniform(mesh.n_vertices(), w);
  term->begin_step({mesh.positions, v, 0., 0.01});
  EXPECT_EQ(tests::gradient_of(*term, mesh.positions).norm(), 0.);
  EXPECT_EQ(tests::gradient_of(*term, mesh.positions + 0.01 * v).norm(), 0.);
}

TEST(exact_wind, a_falling_plate_reaches_its_terminal_velocity_at_any_step)
{
  const auto mesh    = plate(Eigen::Vector3d::UnitZ());
  const double mass  = 2e-3; // 0.2 kg/m²
  const double speed = std::sqrt(2. * mass * 9.81 / (1.2 * 1.28 * 0.01));
  for (const double h : {1e-3, 0.05, 1.})
  {
    const auto term = wind_term(mesh, {});
    // Moved as a rigid plate: one unknown, its velocity along the normal.
    const int n = mesh.n_vertices();
    Vectors x = mesh.positions, v = Vectors::Zero(n, 3);
    double fastest = 0.;
    for (int step = 0; step < static_cast<int>(20. / h) + 100; ++step)
    {
      term->begin_step({x, v, step * h, h});
      BlockMatrix matrix = tests::matrix_for(*term, n);
      Vectors gradient   = Vectors::Zero(n, 3), product;
      term->add_derivatives(x, Hessian::projected, gradient, matrix);
      const Vectors up = uniform(n, Eigen::Vector3d::UnitZ());
      matrix.multiply(up, product);
      const double dx = (mass * v(0, 2) / h - mass * 9.81 - gradient.col(2).sum()) /
                        (mass / (h * h) + product.col(2).sum());
      x += dx * up;
      v       = dx / h * up;
      fastest = std::max(fastest, std::abs(v(0, 2)));
    }
    EXPECT_NEAR(v(0, 2), -speed, 1e-6 * speed) << h;
    if (h < 0.01)
    {
      EXPECT_LT(fastest, 1.001 * speed);
    }
  }
}

TEST(derivative_wind, energy_gradient_and_hessian_agree_and_the_hessian_is_positive_semidefinite)
{
  const auto mesh     = plate({1., 1., 1.});
  Air air             = blowing({3., -1., 2.});
  air.tangential_drag = 0.3;
  const auto term     = wind_term(mesh, air);
  std::mt19937 generator(2);
  const Vectors v   = tests::random_matrix<Vectors>(generator, mesh.n_vertices(), 3),
                way = 0.01 * tests::random_matrix<Vectors>(generator, mesh.n_vertices(), 3);
  term->begin_step({mesh.positions, v, 0., 0.01});
  BlockMatrix matrix = tests::matrix_for(*term, mesh.n_vertices());
  Vectors gradient   = Vectors::Zero(mesh.n_vertices(), 3), product;
  term->add_derivatives(mesh.positions, Hessian::projected, gradient, matrix);
  matrix.multiply(way, product);
  EXPECT_GT(tests::smallest_eigenvalue_ratio(matrix), -1e-14);
  const double change = term->energy(mesh.positions + way) - term->energy(mesh.positions),
               taylor = gradient.cwiseProduct(way).sum() + 0.5 * product.cwiseProduct(way).sum();
  EXPECT_NEAR(change, taylor, 1e-12 * std::abs(change));
  EXPECT_LT((tests::gradient_of(*term, mesh.positions + way) - gradient - product).norm(),
            1e-13 * product.norm());
  // Drag takes energy: the work of the force against still air is negative.
  const auto still = wind_term(mesh, {});
  still->begin_step({mesh.positions, v, 0., 0.01});
  EXPECT_GT(tests::gradient_of(*still, mesh.positions + 0.01 * v).cwiseProduct(v).sum(), 0.);
}

TEST(tripwire_wind, collapsed_triangles_feel_nothing)
{
  meshes::ClothMesh mesh = plate(Eigen::Vector3d::UnitZ());
  const Air air          = blowing({3., -1., 2.});
  mesh.positions.col(1).setConstant(0.2); // a line
  mesh.positions.col(2) = mesh.positions.col(0) / 3.;
  EXPECT_EQ(force_of(*wind_term(mesh, air), mesh).norm(), 0.);
  EXPECT_EQ(force_of(*pressure_term(mesh, [](double) { return 1.; }), mesh).norm(), 0.);
  mesh.positions.setConstant(0.7); // a point
  EXPECT_EQ(force_of(*wind_term(mesh, air), mesh).norm(), 0.);
  EXPECT_EQ(force_of(*pressure_term(mesh, [](double) { return 1.; }), mesh).norm(), 0.);
}

TEST(tripwire_wind, faults_are_named)
{
  const auto mesh = plate(Eigen::Vector3d::UnitZ());
  Air air;
  air.density     = -1.;
  air.normal_drag = std::nan("");
  try
  {
    wind_term(mesh, air);
    FAIL();
  }
  catch (const meshes::BadInput &fault)
  {
    EXPECT_EQ(fault.faults().size(), 2u);
    EXPECT_NE(fault.faults()[0].find("density is -1; expected"), std::string::npos);
  }
  EXPECT_THROW(pressure_term(mesh, nullptr), meshes::BadInput);
}
