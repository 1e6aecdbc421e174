// SPDX-License-Identifier: MIT
// A resolved sheet along the arc length of its equilibria, round limit points.
#include "meshes/plain/errors.h"
#include "verification/reference/fine_reference_solver.h"

#include <deal.II/base/mpi.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <cmath>
#include <stdexcept>
#include <tuple>
#include <vector>

namespace homespun::verification
{
using namespace dealii;

/// x is how far the displacement is from the affine one, u = x + s A: what is held has x = 0.
class FineReference::Solver::Path final : public PathProblem
{
public:
  Path(Solver &of, const SolvedLevel &start)
      : of(of)
      , affine(of.affine(1.))
      , displacement(start.displacement)
      , strain(start.strain)
      , along(of.solver->owned_vector())
      , residual(along)
      , by_residual(along)
      , by_strain(along)
      , kept{displacement, along, strain}
  {
  }

  PathLinearization linearize() override
  {
    const Vector slope = residual_by_strain();
    const Evaluation state =
      of.evaluate(displacement, of.mean_gradient_at(strain), residual, Tangent::exact);
    const Eigen::SparseMatrix<double> tangent = of.solver->lower_triangle();
    if (!is_analyzed)
      factor.analyzePattern(tangent);
    is_analyzed = true;
    factor.factorize(tangent);
    if (factor.info() != Eigen::Success)
      throw meshes::NotConverged("the tangent is singular to round-off", {});
    solve(residual, by_residual);
    solve(slope, by_strain);
    PathLinearization here;
    here.residual   = state.residual;
    here.least      = state.least_residual(of.options.tolerance);
    here.a_t        = by_residual * along;
    here.b_t        = by_strain * along;
    here.b_b        = by_strain * by_strain;
    here.n_negative = static_cast<int>((factor.vectorD().array() < 0.).count());
    return here;
  }

  void move(const double of_a, const double of_b, const double of_t, const double by) override
  {
    displacement.add(of_a, by_residual);
    displacement.add(of_b, by_strain);
    displacement.add(of_t, along);
    displacement.add(by, affine);
    strain += by;
  }

  void take_tangent(const double by) override
  {
    along = by_strain;
    along *= by;
    if (std::abs(strain) > std::abs(outermost_strain))
    {
      outermost        = displacement;
      outermost_strain = strain;
    }
  }

  /// Of the equilibria the one at the largest strain.
  meshes::Points outermost_positions() const
  {
    return of.positions_of(outermost, outermost_strain);
  }

  void mark() override
  {
    kept = {displacement, along, strain};
  }

  void return_to_mark() override
  {
    std::tie(displacement, along, strain) = kept;
  }

  double parameter() const override
  {
    return strain;
  }

private:
  /// By differences, whose error delays the ends of corrections only.
  Vector residual_by_strain()
  {
    constexpr double width = 1e-5;
    Vector ahead(residual), behind(residual), moved(displacement);
    moved.add(width, affine);
    of.evaluate(moved, of.mean_gradient_at(strain + width), ahead, Tangent::none);
    moved.add(-2. * width, affine);
    of.evaluate(moved, of.mean_gradient_at(strain - width), behind, Tangent::none);
    ahead.add(-1., behind);
    ahead *= 0.5 / width;
    return ahead;
  }

  void solve(const Vector &forces, Vector &answer) const
  {
    const Eigen::Map<const Eigen::VectorXd> right(forces.begin(),
                                                  static_cast<Eigen::Index>(forces.size()));
    Eigen::Map<Eigen::VectorXd>(answer.begin(), right.size()) = -factor.solve(right);
    of.constraints.distribute(answer);
  }

  Solver &of;
  const Vector affine;
  Vector displacement;
  double strain;
  Vector outermost        = displacement;
  double outermost_strain = strain;
  Vector along; ///< t
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor;
  bool is_analyzed = false;
  Vector residual, by_residual, by_strain;
  std::tuple<Vector, Vector, double> kept;
};

ReferencePath FineReference::Solver::follow(const double goal, const double first_step)
{
  if (Utilities::MPI::n_mpi_processes(discretization.communicator) > 1)
    throw std::logic_error("a path is followed on one rank");
  if (levels.empty() || load->has_free_sides() || law == Law::linear || body_force)
    return {};
  constexpr int most_steps = 40;
  Path along(*this, levels.back());
  ReferencePath result;
  try
  {
    result.path = follow_path(along, goal, first_step, most_steps);
  }
  catch (const meshes::NotConverged &)
  { // of a start whose tangent is singular
  }
  result.positions = along.outermost_positions();
  return result;
}
} // namespace homespun::verification
