// SPDX-License-Identifier: MIT
#include "verification/drape/scene_cloth.h"

#include "meshes/files/obj_file.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/triangle_kinematics.h"
#include "shell/contact/obstacles.h"
#include "shell/terms/inertial_terms.h"
#include "shell/terms/lagged_load.h"
#include "shell/terms/law_terms.h"
#include "shell/terms/membrane_term.h"
#include "shell/terms/six_node_term.h"
#include "shell/terms/warping.h"
#include "shell/terms/wind.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
namespace
{
shell::Obstacle obstacle_of(const SceneObstacle &given, const double friction)
{
  shell::Obstacle obstacle;
  const std::vector<double> &n = given.numbers;
  obstacle.name                = given.kind;
  obstacle.friction            = friction;
  if (given.kind == "plane")
    obstacle.shape = shell::plane({n[0], n[1], n[2]}, {n[3], n[4], n[5]});
  else if (given.kind == "sphere")
  {
    obstacle.shape = shell::sphere({n[0], n[1], n[2]}, n[3]);
  }
  else
  {
    meshes::Surface surface = meshes::read_surface(given.file);
    surface.positions.rowwise() += Eigen::RowVector3d(n[0], n[1], n[2]);
    obstacle.shape =
      shell::closed_mesh(shell::ClosedSurface(surface.positions, surface.triangles, given.file));
  }
  return obstacle;
}

shell::Integrator integrator_of(const TimeIntegration integration)
{
  switch (integration)
  {
  case TimeIntegration::implicit:
    return shell::Integrator::implicit;
  case TimeIntegration::conserving:
    return shell::Integrator::conserving;
  default:
    return shell::Integrator::linearly_implicit;
  }
}

constexpr const char *nodal_warping = "nodal-warping";

const shell::SixNodeMesh *six_nodes_of(const ClothMaterial &material)
{
  return material.parts && material.parts->space.six_nodes ? &*material.parts->space.six_nodes
                                                           : nullptr;
}
} // namespace

std::string name_of_membrane(const std::optional<Law> law)
{
  return law ? name_of(*law) : nodal_warping;
}

std::optional<Law> membrane_of(const std::string &name)
{
  std::vector<std::string> names = shell::names_of_cloth_laws();
  if (std::find(names.begin(), names.end(), name) != names.end())
    return law_of(name);
  if (name == nodal_warping)
    return {};
  meshes::refuse_removed_law(name);
  if (name == "triangle-warping")
    throw meshes::BadInput("`" + name +
                           "` was removed in 0.2.0: its rotations, frozen over a step, do not "
                           "survive steps of a scene; use nodal-warping, the paper's, or a law");
  names.emplace_back(nodal_warping);
  throw meshes::BadInput("found `" + name + "`; expected " + meshes::one_of(names));
}

std::vector<std::string> terms_with_a_cost(const Scene &scene)
{
  std::vector<std::string> terms = {"bending", "gravity", "damping"};
  if (scene.integration != TimeIntegration::conserving)
    terms.insert(terms.end(), {"wind", "obstacles"});
  if (scene.has("obstacles"))
    terms.emplace_back("friction");
  return terms;
}

double gravity_energy(const Scene &scene, const Eigen::VectorXd &masses,
                      const shell::Vectors &positions)
{
  if (!scene.has("gravity"))
    return std::numeric_limits<double>::quiet_NaN();
  return 0. - masses.dot(positions * scene.gravity.transpose());
}

SceneCloth::SceneCloth(const Scene &scene, const meshes::ClothMesh &mesh,
                       const ClothMaterial &material, HeldMotion given_motion,
                       const std::set<std::string> &forced)
    : mesh(mesh)
    , motion(std::move(given_motion))
    , parts(material.parts)
    , edges(parts && parts->edges ? &*parts->edges : nullptr)
    , held(motion.vertices(mesh))
{
  const shell::SixNodeMesh *const six_nodes = six_nodes_of(material);
  const Eigen::VectorXd masses =
    six_nodes != nullptr ? shell::six_node_masses(*six_nodes, material.areal_density.front())
                         : shell::lumped_masses(mesh, material.areal_density);
  shell::ClothOptions options;
  options.integrator = integrator_of(scene.integration);
  moving             = std::make_unique<shell::Cloth>(mesh.positions, masses, held, options);
  const auto forces  = [&](const char *term) { return forced.count(term) != 0; };

  const bool damped      = scene.has("damping");
  const double viscosity = damped ? scene.viscosity : forces("damping") ? 1e-300 : 0.;
  add_membrane(material, viscosity);
  if (edges != nullptr)
    add_edges();
  if (scene.has("bending") || forces("bending"))
  {
    std::vector<shell::PlateStiffness> plates = material.bending;
    if (!scene.has("bending") || scene.bending)
      plates.assign(material.stiffness.size(), scene.has("bending")
                                                 ? *scene.bending
                                                 : shell::PlateStiffness::isotropic(1e-30, 0.));
    moving->add(shell::plate_term(mesh, plates,
                                  options.integrator == shell::Integrator::conserving
                                    ? shell::PlateModel::hinges
                                    : material.plate));
  }
  if (scene.has("gravity") || forces("gravity"))
    moving->add(shell::gravity_term(
      masses, scene.has("gravity") ? scene.gravity : Eigen::RowVector3d::Zero().eval()));
  if ((damped && scene.damping_rate > 0.) || forces("damping"))
    moving->add(shell::mass_damping_term(masses, damped ? scene.damping_rate : 0.));
  if (scene.has("wind") || forces("wind"))
  {
    shell::Air air;
    air.density                    = scene.has("wind") ? scene.air_density : 0.;
    air.normal_drag                = scene.drag;
    const Eigen::Vector3d velocity = scene.wind.transpose();
    air.velocity = [velocity](const Eigen::Vector3d &, double) { return velocity; };
    moving->add(shell::wind_term(mesh, air));
    if (scene.pressure != 0.)
      moving->add(
        shell::pressure_term(mesh, [pressure = scene.pressure](double) { return pressure; }));
  }
  if (scene.has("obstacles") || forces("obstacles"))
  {
    shell::ContactParameters parameters;
    parameters.thickness = scene.contact_thickness;
    if (scene.has("gravity"))
      parameters.gravity = scene.gravity.transpose();
    std::vector<SceneObstacle> obstacles = scene.obstacles;
    // Out of reach.
    if (obstacles.empty())
      obstacles.push_back({"plane", {0., 0., -1e6, 0., 0., 1.}, ""});
    for (const SceneObstacle &obstacle : obstacles)
      moving->add(shell::obstacle_term(obstacle_of(obstacle, scene.has("friction") ? scene.friction
                                                             : forces("friction")  ? 1e-30
                                                                                   : 0.),
                                       masses, parameters));
  }
}

void SceneCloth::add_membrane(const ClothMaterial &material, const double viscosity)
{
  if (material.law)
  {
    for (auto &term :
         shell::law_terms(*material.law, mesh, six_nodes_of(material), material.stiffness,
                          viscosity, parts ? parts->cubic : std::vector<meshes::CubicForm>()))
      moving->add(std::move(term));
    return;
  }
  moving->add(shell::nodal_warping_term(mesh, material.stiffness, moving->masses()));
  if (viscosity > 0.)
    moving->add(shell::viscosity_term(mesh, material.stiffness, viscosity));
}

void SceneCloth::add_edges()
{
  if (!edges->selvedges().empty())
    moving->add(shell::selvedge_term(edges->selvedges()));
  if (edges->has_bulk_forces())
    moving->add(shell::lagged_load_term("strain gradient",
                                        [of = edges](const shell::Vectors &positions)
                                        { return shell::Vectors(of->forces(positions)); }));
}

void SceneCloth::prescribe(const double time)
{
  if (edges == nullptr)
  {
    for (const int v : held)
      moving->prescribe(v, motion.position(v, mesh, time));
    return;
  }
  const shell::Vectors slip = edges->slip(moving->positions());
  for (const int v : held)
    moving->prescribe(v, motion.position(v, mesh, time) + slip.row(v));
}

shell::StepReport SceneCloth::step(const double h)
{
  if (edges != nullptr || motion.moves_after(moving->time()))
    prescribe(moving->time() + h);
  return moving->step(h);
}

void SceneCloth::solve_equilibrium(const double time)
{
  // Slip and gradient forces follow the equilibrium that they belong to: each time what is left of
  // them is smaller by a cell over the sheet, or so.
  constexpr int most = 30;
  const double size =
    (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).maxCoeff();
  double change = 0.;
  for (int k = 0; k < most; ++k)
  {
    const shell::Vectors before = moving->positions();
    prescribe(time);
    moving->solve_equilibrium();
    moving->set_state(moving->positions(), moving->velocities(), time);
    change = (moving->positions() - before).cwiseAbs().maxCoeff();
    if (edges == nullptr || change <= 1e-9 * size)
      return;
  }
  throw meshes::NotConverged("terms of edges: after " + std::to_string(most) +
                               " equilibria the cloth still moves by " + std::to_string(change) +
                               " m from one to the next",
                             {change});
}

double SceneCloth::elastic_energy() const
{
  double sum = 0.;
  for (const auto &term : moving->terms())
  {
    if (!term->has_energy())
      return std::numeric_limits<double>::quiet_NaN();
    if (term->name() != "gravity")
      sum += term->stored_energy(moving->positions());
  }
  return sum;
}

double largest_stretch(const meshes::ClothMesh &mesh, const shell::Vectors &positions)
{
  double largest = 0.;
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const Eigen::Matrix2d rest =
      meshes::sides_of_triangle<2>(mesh.rest.triangles.row(t), mesh.rest.vertices);
    const Eigen::Matrix<double, 3, 2> F =
      meshes::sides_of_triangle<3>(mesh.triangles.row(t), positions) * rest.inverse();
    const Eigen::Matrix2d C = F.transpose() * F;
    const double mean       = 0.5 * C.trace();
    largest = std::max(largest, std::sqrt(mean + std::hypot(0.5 * (C(0, 0) - C(1, 1)), C(0, 1))));
  }
  return largest;
}
} // namespace homespun::verification
