// SPDX-License-Identifier: MIT
#include "verification/stress/stress_sheet_axes.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/sheet.h"
#include "meshes/plain/symmetric_eigen.h"
#include "shell/solver/rigid_motion.h"
#include "verification/command/data_folder.h"
#include "verification/drape/held_motion.h"
#include "verification/drape/scene_cloth.h"
#include "verification/record/number_text.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
using shell::Cloth;
using shell::Integrator;
using shell::Vectors;

namespace
{
constexpr double most_of_conserved = 1e-10; ///< ten digits
constexpr double most_of_motion    = 1e-3;

/// The largest growth of energy in a step over the largest energy, of a sheet of two phases that
/// hangs and is disturbed by velocities of 2 m/s, from two seeds.
StressAnswer hang(const SheetStiffness &stiffness, const double h)
{
  StressAnswer worst;
  for (const unsigned int seed : {0u, 1u})
  {
    meshes::ClothMesh mesh = hanging_mesh();
    mesh.rest.material.tail(mesh.rest.n_triangles() / 2).setOnes(); // the upper half
    Cloth cloth        = sheet_cloth(mesh, stiffness, upper_corners());
    Vectors velocities = 2. * meshes::random_vectors(mesh.n_vertices(), seed); // [m/s]
    for (const int v : upper_corners())
      velocities.row(v).setZero();
    cloth.set_state(mesh.positions, velocities, 0.);
    worst.error  = larger(worst.error, largest_energy_growth(cloth, h, h < 0.05 ? 60 : 30));
    worst.values = state_of(cloth);
  }
  return worst;
}

/// A free sheet that spins about its normal [1/s], and flies.
Cloth spinning_cloth(const SheetStiffness &stiffness, const double omega,
                     const Integrator integrator)
{
  const meshes::ClothMesh mesh = lying_mesh();
  SheetPhysics physics;
  physics.damping = 0.;
  physics.gravity.setZero();
  physics.options.integrator      = integrator;
  Cloth cloth                     = sheet_cloth(mesh, stiffness, {}, physics);
  Vectors velocities              = Vectors::Zero(mesh.n_vertices(), 3);
  const Eigen::RowVector3d centre = shell::centre_of_mass(cloth.masses(), mesh.positions);
  for (Eigen::Index i = 0; i < velocities.rows(); ++i)
    velocities.row(i) = Eigen::RowVector3d(0.3, 0.1, -0.2) +
                        Eigen::RowVector3d(0., 0., omega).cross(mesh.positions.row(i) - centre);
  cloth.set_state(mesh.positions, velocities, 0.);
  return cloth;
}

/// What is wrong in one of 50 steps, if anything is. Both Euler methods keep the linear momentum
/// and let the energy fall, the conserving one keeps both momenta too: to ten digits. Of a rigid
/// body with the angular velocity ω the motion (x_{n+1} − x_n)/h has the share 1/sqrt(1 + (h ω)²)
/// of its angular momentum with implicit Euler, 1/(1 + (h ω/2)²) with the midpoint rule: at least
/// half of that is asked for, where a sheet that freezes has none.
StressAnswer spun(Cloth cloth, const Integrator integrator, const double h)
{
  const Eigen::VectorXd &m   = cloth.masses();
  const Eigen::RowVector3d p = cloth.momentum(), L = cloth.angular_momentum();
  const double size    = m.dot(cloth.velocities().rowwise().norm());
  const bool keeps_all = integrator == Integrator::conserving;
  StressAnswer answer;
  for (int k = 0; k < 50 && answer.wrong.empty(); ++k)
  {
    const Vectors x               = cloth.positions();
    const Eigen::RowVector3d spin = cloth.angular_momentum();
    const double angle            = h * shell::spin_of(m, x, spin).norm();
    const double of_rigid =
      keeps_all ? 1. / (1. + 0.25 * angle * angle) : 1. / std::sqrt(1. + angle * angle);
    const double growth            = largest_energy_growth(cloth, h, 1);
    const Eigen::RowVector3d moves = shell::angular_momentum(m, x, (cloth.positions() - x) / h);
    const double lost              = (cloth.momentum() - p).norm() / size,
                 kept   = keeps_all ? (cloth.angular_momentum() - L).norm() / L.norm() : 0.,
                 turned = moves.dot(spin) / spin.squaredNorm() / of_rigid;
    answer.error        = larger(answer.error, larger(growth, larger(lost, kept)));
    const double most   = cloth.positions().rowwise().norm().maxCoeff();
    if (!(turned >= 0.5))
      answer.wrong = "in step " + std::to_string(k + 1) + " it turns by " + short_text(turned) +
                     " of what a rigid body does; it is " + short_text(most / sheet_side) +
                     " sides wide";
  }
  answer.values = state_of(cloth);
  return answer;
}

constexpr double spin_step = 0.01; ///< [s]

/// The turn per step up to which theory says that the sheet holds together.
double safe_turn(const SheetStiffness &stiffness)
{
  const double softest = meshes::symmetric_eigen<3>(stiffness.D).values(0),
               radius  = 0.5 * std::sqrt(2.) * sheet_side;
  return spin_step * std::sqrt(softest / stiffness.areal_density) / radius / (2. * M_PI);
}

std::vector<double> ladder_of(const double first, const double factor, const int n)
{
  std::vector<double> ladder;
  for (int k = 0; k < n; ++k)
    ladder.push_back(first * std::pow(factor, k));
  return ladder;
}

/// An axis of a sheet that hangs. @param change what the value makes of the sheet; the step [s]
StressAxis hung(const SheetStiffness &stiffness, const char *const name, const char *const value_is,
                const std::vector<double> &ladder,
                const std::function<double(double value, SheetStiffness &changed)> &change)
{
  StressAxis axis;
  axis.axis      = name;
  axis.of        = "hung sheet, " + stiffness.name;
  axis.value_is  = value_is;
  axis.criterion = "largest growth of energy in a step over the largest energy";
  axis.limit     = energy_round_off;
  axis.ladder    = ladder;
  axis.at        = [=](const double value)
  {
    SheetStiffness changed = stiffness;
    const double h         = change(value, changed);
    return hang(changed, h);
  };
  return axis;
}

/// The claim that an axis goes so far at least.
StressAxis promised(StressAxis axis, const double end)
{
  axis.theory     = TheoryOfEnd::promises;
  axis.theory_end = end;
  axis.theory_is =
    "nothing brings energy into the sheet, and damping takes some, whatever the step";
  return axis;
}

constexpr int cells_of_scene  = 8; ///< along a side
constexpr int frames_of_scene = 8;

/// Where a scene is at equal times, one frame below the other, the first at the beginning.
/// @param n_steps a multiple of the frames
Vectors path_of_scene(const Scene &scene, const SheetStiffness &stiffness, const int n_steps)
{
  const Eigen::Matrix2d sides     = sheet_side * Eigen::Matrix2d::Identity();
  const Eigen::RowVector2d origin = -0.5 * sides.colwise().sum();
  meshes::TriangleMesh rest =
    meshes::coarse_sheet(origin, sides / cells_of_scene, cells_of_scene, cells_of_scene);
  rest.material                  = Eigen::VectorXi::Zero(rest.n_triangles());
  const SheetPlacement placement = placement_of(scene, origin, sides);
  meshes::ClothMesh mesh =
    meshes::placed_sheet(rest, Eigen::Matrix<double, 3, 2>::Identity(), Eigen::RowVector3d::Zero());
  for (int v = 0; v < mesh.rest.n_vertices(); ++v)
    mesh.positions.row(v) = placement.start(mesh.rest.vertices.row(v));
  SceneCloth cloth(scene, mesh, {stiffness.law, {stiffness.D}, {stiffness.areal_density}},
                   HeldMotion(scene, placement, origin, sides));
  const Eigen::Index n = mesh.positions.rows();
  Vectors path((frames_of_scene + 1) * n, 3);
  path.topRows(n) = mesh.positions;
  for (int k = 1; k <= n_steps; ++k)
  {
    cloth.step(scene.duration / n_steps);
    if (k % (n_steps / frames_of_scene) == 0)
      path.middleRows(k / (n_steps / frames_of_scene) * n, n) = cloth.cloth().positions();
  }
  return path;
}
} // namespace

std::vector<StressAxis> sheet_axes(const SheetStiffness &stiffness)
{
  const double edge  = sheet_side / cells_per_side,
               waves = std::sqrt(meshes::symmetric_eigen<3>(stiffness.D).values(2) /
                                 stiffness.areal_density) /
                       edge;
  const TheoryOfEnd promises = TheoryOfEnd::promises;
  constexpr double step      = 0.005; // [s]
  std::vector<StressAxis> axes;
  const std::vector<double> by_ten = ladder_of(10., 10., 12);
  axes.push_back(promised(hung(stiffness, "time step times stiffness",
                               "edges that a wave crosses in a step, h sqrt(D/rho)/edge [-]",
                               ladder_of(1e-5 * waves, 10., 9),
                               [=](const double value, SheetStiffness &) { return value / waves; }),
                          waves));
  axes.push_back(
    promised(hung(stiffness, "stiffness over density", "stiffer by this, at 5 ms [-]", by_ten,
                  [=](const double value, SheetStiffness &changed)
                  {
                    changed.D *= value;
                    return step;
                  }),
             1e5));
  axes.push_back(
    promised(hung(stiffness, "density over stiffness", "softer by this, at 5 ms [-]", by_ten,
                  [=](const double value, SheetStiffness &changed)
                  {
                    changed.D /= value;
                    return step;
                  }),
             1e4));
  axes.push_back(hung(stiffness, "thickness ratio", "upper over lower half, at 5 ms [-]", by_ten,
                      [=](const double value, SheetStiffness &changed)
                      {
                        changed.thicker = value;
                        return step;
                      }));
  axes.push_back(hung(stiffness, "density ratio", "upper over lower half, at 5 ms [-]", by_ten,
                      [=](const double value, SheetStiffness &changed)
                      {
                        changed.denser = value;
                        return step;
                      }));
  const std::vector<std::pair<Integrator, const char *>> integrators = {
    {Integrator::linearly_implicit, "linearly implicit"},
    {Integrator::implicit, "implicit"},
    {Integrator::conserving, "conserving"}};
  const double safe = safe_turn(stiffness);
  for (const auto &[integrator, name] : integrators)
  {
    StressAxis spin;
    spin.axis       = std::string("turn per step, ") + name;
    spin.of         = "free sheet, " + stiffness.name;
    spin.value_is   = "turns per step of 10 ms [-]";
    spin.criterion  = integrator == Integrator::conserving
                        ? "momenta and energy kept; turns by half of a rigid body or more"
                        : "linear momentum kept, energy never grows; turns by half of a rigid body "
                          "or more";
    spin.limit      = most_of_conserved;
    spin.ladder     = ladder_of(0.25 * safe, 2., 9);
    spin.theory     = promises;
    spin.theory_end = safe;
    spin.theory_is  = "a sheet of radius r that spins with omega is stretched by rho omega^2 r^2/2 "
                      "over its softest stiffness, twice that as it swings: below a half no "
                      "triangle is crushed and it turns as a rigid body; beyond, thrown apart, no "
                      "theory speaks";
    spin.at         = [=, integrator = integrator](const double value)
    {
      return spun(spinning_cloth(stiffness, 2. * M_PI * value / spin_step, integrator), integrator,
                  spin_step);
    };
    axes.push_back(spin);
  }
  return axes;
}

std::vector<StressAxis> scene_axes(const SheetStiffness &stiffness)
{
  std::vector<StressAxis> axes;
  for (const char *const name : {"hang", "pull"})
  {
    const Scene scene = read_scene(data_folder("scenes", "meshes/scenes") + "/" + name + ".prm");
    StressAxis axis;
    axis.axis      = "time step";
    axis.of        = std::string("scene ") + name + ", " + stiffness.name;
    axis.value_is  = "[s]";
    axis.criterion = "mean distance at eight times from where ever smaller steps go (Richardson, "
                     "first order), over the mean way";
    axis.limit     = most_of_motion;
    axis.ladder    = ladder_of(scene.duration / 2048., 2., 9);
    axis.at        = [=](const double h)
    {
      const int n         = static_cast<int>(std::lround(scene.duration / h));
      const Vectors once  = path_of_scene(scene, stiffness, n),
                    finer = path_of_scene(scene, stiffness, 2 * n);
      const Vectors start = once.topRows(once.rows() / (frames_of_scene + 1));
      StressAnswer answer;
      answer.error = 2. * (once - finer).rowwise().norm().sum() /
                     (finer - start.replicate(frames_of_scene + 1, 1)).rowwise().norm().sum();
      answer.values = once;
      return answer;
    };
    axes.push_back(axis);
  }
  return axes;
}
} // namespace homespun::verification
