// SPDX-License-Identifier: MIT
// Loads with free sides: the strains of an infinite cloth that its stresses find.
#include "meshes/plain/errors.h"
#include "verification/reference/fine_reference_solver.h"

#include <Eigen/LU>

namespace homespun::verification
{
/// Differences of the stresses of the sides by their strains, the fluctuation in equilibrium.
Eigen::Matrix2d FineReference::Solver::slope_of_sides(const Vector &displacement,
                                                      const double strain, const double tolerance,
                                                      ReferenceStep step)
{
  const Eigen::Vector2d here   = free_strains;
  const Eigen::Vector2d stress = load->stress_of_sides(step.forces.stress);
  const double width           = 1e-3 * strain;
  Eigen::Matrix2d slope;
  for (int k = 0; k < 2; ++k)
  {
    Vector moved = displacement;
    free_strains(k) += width;
    solve(moved, strain, tolerance, step);
    slope.col(k) = (load->stress_of_sides(step.forces.stress) - stress) / width;
    free_strains = here;
  }
  return slope;
}

/// solve(), and of a load with free sides as often as it takes until nothing pulls at them: the
/// method of Broyden for two stresses and two strains.
/// @throws NotConverged
void FineReference::Solver::solve_with_sides(Vector &displacement, const double strain,
                                             const double tolerance, ReferenceStep &step)
{
  solve(displacement, strain, tolerance, step);
  if (!load->has_free_sides())
    return;
  // Mean stresses are sums of forces, of which the solver leaves `tolerance`.
  const double limit     = 10. * tolerance;
  Eigen::Vector2d stress = load->stress_of_sides(step.forces.stress);
  std::vector<double> history;
  constexpr int most_steps = 30;
  for (int k = 0; k <= most_steps; ++k)
  {
    history.push_back(stress.norm() / step.forces.stress.norm());
    if (history.back() <= limit)
      return;
    if (side_slope.isZero(0.))
      side_slope = slope_of_sides(displacement, strain, tolerance, step);
    const Eigen::Vector2d change = -side_slope.fullPivLu().solve(stress), before = stress;
    free_strains += change;
    solve(displacement, strain, tolerance, step);
    stress = load->stress_of_sides(step.forces.stress);
    side_slope +=
      (stress - before - side_slope * change) * change.transpose() / change.squaredNorm();
  }
  throw meshes::NotConverged("the sides do not become free of stress", history);
}
} // namespace homespun::verification
