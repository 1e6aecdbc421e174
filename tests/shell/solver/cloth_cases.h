// SPDX-License-Identifier: MIT
// Cloths in space that the tests of the moving cloth share.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "shell/solver/cloth.h"
#include "shell/terms/inertial_terms.h"
#include "shell/terms/membrane_term.h"
#include "tests/shell/shell_cases.h"

namespace homespun::tests
{
/// A square sheet of 20 cm, lying.
inline meshes::ClothMesh lying_sheet(const int n, const double side = 0.2)
{
  Eigen::Matrix<double, 3, 2> placement = Eigen::Matrix<double, 3, 2>::Identity();
  return meshes::placed_sheet(irregular_sheet(n, side), placement, Eigen::RowVector3d::Zero());
}

/// A cloth of fabric-like stiffness (some 1000 N/m, anisotropic with a ratio of 1e4) and 0.2 kg/m².
struct Fabric
{
  explicit Fabric(const meshes::ClothMesh &mesh, const std::vector<int> &held = {},
                  const shell::ClothOptions &options = {},
                  const Eigen::Matrix3d &stiffness = anisotropic(), const double viscosity = 0.)
      : masses(shell::lumped_masses(mesh, {0.2}))
      , cloth(mesh.positions, masses, held, options)
  {
    cloth.add(shell::membrane_term(mesh, {stiffness}, viscosity));
  }
  Eigen::VectorXd masses;
  shell::Cloth cloth;
};

inline const Eigen::RowVector3d earth(0., 0., -9.81);
} // namespace homespun::tests
