// SPDX-License-Identifier: MIT
// The cloth of a scene in the shell's code, coarse or at full resolution: composed from the terms
// that the scene lists and no others.
#pragma once

#include "shell/solver/cloth.h"
#include "shell/terms/plate_term.h"
#include "verification/drape/held_motion.h"
#include "verification/drape/scene/scene.h"
#include "verification/method/coarse_parts.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// The name of a membrane: that of its law, or, without one, `nodal-warping`, what the paper has in
/// the place of an energy.
std::string name_of_membrane(std::optional<Law> law);

/// @return none for `nodal-warping`
/// @throws BadInput listing the names
std::optional<Law> membrane_of(const std::string &name);

/// One entry per phase of the mesh, and what a method adds.
struct ClothMaterial
{
  std::optional<Law> law;                 ///< none: nodal warping
  std::vector<Eigen::Matrix3d> stiffness; ///< [N/m]
  std::vector<double> areal_density;      ///< [kg/m^2]
  /// [N m], where the scene takes its bending from the cell; a stiffness of the scene's own is that
  /// of all phases.
  std::vector<shell::PlateStiffness> bending = {};
  /// Of the coarse cloth of a sheet; its six-node triangles carry the membrane alone, and the mass.
  std::shared_ptr<const CoarseParts<3>> parts = {};
  /// Conserving steps take hinges whatever it says.
  shell::PlateModel plate = shell::PlateModel::by_mesh;
};

class SceneCloth
{
public:
  /// @param forced terms that the scene does not list, added at zero strength: what they would cost
  /// @throws BadInput where the parts do not fit together
  SceneCloth(const Scene &scene, const meshes::ClothMesh &mesh, const ClothMaterial &material,
             HeldMotion motion, const std::set<std::string> &forced = {});

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
  void add_membrane(const ClothMaterial &material, double viscosity);
  void prescribe(double time);
  void add_edges();

  const meshes::ClothMesh mesh;
  const HeldMotion motion;
  const std::shared_ptr<const CoarseParts<3>> parts;
  const EdgeTerms<3> *const edges; ///< of the parts; null: none
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
