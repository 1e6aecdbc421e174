// SPDX-License-Identifier: MIT
// The resolved cloth in motion that an up-sampled one is held against: every triangle of a flat
// rest mesh with its own stiffness and density, three displacement components, no bending. With W
// the law's energy per rest area and M the mass matrix the positions x minimise
//   implicit Euler  W(x) − g·M x + ½ (1/h² + alpha/h) |x − x_n − v_n / (1/h + alpha)|²_M,
//                   v = (x − x_n)/h
//   statics         W(x) − g·M x
// over the nodes that are not held. Newton's method with line search on these energies, conjugate
// gradients with a preconditioner kept between steps.
//
// Gravity acts on the mass as it is discretised, M g. With lumped mass free fall is exact, and for
// P1 M g is the consistent load; for P2 it is not, so that P2 shows its third order with the
// consistent mass only.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "verification/law/space_laws.h"
#include "verification/reference/cloth_reference_options.h"
#include "verification/reference/known_field.h"

#include <mpi.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
struct ClothLoads
{
  Eigen::RowVector3d gravity = Eigen::RowVector3d::Zero(); ///< [m/s^2]
  double mass_damping        = 0.;                         ///< alpha: force −alpha m v [1/s]
  /// Force per rest area [N/m^2] at a rest point and the end of a step [s]; empty: none.
  std::function<Eigen::RowVector3d(const Eigen::RowVector2d &rest_point, double time)> body_force =
    {};
};

/// One step in time, or one equilibrium.
struct ClothStep
{
  bool reached = false;          ///< false: not solved, the cloth is where it was; `why` says why
  std::string why;               ///< reason where it was not reached
  unsigned int n_newton    = 0;  ///< Newton steps
  unsigned int n_linear    = 0;  ///< iterations of conjugate gradients, all Newton steps
  unsigned int n_projected = 0;  ///< Newton steps that needed the positive tangent
  unsigned int n_parts     = 0;  ///< parts that the time step was cut into, 1 where it was not cut
  double relative_residual = 0.; ///< |forces on free nodes| / size of the element forces
  double seconds           = 0.; ///< wall time, slowest rank
};

/// A resolved sheet in space, brought from time to time.
class ClothReference
{
public:
  /// The position [m] of a held point at a time [s], or nothing where the cloth is free. Asked at
  /// every node of the discretisation (P2: midpoints too), on several ranks with the same answer.
  /// What is held may change in time.
  using Held = std::function<std::optional<Eigen::RowVector3d>(const Eigen::RowVector2d &rest_point,
                                                               double time)>;
  /// Position [m] of a rest point.
  using Placement = std::function<Eigen::RowVector3d(const Eigen::RowVector2d &rest_point)>;

  /// @param rest flat rest mesh, rest.material being the phase of each triangle
  /// @param stiffness_of_phase symmetric positive definite (3,3) [N/m], Voigt, engineering shear
  /// @param areal_density_of_phase positive [kg/m^2]
  /// @throws BadInput with all faults
  ClothReference(const meshes::TriangleMesh &rest, std::vector<Eigen::Matrix3d> stiffness_of_phase,
                 std::vector<double> areal_density_of_phase, const ClothReferenceOptions &options,
                 MPI_Comm communicator);
  ~ClothReference();

  /// Puts the cloth at rest at time 0. Held nodes are where `held` says.
  /// @throws BadInput where a position or a load is not finite or the damping negative
  void start(const Placement &initial_position, const Held &held, const ClothLoads &loads);

  /// Takes up a run where it was left: to be called after start(). P1 on the mesh as given, whose
  /// vertices are all nodes.
  /// @param positions, velocities (n,3) at the vertices of `rest` [m], [m/s]
  /// @throws BadInput for another discretization, and where sizes do not match or a number is not
  ///   finite
  void resume(const meshes::SpacePoints &positions, const meshes::SpacePoints &velocities,
              double time);

  /// One step of implicit Euler. A step that does not converge is cut in two, up to six times;
  /// where that fails too, the cloth is left where it was before the step.
  /// @param dt positive [s]
  ClothStep step(double dt);

  /// Static equilibrium under the loads with the held points where they are at a time, from the
  /// present positions; afterwards the cloth is at rest at that time. Pseudo-transient
  /// continuation: Newton's method with a fictitious tension in its tangent, which falls to zero
  /// with the residual (a flat sheet without stress has no stiffness along its normal). Equilibrium
  /// needs a sheet in tension.
  ClothStep solve_equilibrium(double time);

  /// (n,3) at the vertices of `rest`, on every rank [m].
  const meshes::SpacePoints &positions() const;
  /// (n,3) at the vertices of `rest`, on every rank [m/s].
  meshes::SpacePoints velocities() const;
  double time() const;           ///< [s]
  double stored_energy() const;  ///< of the law [J]
  double kinetic_energy() const; ///< ½ v·M v [J]
  /// How far the positions are from known ones, in the interior of the elements too.
  FieldDistance distance_from(const KnownField &known) const;
  unsigned long n_dofs() const;

private:
  class Solver; ///< with the finite elements, of which users of this header see nothing
  const std::unique_ptr<Solver> solver;
};
} // namespace homespun::verification
