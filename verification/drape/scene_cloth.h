// SPDX-License-Identifier: MIT
// The cloth of a scene in the shell's code, coarse or at full resolution: composed from the terms
// that the scene lists and no others.
#pragma once

#include "shell/membrane/six_node_membrane.h"
#include "shell/solver/cloth.h"
#include "shell/terms/plate_term.h"
#include "verification/drape/held_motion.h"
#include "verification/method/moving_edges.h"
#include "verification/scene/scene.h"

#include <memory>
#include <string>
#include <vector>

namespace homespun::verification
{
/// How the membrane is modelled: by an energy, corotational or of yarns, or by what the paper has
/// in its place, without one.
enum class MembraneModel
{
  corotational, ///< law biot
  woven,        ///< law yarn, shell/terms/yarn_term.h
  triangle_warping,
  nodal_warping
};

/// Whether a model has an energy, and so may be the method, against which variants are held.
bool has_energy(MembraneModel model);

std::string name_of(MembraneModel model);

bool is_membrane_model(const std::string &name);

/// @throws BadInput listing the names
MembraneModel membrane_model_of(const std::string &name);

/// One entry per phase of the mesh, and what a method adds.
struct ClothMaterial
{
  std::vector<Eigen::Matrix3d> stiffness; ///< [N/m]
  std::vector<double> areal_density;      ///< [kg/m^2]
  /// [N m], where the scene takes its bending from the cell; a stiffness of the scene's own is that
  /// of all phases.
  std::vector<shell::PlateStiffness> bending = {};
  /// Cubic energies of the corotational membrane (membrane_term.h); empty: none.
  std::vector<meshes::CubicForm> cubic = {};
  /// What edges of a sheet add; none: null.
  std::shared_ptr<const MovingEdges> edges = {};
  /// Triangles of the membrane on the same vertices, whose mass they have then; none: null, and the
  /// membrane has those of the mesh. All other terms keep those.
  std::shared_ptr<const shell::SixNodeMesh> six_nodes = {};
  /// Conserving steps take hinges whatever it says.
  shell::PlateModel plate = shell::PlateModel::by_mesh;
};

class SceneCloth
{
public:
  /// @param forced terms that the scene does not list, added at zero strength: what they would cost
  /// @throws BadInput where the parts do not fit together
  SceneCloth(const Scene &scene, const meshes::ClothMesh &mesh, const ClothMaterial &material,
             HeldMotion motion, MembraneModel model = MembraneModel::corotational,
             const std::set<std::string> &forced = {});

  /// Moves the handles to their places at the end of the step, and steps.
  shell::StepReport step(double h);

  /// Equilibrium with the handles where they are at a time, and the edges' slip that of itself.
  /// @throws NotConverged
  void solve_equilibrium(double time);

  /// What the membrane and the plate store [J]; not a number where the forces of the membrane have
  /// no energy.
  double elastic_energy() const;

  shell::Cloth &cloth()
  {
    return *moving;
  }
  const shell::Cloth &cloth() const
  {
    return *moving;
  }

private:
  void add_membrane(const ClothMaterial &material, MembraneModel model, double viscosity);
  void prescribe(double time);
  void add_edges();

  const meshes::ClothMesh mesh;
  const HeldMotion motion;
  const std::shared_ptr<const MovingEdges> edges;
  std::vector<int> held;
  std::unique_ptr<shell::Cloth> moving;
};

/// Terms whose cost can be measured: those that the scene has, and those that can be forced on it
/// at zero strength. Friction needs obstacles to act on.
std::vector<std::string> terms_with_a_cost(const Scene &scene);

/// Potential of the weight, −Σ m g·x [J]; not a number in a scene without gravity.
double gravity_energy(const Scene &scene, const Eigen::VectorXd &masses,
                      const shell::Vectors &positions);

/// Largest principal stretch of any triangle [-].
double largest_stretch(const meshes::ClothMesh &mesh, const shell::Vectors &positions);
} // namespace homespun::verification
