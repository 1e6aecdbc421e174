// SPDX-License-Identifier: MIT
// What solves a FineReference: its finite elements and constraints, from level to level.
#pragma once

#include "homogenization/fem/cell_entries.h"
#include "homogenization/fem/kept_preconditioner.h"
#include "homogenization/fem/node_gradients.h"
#include "verification/law/laws.h"
#include "verification/newton/newton.h"
#include "verification/reference/fine_reference.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace homespun::verification
{
/// Member functions that FineReference has too are what those call.
class FineReference::Solver
{
public:
  Solver(const meshes::Sheet &sheet, std::vector<Eigen::Matrix3d> stiffness_of_phase,
         const ReferenceOptions &options, MPI_Comm communicator);

  void start(const Load &load, Law law, BodyForce body_force);
  ReferenceStep advance(double strain);
  FieldDistance distance_from(const KnownField &known) const;
  ReferenceStep tighten(double tolerance);
  Stability stabilize(ReferenceStep &step);
  ReferencePath follow(double goal, double first_step);
  unsigned long n_dofs() const;

private:
  using Vector = homogenization::ElasticSolver::Vector;
  /// Sheets of weaves, a thousand times as stiff along the yarns as in shear, take some hundreds.
  static constexpr unsigned int most_linear_iterations = 3000;
  struct Evaluation
  {
    double energy             = 0.; ///< [J]
    unsigned int n_inverted   = 0;  ///< triangles with det F <= 0
    unsigned int n_indefinite = 0;  ///< as in ReferenceStep, where the exact tangent is assembled
    double residual           = 0.; ///< norm over free DoFs [N]
    double force_size         = 0.; ///< norm of the element forces before they cancel [N]
    double round_off          = 0.; ///< norm of what rounded gradients do to the element forces [N]
    double energy_round_off   = 0.; ///< what they do to the energy at most [J]
    LoadForces forces;

    /// The residual that counts as none.
    double least_residual(const double tolerance) const
    {
      return std::max(tolerance * force_size, round_off);
    }
  };

  class Level; ///< as Newton's method sees it
  class Path;  ///< as its arc length sees it
  struct SolvedLevel
  {
    double strain; ///< 0 of linear theory, whose rates are known
    Vector displacement;
    Eigen::Vector2d free_strains;
    double rate = 0.; ///< what makes rates by strain of them
  };

  void constrain(const Load &load);
  Vector affine(double strain) const;
  SolvedLevel extrapolated(const std::vector<const SolvedLevel *> &from, double strain) const;
  SolvedLevel guess(double strain);
  void take_body_force(double strain);
  void go_to(double strain, ReferenceStep &step);
  void solve(Vector &displacement, double strain, double tolerance, ReferenceStep &step);
  void solve_with_sides(Vector &displacement, double strain, double tolerance, ReferenceStep &step);
  Eigen::Matrix2d slope_of_sides(const Vector &displacement, double strain, double tolerance,
                                 ReferenceStep step);
  Evaluation evaluate(const Vector &displacement, const Eigen::Matrix2d &mean_gradient,
                      Vector &residual, Tangent tangent);
  template <int n_shapes>
  struct TriangleSums;
  template <int n_shapes>
  TriangleSums<n_shapes>
  integrate(const homogenization::NodeGradients &gradients, const LawOfPhase &phase,
            const Eigen::Matrix<double, n_shapes, 2, Eigen::RowMajor> &displacements,
            const Eigen::Matrix2d &mean_gradient, Tangent tangent, Evaluation &state) const;
  void add_over_ranks(Evaluation &state) const;
  template <int n_shapes>
  Evaluation assemble(const Vector &displacement, const Eigen::Matrix2d &mean_gradient,
                      Vector &residual, Tangent tangent);
  meshes::Points positions_of(const Vector &displacement, double strain) const;
  Eigen::Matrix2d mean_gradient_at(double strain) const;
  Stability examine(const Vector &displacement, double strain, ReferenceStep &step, Vector &mode);
  bool leave_along(const Vector &mode, Vector &displacement, double strain);

  const meshes::Sheet &sheet;
  const std::vector<Eigen::Matrix3d> stiffness_of_phase;
  const ReferenceOptions options;
  const homogenization::Discretization discretization;
  homogenization::DofTable vertex_dofs;
  std::vector<homogenization::Node> boundary;

  std::unique_ptr<Load> load;
  Law law = Law::linear;
  std::vector<LawOfPhase> phases; ///< under that law
  BodyForce body_force;
  Vector body_load; ///< at the strain that is being solved; empty without a body force
  dealii::AffineConstraints<double> constraints; ///< homogeneous: held nodes, periodic images
  std::map<dealii::types::global_dof_index, int> clamp_of_node; ///< by the first DoF; 1 moves
  std::unique_ptr<homogenization::ElasticSolver> solver;
  std::unique_ptr<homogenization::CellEntries> cells; ///< of its matrix
  homogenization::KeptPreconditioner preconditioner;
  double seconds_of_linear_solve = 0.;
  unsigned int most_newton_steps = NewtonOptions().most_steps;

  std::vector<SolvedLevel> levels;        ///< the last three
  std::optional<SolvedLevel> linear_rate; ///< of the present load, where it was asked for

  // Of a load with free sides:
  Eigen::Vector2d free_strains = Eigen::Vector2d::Zero();
  Eigen::Matrix2d side_slope   = Eigen::Matrix2d::Zero(); ///< stresses by strains, by Broyden; zero
                                                          ///< before the first level [N/m]
};
} // namespace homespun::verification
