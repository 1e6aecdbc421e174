// SPDX-License-Identifier: MIT
// The shell's cloth on a sheet of one or of a varying stiffness, held at its rim and under forces
// that make it follow a known motion.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "shell/solver/cloth.h"
#include "tests/verification/manufactured/manufactured.h"
#include "tests/verification/manufactured/manufactured_cases.h"
#include "tests/verification/manufactured/manufactured_motions.h"

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// A stiffness that is one, or varies smoothly.
struct NamedStiffness
{
  std::string name; ///< "homogeneous" or "heterogeneous"
  StiffnessField at;
};
NamedStiffness uniform(const Eigen::Matrix3d &stiffness);
NamedStiffness graded(const Eigen::Matrix3d &stiffness);

/// An irregular mesh whose triangles are phases of their own, with the stiffness of their centres.
struct GradedSheet
{
  meshes::TriangleMesh rest;
  std::vector<Eigen::Matrix3d> stiffness; ///< per triangle [N/m]
  std::vector<int> rim;                   ///< vertices

  /// Lumped, of manufactured_density (n) [kg].
  Eigen::VectorXd masses() const;
};
GradedSheet sheet_of(int n, const NamedStiffness &stiffness);

constexpr double manufactured_density = 0.2; ///< [kg/m^2]

/// Where a motion has the vertices (n,3) [m].
meshes::SpacePoints positions_of(const meshes::TriangleMesh &rest, const KnownField &motion);

/// A cloth that begins where a motion does, at rest.
class FollowingCloth
{
public:
  /// @param sheet outlives the cloth
  /// @param forces on the vertices at a time (n,3) [N]: the Euler methods take those at the end of
  ///   a step, the conserving integrator those of its middle
  FollowingCloth(const GradedSheet &sheet, const SheetMotion &motion,
                 const shell::ClothOptions &options,
                 std::function<meshes::SpacePoints(double time)> forces);

  /// @throws NotConverged where a step is cut: then it is not the scheme that was asked for
  void take_steps(int n_steps, double dt);

  void find_equilibrium(double tolerance);

  /// Against a motion at the time of the cloth, over the area.
  ManufacturedSolution compared(const SheetMotion &exact) const;

  /// The same over the vertices, root mean square.
  ManufacturedSolution compared_at_vertices(const SheetMotion &exact) const;

private:
  void hold_at(double time);

  const GradedSheet &sheet;
  const SheetMotion motion;
  shell::Cloth cloth;
};
} // namespace homespun::verification
