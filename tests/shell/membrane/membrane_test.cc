// SPDX-License-Identifier: MIT
#include "meshes/plain/errors.h"
#include "tests/refusal.h"
#include "tests/shell/shell_cases.h"

#include <gtest/gtest.h>

#include <limits>

using namespace homespun;
using namespace homespun::shell;
using homespun::tests::refusal;

namespace
{
/// Rest positions, randomly moved, stretched and turned; in space also out of the plane.
template <int dim>
Positions<dim> deformed(const meshes::TriangleMesh &mesh, const double side)
{
  std::mt19937 generator(11);
  Positions<dim> x = 1.15 * tests::embedded<dim>(mesh);
  x += 0.02 * side * tests::random_matrix<Positions<dim>>(generator, mesh.n_vertices(), dim);
  return (x * tests::rotation<dim>(2.).transpose()).rowwise() +
         Eigen::Matrix<double, 1, dim>::Constant(3. * side);
}

template <int dim>
void forces_balance()
{
  const double side               = 0.01;
  const meshes::TriangleMesh mesh = tests::irregular_sheet(6, side);
  const Membrane sheet            = membrane(mesh, {tests::anisotropic()});
  const Positions<dim> x          = deformed<dim>(mesh, side);
  const auto force                = membrane_gradient<dim>(sheet, x);
  const double size               = force.magnitude.sum();
  ASSERT_GT(force.gradient.norm(), 1e-3 * size);
  EXPECT_LT(force.gradient.colwise().sum().norm(), 1e-14 * size);
  double torque = 0.;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if constexpr (dim == 2)
      torque += x(v, 0) * force.gradient(v, 1) - x(v, 1) * force.gradient(v, 0);
  if constexpr (dim == 3)
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int v = 0; v < mesh.n_vertices(); ++v)
      sum += Eigen::Vector3d(x.row(v)).cross(Eigen::Vector3d(force.gradient.row(v)));
    torque = sum.norm();
  }
  EXPECT_LT(std::abs(torque), 1e-14 * size * x.rowwise().norm().maxCoeff());
}

template <int dim>
void rigid_motion_is_free()
{
  const meshes::TriangleMesh mesh = tests::irregular_sheet(5);
  const Membrane sheet            = membrane(mesh, {tests::anisotropic()});
  for (const double angle : {0., 0.1, 1.7, 3.1415926535897931, 5.})
  {
    const Positions<dim> x =
      (tests::embedded<dim>(mesh) * tests::rotation<dim>(angle).transpose()).rowwise() +
      Eigen::Matrix<double, 1, dim>::Constant(0.013);
    const auto force = membrane_gradient<dim>(sheet, x);
    EXPECT_LT(force.gradient.norm(), force.round_off.norm()) << angle;
    // round_off is itself round-off: a strain of some 1e-15 of the stiffness.
    EXPECT_LT(force.round_off.maxCoeff(), 1e-13 * 1e4 * 0.01) << angle;
  }
}

template <int dim>
void assembled_derivatives()
{
  const double side               = 0.01;
  const meshes::TriangleMesh mesh = tests::irregular_sheet(4, side);
  const Membrane sheet            = membrane(mesh, {tests::isotropic(3., 0.3)});
  const Positions<dim> x          = deformed<dim>(mesh, side);
  std::mt19937 generator(12);
  const Positions<dim> direction =
    0.1 * side * tests::random_matrix<Positions<dim>>(generator, mesh.n_vertices(), dim);
  const double value = membrane_energy<dim>(sheet, x),
               first = membrane_gradient<dim>(sheet, x).gradient.cwiseProduct(direction).sum(),
               second =
                 tests::hessian_times<dim>(sheet, x, direction).cwiseProduct(direction).sum();
  std::vector<double> steps, two, three;
  for (double h = 1. / 16.; h > 2e-3; h *= 0.5)
  {
    const double remainder = membrane_energy<dim>(sheet, x + h * direction) - value - h * first;
    steps.push_back(h);
    two.push_back(std::abs(remainder));
    three.push_back(std::abs(remainder - 0.5 * h * h * second));
  }
  EXPECT_NEAR(tests::slope(steps, two), 2., 0.1);
  EXPECT_NEAR(tests::slope(steps, three), 3., 0.1);
}
} // namespace

TEST(invariant_membrane, forces_sum_to_zero_and_carry_no_torque_at_an_anisotropy_of_1e4)
{
  forces_balance<2>();
  forces_balance<3>();
}

TEST(invariant_membrane, a_rigid_motion_gives_no_force)
{
  rigid_motion_is_free<2>();
  rigid_motion_is_free<3>();
}

TEST(derivative_membrane, assembled_taylor_remainders_are_of_second_and_third_order)
{
  assembled_derivatives<2>();
  assembled_derivatives<3>();
}

TEST(invariant_membrane, energy_is_free_of_the_choice_of_units)
{
  const meshes::TriangleMesh metres = tests::irregular_sheet(4);
  meshes::TriangleMesh millimetres  = metres;
  millimetres.vertices *= 1e3;
  const double in_metres =
    membrane_energy<2>(membrane(metres, {tests::anisotropic()}), deformed<2>(metres, 0.01));
  const double in_millimetres =
    membrane_energy<2>(membrane(millimetres, {1e9 * tests::anisotropic()}),
                       Positions<2>(1e3 * deformed<2>(metres, 0.01)));
  EXPECT_NEAR(in_millimetres, 1e15 * in_metres, 1e-10 * 1e15 * in_metres);
}

TEST(exact_plane_matrix, solves_and_multiplies_what_the_triangles_add)
{
  const meshes::TriangleMesh mesh = tests::irregular_sheet(6);
  const Membrane sheet            = membrane(mesh, {tests::isotropic(3., 0.3)});
  std::vector<bool> held(static_cast<std::size_t>(mesh.n_vertices()), false);
  for (const int v : tests::outline_of(mesh))
    held[static_cast<std::size_t>(v)] = v % 2 == 0;
  PlaneMatrix matrix(mesh.triangles, held);
  add_membrane_hessian(sheet, mesh.vertices, Hessian::exact, matrix);
  ASSERT_TRUE(matrix.factorize());
  std::mt19937 generator(13);
  Positions<2> x = tests::random_matrix<Positions<2>>(generator, mesh.n_vertices(), 2);
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (held[static_cast<std::size_t>(v)])
      x.row(v).setZero();
  Positions<2> known = tests::hessian_times<2>(sheet, mesh.vertices, x);
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (held[static_cast<std::size_t>(v)])
      known.row(v).setZero();
  EXPECT_LT((matrix.multiply(x) - known).norm(), 1e-13 * known.norm());
  EXPECT_LT((matrix.solve(known) - x).norm(), 1e-10 * x.norm());
}

TEST(tripwire_membrane, faults_are_named)
{
  const Eigen::Matrix3d good = tests::isotropic(1., 0.3);
  meshes::TriangleMesh mesh  = tests::irregular_sheet(3);
  mesh.material(5)           = 2;
  EXPECT_NE(
    refusal([&] { membrane(mesh, {good}); }).find("triangle 5: has phase 2; expected 0 ... 0"),
    std::string::npos);
  mesh.material(5)                        = 0;
  meshes::TriangleMesh flat               = mesh;
  flat.vertices.row(flat.triangles(7, 2)) = flat.vertices.row(flat.triangles(7, 1));
  EXPECT_NE(refusal([&] { membrane(flat, {good}); }).find("triangle 7: has area"),
            std::string::npos);
  Eigen::Matrix3d bad = good;
  bad(2, 2)           = -1.;
  EXPECT_NE(refusal(
              [&] {
                membrane(mesh, {good, bad});
              })
              .find("phase 1: is not positive definite"),
            std::string::npos);
  bad       = good;
  bad(0, 1) = 0.9;
  EXPECT_NE(refusal([&] { membrane(mesh, {bad}); }).find("phase 0: is not symmetric"),
            std::string::npos);
  bad(0, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal([&] { membrane(mesh, {bad}); }).find("not finite"), std::string::npos);
  mesh.vertices(4, 1) = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal([&] { membrane(mesh, {good}); }).find("vertex 4: rest position is not finite"),
            std::string::npos);
}
