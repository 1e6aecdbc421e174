// SPDX-License-Identifier: MIT
// The resolved cloth in motion that an up-sampled one is held against: every triangle of a flat
// rest mesh with its own stiffness and density, three displacement components, no bending. With W
// the law's energy per rest area and M the mass matrix the positions x minimise
//   implicit Euler  W(x) − g·M x + ½ (1/h² + alpha/h) |x − x_n − v_n / (1/h + alpha)|²_M,
//                   v = (x − x_n)/h
//   statics         W(x) − g·M x
// over the nodes that are not held. Newton's method with line search on these energies, conjugate
// gradients with multigrid kept between steps.
//
// Gravity acts on the mass as it is discretised, M g. With lumped mass free fall is exact, and for
// P1 M g is the consistent load; for P2 it is not, so that P2 shows its third order with the
// consistent mass only.
#pragma once

#include "homogenization/fem/elastic_solver.h"
#include "meshes/cloth/cloth_mesh.h"
#include "verification/reference/cloth_reference_options.h"
#include "verification/reference/field_integrals.h"
#include "verification/reference/space_laws.h"

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
  using Vector = homogenization::ElasticSolver::Vector;

  /// A triangle that this rank or a neighbour owns.
  struct Element
  {
    std::vector<int> nodes; ///< local node of each shape
    Eigen::Matrix2d inverse_transpose;
    double determinant; ///< [m^2]
    int phase;
    bool is_owned;
  };
  /// Quadratic form that is added to the energy: ½ factor |x − centre|²_M.
  struct Inertia
  {
    double factor; ///< [1/s^2]
    Vector centre; ///< [m]
  };
  struct Evaluation
  {
    double energy      = 0.; ///< what is minimised; gravity's since the start of the step [J]
    double energy_size = 0.; ///< sum of the absolute values of its terms [J]
    double residual    = 0.; ///< norm over free DoFs [N]
    double force_size  = 0.; ///< norm of the element forces before they cancel [N]
    double round_off   = 0.; ///< norm of what one rounding of the positions changes them by [N]
    bool is_converged(double tolerance) const;
  };

  void lay_out();
  void hold(double new_time);
  void put_held(Vector &positions) const;
  void lay_out_matrix();
  template <int n_shapes>
  Evaluation assemble(const Vector &positions, const Inertia &inertia, Vector &residual,
                      Tangent tangent, double tension);
  Evaluation evaluate(const Vector &positions, const Inertia &inertia, Vector &residual,
                      Tangent tangent, double tension);
  void solve_linearized(Vector &increment, const Vector &forces, double target, ClothStep &step);
  void minimize(Vector &positions, const Inertia &inertia, double tension, ClothStep &step);
  void advance(double dt, unsigned int cuts, ClothStep &step);
  meshes::SpacePoints at_vertices(const Vector &values) const;

  const ClothReferenceOptions options;
  const std::vector<Eigen::Matrix3d> stiffness_of_phase;
  const std::vector<double> areal_density_of_phase;
  const int n_rest_vertices;
  const homogenization::Discretization discretization;
  const homogenization::DofTable vertex_dofs;
  const Eigen::MatrixXd reference_mass; ///< (shape, shape) of a triangle of area 1 and density 1

  std::vector<Element> elements;
  std::vector<Eigen::RowVector2d> node_points; ///< of the local nodes, in the order of their DoFs
  std::vector<dealii::types::global_dof_index> node_dofs; ///< their first DoFs
  std::vector<int>
    owned_row; ///< of the local nodes: first row on this rank, −1 where another owns it

  Held held;
  ClothLoads loads;
  double present_time = 0.;
  std::vector<std::optional<Eigen::RowVector3d>> held_at; ///< of the local nodes
  std::vector<char> is_held;                              ///< what the matrix is laid out for
  dealii::AffineConstraints<double> constraints;
  std::unique_ptr<homogenization::ElasticSolver> solver;
  std::vector<double *> row_values; ///< of the owned rows
  std::vector<int> block_offset;    ///< (element, shape, shape): where in a row, −1 where nowhere
  bool preconditioner_is_old           = true;
  double iterations_per_digit_when_new = 0.;

  Vector position, velocity, load_origin;
  Vector body_load; ///< at the end of the step; empty without a body force
  meshes::SpacePoints positions_at_vertices;
};
} // namespace homespun::verification
