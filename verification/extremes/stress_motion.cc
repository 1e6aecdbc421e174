// SPDX-License-Identifier: MIT
// Motions whose outcome theory knows, and scenes at their time steps.
#include "meshes/plain/symmetric_eigen.h"
#include "meshes/plain/triangle_mesh.h"
#include "shell/contact/obstacles.h"
#include "shell/terms/inertial_terms.h"
#include "shell/terms/plate_term.h"
#include "shell/terms/wind.h"
#include "verification/extremes/stress_cases.h"
#include "verification/record/fields.h"
#include "verification/record/number_text.h"

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
constexpr double gravity = 9.81;

SheetPhysics undamped(const bool has_gravity)
{
  SheetPhysics physics;
  physics.damping = 0.;
  if (!has_gravity)
    physics.gravity.setZero();
  return physics;
}

/// Where the limits come from, by what the figure is.
const Derivations derivations_of_motions = {
  {"largest distance from the exact positions [m]",
   "theory: implicit Euler falls by g h^2 k (k + 1) / 2; round-off: 2.2e-16 x (1 + h^2 18 "
   "lambda_max(D) / (rho a^2)), the condition of a step, x g h^2 N^3 / 6, its velocity errors "
   "carried on over N steps"},
  {"largest relative change of momenta or growth of energy in 200 steps [-]",
   "theory: nothing acts on the sheet from outside; requirement: ten digits, ten times what 200 "
   "sums over 3 x 81 terms may round, 200 x 243 x 2.2e-16"},
  {"largest energy that a step took away over the largest energy [-]",
   "theory: implicit Euler takes (omega h)^2 of the energy of a spin in a step, and putting the "
   "spin right gives no more than that back"},
  {"largest sag [m]",
   "requirement: it holds; half of the side of the sheet, where free fall would be 4.9 m"},
  {growth_of_energy, of_energy},
  {"of the energy at the start [-]",
   "theory: in the frame of handle or air nothing brings energy in; round-off: that of a step, "
   "1e-11, in 100 steps"},
  {"deepest vertex inside the sphere beyond h times what other forces changed of its velocity in "
   "the step [m]",
   "theory: contact is seen where a step begins, and in it gravity and wind carry a vertex by h^2 "
   "times what they accelerate; requirement: beside that a tenth of the contact thickness, 1e-4 "
   "m, and never half of the radius"}};

constexpr double fall_step    = 0.01; ///< [s]
constexpr int n_steps_of_fall = 100;

/// Round-off of a fall. Step k solves (M + h² K) dx = ... for dx = h v_k, v_k = g h k; its
/// round-off is epsilon times the condition number, 1 + h² omega² with omega² <= 18 lambda_max(D) /
/// (rho a²) for linear triangles of altitude a and lumped mass, times dx. As a velocity error all
/// later steps carry it on: the sum of h v_k (N - k) is g h² N³/6.
double fall_round_off(const SheetStiffness &stiffness)
{
  const meshes::TriangleMesh mesh = meshes::irregular_sheet(cells_per_side, 0.2);
  const Eigen::VectorXd areas     = meshes::signed_areas(mesh);
  double altitude                 = std::numeric_limits<double>::infinity();
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::RowVector2d side =
        mesh.vertices.row(mesh.triangles(t, (k + 1) % 3)) - mesh.vertices.row(mesh.triangles(t, k));
      altitude = std::min(altitude, 2. * areas(t) / side.norm());
    }
  const double largest = meshes::symmetric_eigen<3>(stiffness.D).values(2);
  const double condition =
    1. + std::pow(fall_step / altitude, 2) * 18. * largest / stiffness.areal_density;
  return std::numeric_limits<double>::epsilon() * condition * gravity * std::pow(fall_step, 2) *
         std::pow(n_steps_of_fall, 3) / 6.;
}

/// Largest distance from where the integrator takes a body in free fall: both Euler methods to x0 +
/// h² g k (k + 1)/2, the conserving one to x0 + g t²/2.
StressAnswer free_fall(const SheetStiffness &stiffness, const shell::Integrator integrator,
                       const unsigned int seed)
{
  constexpr double h         = fall_step;
  constexpr int n_steps      = n_steps_of_fall;
  meshes::ClothMesh mesh     = hanging_mesh(cells_per_side);
  const Eigen::Vector3d axis = meshes::random_vectors(1, seed).row(0).normalized();
  mesh.positions =
    mesh.positions * Eigen::AngleAxisd(0.3 + seed, axis).toRotationMatrix().transpose();
  SheetPhysics physics       = undamped(true);
  physics.options.integrator = integrator;
  Cloth cloth                = sheet_cloth(mesh, stiffness, {}, physics);
  for (int k = 0; k < n_steps; ++k)
    cloth.step(h);
  const double n_products =
    n_steps * (integrator == shell::Integrator::conserving ? n_steps : n_steps + 1);
  const Vectors expected =
    mesh.positions.rowwise() - Eigen::RowVector3d(0., 0., gravity * h * h * 0.5 * n_products);
  return {(cloth.positions() - expected).rowwise().norm().maxCoeff(), state_of(cloth)};
}

/// Deepest point over one second, of a sheet clamped on four sides.
StressAnswer clamped(const SheetStiffness &stiffness)
{
  const meshes::ClothMesh mesh = lying_mesh(cells_per_side);
  Cloth cloth                  = sheet_cloth(mesh, stiffness, outline_of(cells_per_side));
  double deepest               = 0.;
  for (int k = 0; k < 200; ++k)
  {
    cloth.step(0.005);
    deepest = std::max(deepest, -cloth.positions().col(2).minCoeff());
  }
  return {deepest, state_of(cloth)};
}

StressAnswer hung_by_one_corner(const SheetStiffness &stiffness, const double h,
                                const shell::Integrator integrator)
{
  const meshes::ClothMesh mesh = lying_mesh(cells_per_side);
  SheetPhysics physics;
  physics.options.integrator = integrator;
  Cloth cloth                = sheet_cloth(mesh, stiffness, {0}, physics);
  const double growth        = largest_energy_growth(cloth, h, 200);
  return {growth, state_of(cloth)};
}

/// One edge suddenly moves away at 5 m/s. In its frame nothing does work: the energy there never
/// exceeds that of the flow that comes at it.
StressAnswer pulled(const SheetStiffness &stiffness, const double h,
                    const shell::Integrator integrator)
{
  constexpr double speed       = 5.;
  const meshes::ClothMesh mesh = hanging_mesh(cells_per_side);
  std::vector<int> held;
  for (int i = 0; i <= cells_per_side; ++i)
    held.push_back(cells_per_side * (cells_per_side + 1) + i);
  SheetPhysics physics       = undamped(false);
  physics.options.integrator = integrator;
  Cloth cloth                = sheet_cloth(mesh, stiffness, held, physics);
  const Eigen::RowVector3d velocity(0., 0., speed);
  const double at_start = 0.5 * speed * speed * cloth.masses().sum();
  double most           = 0.;
  for (int k = 1; k <= 100; ++k)
  {
    for (const int v : held)
      cloth.prescribe(v, mesh.positions.row(v) + k * h * velocity);
    cloth.step(h);
    const Vectors relative = cloth.velocities().rowwise() - velocity;
    const double kinetic   = 0.5 * cloth.masses().dot(relative.rowwise().squaredNorm());
    most                   = std::max(most, cloth.stored_energy() + kinetic);
  }
  return {most / at_start, state_of(cloth)};
}

shell::PlateStiffness plate()
{
  return shell::PlateStiffness::isotropic(1e-5, 0.3);
}

const Eigen::Vector3d scene_wind(8., 2., 0.); // [m/s]

/// Acceleration of a sheet that stands across the wind [m/s²].
double wind_acceleration(const SheetStiffness &stiffness)
{
  const shell::Air air;
  return 0.5 * air.density * air.normal_drag * scene_wind.squaredNorm() / stiffness.areal_density;
}

constexpr double radius = 0.06; ///< of the sphere [m]

/// A sheet with bending falls on a sphere, wind from the side: how deep a vertex is inside. What
/// other forces than gravity and wind do to it within a step is seen one step late: the way that
/// they carry it in the step is not counted.
StressAnswer draped(const SheetStiffness &stiffness, const double h, const bool has_wind,
                    const bool with_obstacle)
{
  const Eigen::Vector3d centre(0.1, 0.1, -0.1);
  const meshes::ClothMesh mesh = lying_mesh(cells_per_side);
  Cloth cloth                  = sheet_cloth(mesh, stiffness, {});
  cloth.add(shell::plate_term(mesh, {plate()}));
  shell::ContactParameters contact;
  contact.gravity << 0., 0., -gravity;
  if (with_obstacle)
    cloth.add(shell::obstacle_term({"ball", shell::sphere(centre, radius), 0.3, {}}, cloth.masses(),
                                   contact));
  if (has_wind)
  {
    shell::Air air;
    air.velocity = [](const Eigen::Vector3d &, double) { return scene_wind; };
    cloth.add(shell::wind_term(mesh, air));
  }
  const double of_wind = has_wind ? wind_acceleration(stiffness) : 0.;
  double deepest       = 0.;
  for (int k = 0; k < std::max(20., 0.3 / h); ++k)
  {
    const Vectors falling = cloth.velocities().rowwise() + h * contact.gravity.transpose();
    cloth.step(h);
    // Gravity and wind are in the limit.
    const Eigen::VectorXd
      changed =
        ((cloth.velocities() - falling).rowwise().norm().array() - h * of_wind).cwiseMax(0.),
      depth = radius - (cloth.positions().rowwise() - centre.transpose()).rowwise().norm().array();
    deepest = std::max(deepest, (depth - h * changed).maxCoeff());
  }
  return {deepest, state_of(cloth)};
}

StressAnswer with_bending(const SheetStiffness &stiffness, const double h, const unsigned int seed)
{
  const meshes::ClothMesh mesh = hanging_mesh(cells_per_side);
  Cloth cloth                  = sheet_cloth(mesh, stiffness, upper_corners(cells_per_side));
  cloth.add(shell::plate_term(mesh, {plate()}));
  Vectors velocities = meshes::random_vectors(mesh.n_vertices(), seed);
  for (const int v : upper_corners(cells_per_side))
    velocities.row(v).setZero();
  cloth.set_state(mesh.positions, velocities, 0.);
  const double growth = largest_energy_growth(cloth, h, 100);
  return {growth, state_of(cloth)};
}

/// A free sheet in a steady wind. Seen from the air, drag only takes energy.
StressAnswer blown(const SheetStiffness &stiffness, const double h)
{
  const Eigen::RowVector3d wind(10., 4., 0.);
  const meshes::ClothMesh mesh = hanging_mesh(cells_per_side);
  Cloth cloth                  = sheet_cloth(mesh, stiffness, {}, undamped(false));
  shell::Air air;
  air.tangential_drag = 0.05;
  air.velocity        = [=](const Eigen::Vector3d &, double) -> Eigen::Vector3d { return wind; };
  cloth.add(shell::wind_term(mesh, air));
  const double at_start = 0.5 * wind.squaredNorm() * cloth.masses().sum();
  double most           = 0.;
  for (int k = 0; k < 100; ++k)
  {
    cloth.step(h);
    const Vectors relative = cloth.velocities().rowwise() - wind;
    const double kinetic   = 0.5 * cloth.masses().dot(relative.rowwise().squaredNorm());
    most                   = std::max(most, cloth.stored_energy() + kinetic);
  }
  return {most / at_start, state_of(cloth)};
}

/// What the name of a case says of its integrator; nothing of the default.
std::string called(const shell::Integrator integrator)
{
  return integrator == shell::Integrator::implicit     ? "implicit; "
         : integrator == shell::Integrator::conserving ? "conserving; "
                                                       : "";
}

const Figure growing = {energy_round_off, growth_of_energy};

} // namespace

std::vector<StressCase> motion_cases(const std::vector<SheetStiffness> &stiffnesses)
{
  std::vector<StressCase> cases;
  CaseGroup group("motion", cases);
  for (const SheetStiffness &stiffness : stiffnesses)
  {
    for (const shell::Integrator integrator :
         {shell::Integrator::linearly_implicit, shell::Integrator::implicit,
          shell::Integrator::conserving})
      group
        .finite("free fall of one second; turned at random; " + called(integrator) + stiffness.name,
                "finite; straight and as the integrator falls",
                {fall_round_off(stiffness), "largest distance from the exact positions [m]"},
                [=](const unsigned int seed) { return free_fall(stiffness, integrator, seed); })
        .is_random = true;
    group.finite("four clamped edges under gravity; " + stiffness.name,
                 "finite; holds (free fall would be 4.9 m)", {0.1, "largest sag [m]"},
                 [=](unsigned int) { return clamped(stiffness); });
    for (const double h : {1e-3, 1e-2, 5e-2})
    {
      const std::string hung = "hung by one corner; " + short_text(1e3 * h) + " ms; ";
      group.finite(hung + stiffness.name, never_grows, growing,
                   [=](unsigned int) {
                     return hung_by_one_corner(stiffness, h, shell::Integrator::linearly_implicit);
                   });
      // Beyond 10 ms it takes minutes, and at 10 ms half of one: once.
      if (h < 0.02)
        group
          .finite(hung + "conserving; " + stiffness.name, never_grows, growing,
                  [=](unsigned int)
                  { return hung_by_one_corner(stiffness, h, shell::Integrator::conserving); })
          .most_repeats = 1;
      for (const shell::Integrator integrator :
           {shell::Integrator::linearly_implicit, shell::Integrator::implicit})
        group.finite("pulled at 5 m/s; " + short_text(1e3 * h) + " ms; " + called(integrator) +
                       stiffness.name,
                     "finite; in the frame of the handle never more energy than at the start",
                     {1. + 1e-9, "of the energy at the start [-]"},
                     [=](unsigned int) { return pulled(stiffness, h, integrator); });
    }
  }
  derive(cases, derivations_of_motions);
  return cases;
}

std::vector<StressCase> scene_cases(const SheetStiffness &stiffness, const Sphere sphere)
{
  std::vector<StressCase> cases;
  CaseGroup group("scene", cases);
  for (const double h : {1e-4, 1e-3, 5e-3, 1e-2, 2e-2, 5e-2})
  {
    const std::string step = "; " + short_text(1e3 * h) + " ms";
    for (const bool has_wind : {false, true})
      group.finite(
        std::string("falls on a sphere; bending and friction") + (has_wind ? " and wind" : "") +
          step,
        "finite; but for what other forces do within a step no vertex deeper inside than h^2 "
        "times the acceleration by gravity and wind and a tenth of the contact thickness, nor "
        "than half the radius",
        {std::min(0.5 * radius,
                  h * h * (gravity + (has_wind ? wind_acceleration(stiffness) : 0.)) + 1e-4),
         "deepest vertex inside the sphere beyond h times what other forces changed of its "
         "velocity in the step [m]"},
        [=](unsigned int) { return draped(stiffness, h, has_wind, sphere == Sphere::there); });
    group
      .finite("hung by two corners; bending" + step, never_grows, growing,
              [=](const unsigned int seed) { return with_bending(stiffness, h, seed); })
      .is_random = true;
    group.finite("free sheet in wind of 11 m/s" + step,
                 "finite; seen from the air never more energy than at the start",
                 {1. + 1e-9, "of the energy at the start [-]"},
                 [=](unsigned int) { return blown(stiffness, h); });
  }
  derive(cases, derivations_of_motions);
  return cases;
}
} // namespace homespun::verification
