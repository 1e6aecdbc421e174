// SPDX-License-Identifier: MIT
#include "verification/cell/cell_second_order.h"

#include "homogenization/cell/quadratic_strain.h"

#include <cmath>
#include <cstdio>

namespace homespun::verification
{
std::string too_dear_second_order(const homogenization::UnitCell &cell,
                                  const homogenization::HomogenizationOptions &options)
{
  // Six more right-hand sides for each law. Measured on one core, of two laws with P1: 1.2 s for
  // 132,098 unknowns by the direct solver, 2.1 s by multigrid, 26 s for 994,050.
  constexpr double most_seconds = 10., seconds_per_dof = 1.3e-5;
  const double n_dofs =
    2. * cell.mesh.n_vertices() * std::pow(4., options.refine) * (options.order == 2 ? 4. : 1.);
  const double estimate =
    seconds_per_dof * n_dofs *
    static_cast<double>(homogenization::laws_of_second_order(cell.phases).size());
  if (estimate <= most_seconds)
    return "";
  char text[160];
  std::snprintf(text, sizeof(text),
                "they would take about %.2g s on this mesh, more than %g: studies make them where "
                "they need them",
                estimate, most_seconds);
  return text;
}
} // namespace homespun::verification
