// SPDX-License-Identifier: MIT
#include "verification/extremes/stress_cell_group.h"

#include "verification/extremes/stress_solver.h"

#include <cmath>

namespace homespun::verification
{
using homogenization::isotropic;

namespace
{
/// By how much the bounds of Voigt and Reuss are violated, relative to the larger side.
double bound_violation(const SolvedCell &found)
{
  const double above = order_violation(found.stiffness, found.voigt);
  return found.reuss.isZero() ? above
                              : larger(above, order_violation(found.reuss, found.stiffness));
}
} // namespace

Phase soft_phase(const double nu)
{
  return isotropic("soft", 1e6, nu, 5e-4, 400.);
}

Phase stiff_phase(const double contrast, const double nu)
{
  return isotropic("stiff", 1e6 * contrast, nu, 5e-4, 400.);
}

Phase yarn_phase(const double angle)
{
  return {"yarn", 1e9, 1e5, 0.3, 1e5, angle, 5e-4, 400.};
}

StressAnswer against_factorized(const UnitCell &cell)
{
  const SolvedCell found = solved(cell);
  return {
    larger(energy_difference(found.stiffness, factorized_stiffness(cell)), bound_violation(found)),
    found.stiffness};
}

StressAnswer against_laminate(const UnitCell &cell, const unsigned int order)
{
  const SolvedCell found = solved(cell, order);
  return {larger(energy_difference(found.stiffness,
                                   laminate_stiffness(cell.stiffness_of_phase(), {0.5, 0.5})),
                 bound_violation(found)),
          found.stiffness};
}

StressAnswer against(const UnitCell &cell, const UnitCell &original, const Eigen::Matrix2d &Q,
                     const double factor)
{
  const Eigen::Matrix3d found = solved(cell).stiffness, before = solved(original).stiffness;
  return {energy_difference(found / factor, moved_tensor(before, Q)), found};
}

Eigen::Matrix2d turn(const double angle)
{
  const double a = angle * M_PI / 180.;
  return (Eigen::Matrix2d() << std::cos(a), -std::sin(a), std::sin(a), std::cos(a)).finished();
}

Limit limit_of(const UnitCell &cell)
{
  return {algebraic_limit(cell, std::sqrt(0.5 * cell.mesh.n_triangles())),
          "round-off: 1e-11 for sums over up to 1e5 triangles; (rows x 2.2e-16 x contrast)^2 for "
          "a stiff part that a soft one holds; 16 x 2.2e-16 x anisotropy of a phase, whose "
          "entries are rounded"};
}

void CellGroup::refused(const std::string &what, const std::string &names, const UnitCell &cell)
{
  group
    .refused(what, names,
             [cell](unsigned int) -> StressAnswer
             {
               refuse_unsound(cell);
               return {0., solved(cell).stiffness};
             })
    .most_repeats = 2;
}
} // namespace homespun::verification
