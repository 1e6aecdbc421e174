// SPDX-License-Identifier: MIT
// One triangle turned, mirrored, collapsed, scaled; twisted strips; numbers that are not finite.
#include "meshes/plain/errors.h"
#include "meshes/plain/sheet.h"
#include "shell/contact/obstacles.h"
#include "shell/membrane/corotational_energy.h"
#include "shell/terms/inertial_terms.h"
#include "shell/terms/membrane_term.h"
#include "shell/terms/plate_term.h"
#include "shell/terms/wind.h"
#include "tests/verification/extremes/program_cases.h"
#include "verification/record/fields.h"
#include "verification/record/number_text.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
using shell::Cloth;
using shell::Vectors;

namespace
{
constexpr double nan      = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Where the limits come from, by what the figure is.
const Derivations derivations_of_rotations = {
  {"force over stiffness x edge [-]",
   "theory: a turned or mirrored triangle is not strained; round-off: ten roundings of a strain, "
   "four for area and gradients: 40 x 2.2e-16"},
  {"energy after a small step down the gradient over that before [-]",
   "theory: a small step down the gradient lowers the energy to first order; round-off of the two "
   "energies: below 1e-12"},
  {"minus the smallest over the largest eigenvalue [-]",
   "theory: the projected Hessian has no negative eigenvalue; round-off: five roundings for each "
   "of its 81 entries, 5 x 81 x 2.2e-16"},
  {"largest |P(QF) − Q P(F)| over the largest P [-]",
   "theory: the energy does not see a rotation; round-off: four roundings times the condition of "
   "F, up to a thousand: 4000 x 2.2e-16"},
  {"force over stiffness x side [-]; or way in 50 steps [m]",
   "theory: half a turn changes signs, which rounds nothing; round-off: five roundings of a "
   "strain"},
  {"stored energy over that of the helicoid [-]",
   "theory: the helicoid has the same ends, and what settles among all shapes has no more energy"},
  {"force beside gravity over stiffness x side [-]",
   "theory: a sheet that has not moved is not strained; round-off: ten roundings of a strain, "
   "four for area and gradients: 40 x 2.2e-16"},
  {growth_of_energy, of_energy}};

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
    return {nan, H};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> modes(H);
  Eigen::MatrixXd values(9, 10);
  values << H, Eigen::Map<const Eigen::VectorXd>(found.gradient.data(), 9);
  return {-modes.eigenvalues().minCoeff() / modes.eigenvalues().cwiseAbs().maxCoeff(), values};
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

using Misuse = std::function<void(Cloth &cloth, const meshes::ClothMesh &mesh)>;

/// What a user may get wrong with a cloth that hangs.
CaseGroup::Run misuse(const SheetStiffness &stiffness, const Misuse &action)
{
  return [=](unsigned int) -> StressAnswer
  {
    const meshes::ClothMesh mesh = hanging_mesh(4);
    Cloth cloth                  = sheet_cloth(mesh, stiffness, upper_corners(4));
    action(cloth, mesh);
    return {0., state_of(cloth)};
  };
}

void add_triangles(const SheetStiffness &stiffness, CaseGroup &group)
{
  const std::string of       = "; " + stiffness.name;
  const std::string of_force = "force over stiffness x edge [-]";
  for (const bool is_mirrored : {false, true})
    group
      .finite(std::string("triangle ") +
                (is_mirrored ? "mirrored in space" : "turned by 180 degrees about any axis") + of,
              "finite; no force", {1e-14, of_force},
              [=](const unsigned int seed) { return without_force(stiffness, is_mirrored, seed); })
      .is_random = true;
  group.finite("triangle mirrored in the plane" + of, "finite; pushed back",
               {1. - 1e-12, "energy after a small step down the gradient over that before [-]"},
               [=](unsigned int) { return mirrored_in_the_plane(stiffness); });
  for (const int rank : {0, 1, 2})
    group
      .finite("deformation gradient of rank " + std::to_string(rank) + of,
              "finite; the projected Hessian is positive semi-definite",
              {1e-13, "minus the smallest over the largest eigenvalue [-]"},
              [=](const unsigned int seed) { return of_rank(stiffness, rank, seed); })
      .is_random = true;
  for (const double scale : {1e-30, 1e-20, 1e-10, 1e10, 1e20, 1e30})
    group
      .finite("deformation gradient of size " + short_text(scale) + of,
              "finite; turns with the triangle",
              {1e-12, "largest |P(QF) − Q P(F)| over the largest P [-]"},
              [=](const unsigned int seed) { return scaled(stiffness, scale, seed); })
      .is_random = true;
}

void add_sheets(const SheetStiffness &stiffness, CaseGroup &group)
{
  const std::string of = "; " + stiffness.name;
  const Figure drift   = {1e-15, "force over stiffness x side [-]; or way in 50 steps [m]"};
  group.finite("sheet turned by exactly 180 degrees about axis 1" + of, "finite; rests", drift,
               [=](unsigned int) {
                 return sheet_turned(stiffness, {1., -1., -1.});
               });
  group.finite("sheet turned by exactly 180 degrees about axis 3" + of, "finite; rests", drift,
               [=](unsigned int) {
                 return sheet_turned(stiffness, {-1., -1., 1.});
               });
  const std::string less = "finite; no more energy than the helicoid";
  const Figure over      = {1., "stored energy over that of the helicoid [-]"};
  group.finite("strip twisted by 180 degrees in 90 steps" + of, less, over,
               [=](unsigned int) { return twisted(stiffness, 0.5, 90); });
  group.finite("strip twisted by 180 degrees in one step" + of, less, over,
               [=](unsigned int) { return twisted(stiffness, 0.5, 1); });
  group.finite("strip twisted by five turns in 600 steps" + of, less, over,
               [=](unsigned int) { return twisted(stiffness, 5., 600); });
}

void add_misuse(const SheetStiffness &one, CaseGroup &group)
{
  const auto refused = [&](const std::string &name, const std::string &names, const Misuse &action)
  { group.refused(name, names, misuse(one, action)); };
  for (const double bad : {nan, infinity})
  {
    const std::string number = std::isnan(bad) ? "not-a-number" : "infinity";
    const auto with          = [bad](Vectors values)
    {
      values(7, 1) = bad;
      return values;
    };
    refused(number + " in the positions of a state", "not finite",
            [=](Cloth &cloth, const meshes::ClothMesh &mesh)
            { cloth.set_state(with(mesh.positions), Vectors::Zero(mesh.n_vertices(), 3), 0.); });
    refused(number + " in the velocities of a state", "not finite",
            [=](Cloth &cloth, const meshes::ClothMesh &mesh)
            { cloth.set_state(mesh.positions, with(Vectors::Zero(mesh.n_vertices(), 3)), 0.); });
    refused(number + " in the positions at the start", "vertex 7",
            [=](Cloth &cloth, const meshes::ClothMesh &mesh)
            { Cloth(with(mesh.positions), cloth.masses(), {}); });
    refused(number + " for a handle", "vertex 20",
            [=](Cloth &cloth, const meshes::ClothMesh &) {
              cloth.prescribe(20, {0., bad, 0.});
            });
    refused(number + " as time step", "time step",
            [=](Cloth &cloth, const meshes::ClothMesh &) { cloth.step(bad); });
    refused(number + " as areal density", "areal density of phase 0",
            [=](Cloth &, const meshes::ClothMesh &mesh) { shell::lumped_masses(mesh, {bad}); });
    refused(number + " in the stiffness", "stiffness of phase 0",
            [=](Cloth &, const meshes::ClothMesh &mesh)
            { shell::membrane_term(mesh, {bad * Eigen::Matrix3d::Identity()}); });
    refused(number + " as gravity", "gravity",
            [=](Cloth &cloth, const meshes::ClothMesh &) {
              shell::gravity_term(cloth.masses(), {0., 0., bad});
            });
    refused(number + " as the wind", "air: the velocity",
            [=](Cloth &cloth, const meshes::ClothMesh &mesh)
            {
              shell::Air air;
              air.velocity = [=](const Eigen::Vector3d &, double)
              { return Eigen::Vector3d(bad, 0., 0.); };
              cloth.add(shell::wind_term(mesh, air));
              cloth.step(0.01);
            });
  }
  refused("time step of zero", "time step",
          [](Cloth &cloth, const meshes::ClothMesh &) { cloth.step(0.); });
  refused("time step of −1 s", "time step",
          [](Cloth &cloth, const meshes::ClothMesh &) { cloth.step(-1.); });
  refused("stiffness that is not positive definite", "stiffness of phase 0",
          [](Cloth &, const meshes::ClothMesh &mesh)
          { shell::membrane_term(mesh, {-1. * Eigen::Matrix3d::Identity()}); });
}

/// A cloth that is asked or thrown in uncommon ways.
void add_uncommon(const SheetStiffness &one, CaseGroup &group)
{
  group.finite("forces asked for before the first step; all terms", "finite; rests but for gravity",
               {1e-14, "force beside gravity over stiffness x side [-]"},
               [=](unsigned int) { return forces_before_the_first_step(one); });
  group.finite("velocity of 1e100 m/s", "finite; the energy of the damped sheet never grows",
               {energy_round_off, growth_of_energy},
               [=](unsigned int) -> StressAnswer
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
} // namespace

std::vector<StressCase> rotation_cases(const std::vector<SheetStiffness> &stiffnesses)
{
  std::vector<StressCase> cases;
  CaseGroup group("rotation and numbers", cases);
  for (const SheetStiffness &stiffness : stiffnesses)
  {
    add_triangles(stiffness, group);
    add_sheets(stiffness, group);
  }
  add_uncommon(stiffnesses.front(), group);
  add_misuse(stiffnesses.front(), group);
  derive(cases, derivations_of_rotations);
  return cases;
}
} // namespace homespun::verification
