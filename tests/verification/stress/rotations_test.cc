// SPDX-License-Identifier: MIT
// One triangle turned, mirrored, collapsed, scaled; twisted strips; numbers that are not finite.
#include "meshes/plain/errors.h"
#include "meshes/plain/sheet.h"
#include "meshes/plain/symmetric_eigen.h"
#include "shell/contact/obstacles.h"
#include "shell/membrane/corotational_energy.h"
#include "shell/terms/inertial_terms.h"
#include "shell/terms/membrane_term.h"
#include "shell/terms/plate_term.h"
#include "shell/terms/wind.h"
#include "tests/verification/stress/checks.h"
#include "verification/stress/stress_sheet.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace homespun;
using namespace homespun::verification;
using shell::Cloth;
using shell::Vectors;
using tests::expect_refused;
using tests::expect_within;

namespace
{
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity  = std::numeric_limits<double>::infinity();

Eigen::Matrix<double, 3, 2> rest_corners()
{
  Eigen::Matrix<double, 3, 2> corners;
  corners << 0., 0., 0.01, 0.001, 0.003, 0.012;
  return corners;
}

/// The force on the corners is nothing where a triangle is turned by 180° about any axis, or
/// mirrored.
StressAnswer without_force(const SheetStiffness &stiffness, const bool is_mirrored,
                           const unsigned int seed)
{
  const Eigen::Vector3d axis = meshes::random_vectors(1, seed).row(0).normalized();
  Eigen::Matrix3d Q          = Eigen::AngleAxisd(M_PI, axis).toRotationMatrix();
  if (is_mirrored)
    Q = Eigen::Matrix3d::Identity() - 2. * axis * axis.transpose();
  const shell::RestTriangle rest = shell::rest_triangle(rest_corners());
  const Eigen::Matrix3d corners  = rest_corners() * Q.leftCols<2>().transpose();
  const shell::TriangleDerivatives<3> found =
    shell::triangle_derivatives<3>(rest, corners, stiffness.D, shell::Hessian::exact);
  return {found.gradient.cwiseAbs().maxCoeff() / (stiffness.D.norm() * 0.01), found.gradient};
}

/// In the plane a mirrored triangle costs energy, and a small step down the gradient lowers it.
StressAnswer mirrored_in_the_plane(const SheetStiffness &stiffness)
{
  const shell::RestTriangle rest      = shell::rest_triangle(rest_corners());
  Eigen::Matrix<double, 3, 2> corners = rest_corners();
  corners.col(0) *= -0.9;
  const shell::TriangleDerivatives<2> found =
    shell::triangle_derivatives<2>(rest, corners, stiffness.D, shell::Hessian::projected);
  const double before = shell::triangle_energy<2>(rest, corners, stiffness.D);
  const double after  = shell::triangle_energy<2>(
    rest, corners - 1e-3 / stiffness.D.norm() * found.gradient, stiffness.D);
  return {after / before, found.gradient};
}

Eigen::Matrix<double, 9, 9> matrix_of(const shell::TriangleDerivatives<3> &derivatives)
{
  Eigen::Matrix<double, 9, 9> H;
  const int place[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
    {
      const Eigen::Matrix3d &block = derivatives.blocks[static_cast<std::size_t>(place[a][b])];
      H.block<3, 3>(3 * a, 3 * b)  = a <= b ? block : Eigen::Matrix3d(block.transpose());
    }
  return H;
}

/// A deformation gradient of a rank: the projected Hessian may have no negative eigenvalue,
/// whatever it is.
StressAnswer of_rank(const SheetStiffness &stiffness, const int rank, const unsigned int seed)
{
  const Vectors random            = meshes::random_vectors(4, seed);
  shell::DeformationGradient<3> F = shell::DeformationGradient<3>::Zero();
  for (int k = 0; k < rank; ++k)
    F += 1.5 * random.row(k).transpose() * random.row(2 + k).head<2>();
  const shell::RestTriangle rest = shell::rest_triangle(rest_corners());
  const Eigen::Matrix3d corners  = rest_corners() * F.transpose();
  const shell::TriangleDerivatives<3> found =
    shell::triangle_derivatives<3>(rest, corners, stiffness.D, shell::Hessian::projected);
  const Eigen::Matrix<double, 9, 9> H = matrix_of(found);
  if (!H.allFinite())
    return {no_number, H};
  const Eigen::VectorXd modes = meshes::symmetric_eigen<Eigen::Dynamic>(H).values;
  Eigen::MatrixXd values(9, 10);
  values << H, Eigen::Map<const Eigen::VectorXd>(found.gradient.data(), 9);
  return {-modes.minCoeff() / modes.cwiseAbs().maxCoeff(), values};
}

/// P(QF) = Q P(F), at any size of F.
StressAnswer scaled(const SheetStiffness &stiffness, const double scale, const unsigned int seed)
{
  const Vectors random            = meshes::random_vectors(3, seed);
  shell::DeformationGradient<3> F = scale * random.leftCols<2>();
  const Eigen::Matrix3d Q = Eigen::AngleAxisd(2.5, random.col(2).normalized()).toRotationMatrix();
  const shell::DeformationGradient<3> P      = shell::energy_gradient<3>(F, stiffness.D),
                                      turned = shell::energy_gradient<3>(Q * F, stiffness.D);
  const shell::GradientHessian<3> H =
    shell::energy_hessian<3>(F, stiffness.D, shell::Hessian::projected);
  Eigen::MatrixXd values(6, 8);
  values << H, Eigen::Map<const Eigen::Matrix<double, 6, 1>>(P.data()),
    Eigen::Map<const Eigen::Matrix<double, 6, 1>>(turned.data());
  // |F F| of numbers below 1e-150 underflows: divided first.
  const double size = P.cwiseAbs().maxCoeff();
  return {(turned / size - Q * (P / size)).cwiseAbs().maxCoeff(), values};
}

/// The whole sheet turned by exactly 180°.
StressAnswer sheet_turned(const SheetStiffness &stiffness, const Eigen::Vector3d &signs)
{
  meshes::ClothMesh mesh = lying_mesh(8);
  SheetPhysics weightless;
  weightless.gravity.setZero();
  Cloth cloth = sheet_cloth(mesh, stiffness, {}, weightless);
  cloth.set_state(mesh.positions * signs.asDiagonal(), Vectors::Zero(mesh.n_vertices(), 3), 0.);
  const double force   = cloth.gradient().cwiseAbs().maxCoeff() / (stiffness.D.norm() * 0.2);
  const Vectors before = cloth.positions();
  for (int k = 0; k < 50; ++k)
    cloth.step(0.01);
  return {std::max(force, (cloth.positions() - before).cwiseAbs().maxCoeff()), state_of(cloth)};
}

/// All terms at once, of a flat sheet that has not moved.
StressAnswer forces_before_the_first_step(const SheetStiffness &stiffness)
{
  const meshes::ClothMesh mesh = hanging_mesh(4);
  Cloth cloth                  = sheet_cloth(mesh, stiffness, {});
  cloth.add(shell::plate_term(mesh, {shell::PlateStiffness::isotropic(1e-5, 0.3)}));
  cloth.add(shell::wind_term(mesh, {}));
  cloth.add(shell::pressure_term(mesh, [](double) { return 0.; }));
  cloth.add(shell::obstacle_term({"floor", shell::plane({0., 0., -1.}, {0., 0., 1.}), 0.3, {}},
                                 cloth.masses(), {}));
  const Vectors weight = cloth.masses() * Eigen::RowVector3d(0., 0., 9.81);
  const Vectors force  = cloth.gradient();
  Eigen::MatrixXd values(force.rows(), 4);
  values << force, Eigen::VectorXd::Constant(force.rows(), cloth.stored_energy());
  return {(force - weight).cwiseAbs().maxCoeff() / (stiffness.D.norm() * 0.2), values};
}

/// A strip of 5 x 20 cm whose upper end turns about the long axis; then it settles. Its energy in
/// the end, over that of the helicoid with the same ends, which is one of the shapes it might have
/// taken.
StressAnswer twisted(const SheetStiffness &stiffness, const double turns, const int n_steps)
{
  constexpr int n1 = 4, n2 = 16;
  constexpr double width = 0.05, length = 0.2;
  Eigen::Matrix2d steps;
  steps << width / n1, 0., 0., length / n2;
  Eigen::Matrix<double, 3, 2> placement;
  placement << 1., 0., 0., 0., 0., 1.;
  const meshes::ClothMesh mesh = meshes::placed_sheet(
    meshes::coarse_sheet({-0.5 * width, 0.}, steps, n1, n2), placement, Eigen::RowVector3d::Zero());
  const auto turned = [&](const int vertex, const double angle) -> Eigen::RowVector3d
  {
    const Eigen::RowVector3d X = mesh.positions.row(vertex);
    return {X(0) * std::cos(angle), X(0) * std::sin(angle), X(2)};
  };
  std::vector<int> held;
  for (int i = 0; i <= n1; ++i)
    for (const int j : {0, n2})
      held.push_back(j * (n1 + 1) + i);
  SheetPhysics physics;
  physics.gravity.setZero();
  physics.viscosity = 0.02;
  Cloth cloth       = sheet_cloth(mesh, stiffness, held, physics);

  Vectors helicoid = mesh.positions;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    helicoid.row(v) = turned(v, 2. * M_PI * turns * mesh.positions(v, 2) / length);
  cloth.set_state(helicoid, Vectors::Zero(helicoid.rows(), 3), 0.);
  const double of_helicoid = cloth.stored_energy();
  cloth.set_state(mesh.positions, Vectors::Zero(helicoid.rows(), 3), 0.);

  for (int k = 1; k <= n_steps + 200; ++k)
  {
    for (int i = 0; i <= n1; ++i)
    {
      const int v = n2 * (n1 + 1) + i;
      cloth.prescribe(
        v, turned(v, 2. * M_PI * turns * std::min(1., static_cast<double>(k) / n_steps)));
    }
    cloth.step(0.01);
  }
  return {cloth.stored_energy() / of_helicoid, state_of(cloth)};
}

std::vector<SheetStiffness> sheets()
{
  return with_twins_of_yarn(built_in_stiffnesses());
}
} // namespace

TEST(bound_stress, turned_and_crushed_triangles_end_as_theory_says)
{
  for (const SheetStiffness &stiffness : sheets())
  {
    const std::string of = "; " + stiffness.name;
    // A turned or mirrored triangle is not strained; ten roundings of a strain, four for area and
    // gradients: 40 x 2.2e-16. Force over stiffness x edge.
    for (const bool is_mirrored : {false, true})
      expect_within(
        (is_mirrored ? "mirrored in space" : "turned by 180 degrees about any axis") + of, 1e-14,
        [&](const unsigned int seed) { return without_force(stiffness, is_mirrored, seed); },
        tests::Repeats::with_seeds);
    // A small step down the gradient lowers the energy to first order; round-off is below 1e-12.
    expect_within("mirrored in the plane" + of, 1. - 1e-12,
                  [&](unsigned int) { return mirrored_in_the_plane(stiffness); });
    // The projected Hessian has no negative eigenvalue; five roundings for each of its 81 entries,
    // 5 x 81 x 2.2e-16, over the largest.
    for (const int rank : {0, 1, 2})
      expect_within(
        "deformation gradient of rank " + std::to_string(rank) + of, 1e-13,
        [&](const unsigned int seed) { return of_rank(stiffness, rank, seed); },
        tests::Repeats::with_seeds);
    // The energy does not see a rotation; four roundings times the condition of F, up to a
    // thousand: 4000 x 2.2e-16.
    for (const double scale : {1e-30, 1e-20, 1e-10, 1e10, 1e20, 1e30})
      expect_within(
        "deformation gradient of size " + std::to_string(std::log10(scale)) + of, 1e-12,
        [&](const unsigned int seed) { return scaled(stiffness, scale, seed); },
        tests::Repeats::with_seeds);
    // Half a turn changes signs, which rounds nothing; five roundings of a strain.
    for (const Eigen::Vector3d &signs :
         {Eigen::Vector3d(1., -1., -1.), Eigen::Vector3d(-1., -1., 1.)})
      expect_within("sheet turned by exactly 180 degrees" + of, 1e-15,
                    [&](unsigned int) { return sheet_turned(stiffness, signs); });
    // The helicoid has the same ends, and what settles among all shapes has no more energy.
    for (const auto &[turns, n_steps] : {std::pair{0.5, 90}, {0.5, 1}, {5., 600}})
      expect_within("strip twisted in " + std::to_string(n_steps) + " steps" + of, 1.,
                    [&, turns = turns, n_steps = n_steps](unsigned int)
                    { return twisted(stiffness, turns, n_steps); });
  }
}

TEST(bound_stress, a_cloth_that_is_asked_or_thrown_in_uncommon_ways_stays_finite)
{
  const SheetStiffness one = sheets().front();
  // A sheet that has not moved is not strained: 40 x 2.2e-16 as above.
  expect_within("forces asked for before the first step; all terms", 1e-14,
                [&](unsigned int) { return forces_before_the_first_step(one); });
  expect_within("velocity of 1e100 m/s", energy_round_off,
                [&](unsigned int) -> StressAnswer
                {
                  const meshes::ClothMesh mesh = hanging_mesh(4);
                  Cloth cloth                  = sheet_cloth(mesh, one, upper_corners(4));
                  Vectors velocities           = Vectors::Zero(mesh.n_vertices(), 3);
                  velocities(7, 1)             = 1e100;
                  cloth.set_state(mesh.positions, velocities, 0.);
                  const double growth = largest_energy_growth(cloth, 0.01, 20);
                  return {growth, state_of(cloth)};
                });
}

TEST(bound_stress, numbers_that_are_not_finite_are_refused_by_name)
{
  const SheetStiffness one     = sheets().front();
  const meshes::ClothMesh mesh = hanging_mesh(4);
  Cloth cloth                  = sheet_cloth(mesh, one, upper_corners(4));
  const Vectors rest           = Vectors::Zero(mesh.n_vertices(), 3);
  for (const double bad : {no_number, infinity})
  {
    const auto with = [bad](Vectors values)
    {
      values(7, 1) = bad;
      return values;
    };
    expect_refused("positions of a state", "not finite",
                   [&]() { cloth.set_state(with(mesh.positions), rest, 0.); });
    expect_refused("velocities of a state", "not finite",
                   [&]() { cloth.set_state(mesh.positions, with(rest), 0.); });
    expect_refused("positions at the start", "vertex 7",
                   [&]() { Cloth(with(mesh.positions), cloth.masses(), {}); });
    expect_refused("a handle", "vertex 20", [&]() { cloth.prescribe(20, {0., bad, 0.}); });
    expect_refused("time step", "time step", [&]() { cloth.step(bad); });
    expect_refused("areal density", "areal density of phase 0",
                   [&]() { shell::lumped_masses(mesh, {bad}); });
    expect_refused("stiffness", "stiffness of phase 0",
                   [&]() { shell::membrane_term(mesh, {bad * Eigen::Matrix3d::Identity()}); });
    expect_refused("gravity", "gravity",
                   [&]() {
                     shell::gravity_term(cloth.masses(), {0., 0., bad});
                   });
    expect_refused("wind", "air: the velocity",
                   [&]()
                   {
                     shell::Air air;
                     air.velocity = [=](const Eigen::Vector3d &, double)
                     { return Eigen::Vector3d(bad, 0., 0.); };
                     Cloth blown = sheet_cloth(mesh, one, upper_corners(4));
                     blown.add(shell::wind_term(mesh, air));
                     blown.step(0.01);
                   });
  }
  expect_refused("time step of zero", "time step", [&]() { cloth.step(0.); });
  expect_refused("time step of -1 s", "time step", [&]() { cloth.step(-1.); });
  expect_refused("stiffness that is not positive definite", "stiffness of phase 0",
                 [&]() { shell::membrane_term(mesh, {-1. * Eigen::Matrix3d::Identity()}); });
}
