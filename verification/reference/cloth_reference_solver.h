// SPDX-License-Identifier: MIT
// What solves a ClothReference: its finite elements, mass and constraints, from time to time.
#pragma once

#include "homogenization/fem/cell_entries.h"
#include "homogenization/fem/kept_preconditioner.h"
#include "homogenization/fem/node_gradients.h"
#include "verification/reference/cloth_reference.h"

#include <memory>
#include <optional>
#include <vector>

namespace homespun::verification
{
/// Member functions that ClothReference has too are what those call.
class ClothReference::Solver
{
public:
  Solver(const meshes::TriangleMesh &rest, std::vector<Eigen::Matrix3d> stiffness_of_phase,
         std::vector<double> areal_density_of_phase, const ClothReferenceOptions &options,
         MPI_Comm communicator);

  void start(const Placement &initial_position, const Held &held, const ClothLoads &loads);
  void resume(const meshes::SpacePoints &positions, const meshes::SpacePoints &velocities,
              double time);
  ClothStep step(double dt);
  ClothStep solve_equilibrium(double time);
  const meshes::SpacePoints &positions() const;
  meshes::SpacePoints velocities() const;
  double time() const;
  double stored_energy() const;
  double kinetic_energy() const;
  FieldDistance distance_from(const KnownField &known) const;
  unsigned long n_dofs() const;

private:
  using Vector = homogenization::ElasticSolver::Vector;

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
  };
  class Minimum; ///< as Newton's method sees it

  void hold(double new_time);
  void put_held(Vector &positions) const;
  void lay_out_matrix();
  template <int n_shapes>
  struct ElasticSums;
  template <int n_shapes>
  ElasticSums<n_shapes> integrate(const homogenization::NodeGradients &gradients,
                                  const Eigen::Matrix3d &C,
                                  const Eigen::Matrix<double, n_shapes, 3, Eigen::RowMajor> &at,
                                  Tangent tangent, double tension) const;
  Evaluation summed(std::vector<double> sums, const Vector &positions, Vector &residual) const;
  template <int n_shapes>
  Evaluation assemble(const Vector &positions, const Inertia &inertia, Vector &residual,
                      Tangent tangent, double tension);
  Evaluation evaluate(const Vector &positions, const Inertia &inertia, Vector &residual,
                      Tangent tangent, double tension);
  void minimize(Vector &positions, const Inertia &inertia, double tension, ClothStep &step);
  void advance(double dt, ClothStep &step);
  template <typename OfCell>
  double sum_over_cells(const Vector &field, const OfCell &of_cell) const;
  std::size_t phase_of(int cell) const;
  meshes::SpacePoints at_vertices(const Vector &values) const;

  const ClothReferenceOptions options;
  const std::vector<Eigen::Matrix3d> stiffness_of_phase;
  const std::vector<double> areal_density_of_phase;
  const int n_rest_vertices;
  const homogenization::Discretization discretization;
  const homogenization::DofTable vertex_dofs;
  const Eigen::MatrixXd reference_mass; ///< (shape, shape) of a triangle of area 1 and density 1

  const std::vector<homogenization::Node> nodes; ///< of the cells that this rank owns

  Held held;
  ClothLoads loads;
  double present_time = 0.;
  std::vector<std::optional<Eigen::RowVector3d>> held_at; ///< of the nodes
  std::vector<char> is_held;                              ///< what the matrix is laid out for
  dealii::AffineConstraints<double> constraints;
  std::unique_ptr<homogenization::ElasticSolver> solver;
  std::unique_ptr<homogenization::CellEntries> cells; ///< of its matrix
  homogenization::KeptPreconditioner preconditioner;

  Vector position, velocity, load_origin;
  Vector body_load; ///< at the end of the step; empty without a body force
  meshes::SpacePoints positions_at_vertices;
};
} // namespace homespun::verification
