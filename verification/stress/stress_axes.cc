// SPDX-License-Identifier: MIT
// All differences are those of the energy of the worst macro strain, so that the soft directions of
// a cell count as much as its stiff ones.
#include "verification/stress/stress_axes.h"

#include "homogenization/bracket/compatible_strain.h"
#include "homogenization/cell/laminate.h"
#include "meshes/plain/errors.h"
#include "verification/cell/energy_order.h"
#include "verification/record/number_text.h"
#include "verification/record/timing.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
using homogenization::isotropic;

namespace
{
const char *const triangles = "triangles"; ///< the axis whose cells have as many
constexpr int rows_of_cases = 16;          ///< rectangles per side

/// Of a measurement: as many DoFs with P1 as with P2, more than the preconditioner factorizes at
/// once.
constexpr int rows_of(const unsigned int order)
{
  return order == 1 ? 48 : 24;
}

/// E = 1 MPa, half a millimetre thick.
Phase soft_phase(const double nu = 0.3)
{
  return isotropic("soft", 1e6, nu, 5e-4, 400.);
}

Phase stiff_phase(const double contrast, const double nu = 0.3)
{
  return isotropic("stiff", 1e6 * contrast, nu, 5e-4, 400.);
}

/// @param ratio of Young's moduli along and across @param angle of its axis [deg]
/// @param E, G across [Pa]
Phase yarn_phase(const double ratio, const double angle, const double E = 1e6, const double G = 4e5)
{
  return {"yarn", E * ratio, E, 0.3, G, angle, 5e-4, 400.};
}

/// Rows of a square of about so many triangles.
int rows_for(const double triangles)
{
  return 2 * static_cast<int>(std::lround(std::sqrt(triangles / 8.)));
}

Eigen::Matrix3d expected_stiffness(const UnitCell &cell, const Theory theory)
{
  if (theory == Theory::laminate)
    return homogenization::laminate_stiffness(cell.stiffness_of_phase(), {0.5, 0.5});
  const homogenization::TorusMesh torus = homogenization::glued(cell.mesh, cell.lattice);
  return homogenization::CompatibleStrain(torus, cell.stiffness_of_phase(), 1).stiffness;
}

/// C^H against theory, and against Voigt and Reuss.
StressAnswer against_theory(const UnitCell &cell, const Theory theory)
{
  const homogenization::Homogenization found = solved(cell);
  double worst = larger(energy_difference(found.stiffness, expected_stiffness(cell, theory)),
                        order_violation(found.stiffness, found.voigt));
  if (!found.reuss.isZero()) // as it is where the cell has holes
    worst = larger(worst, order_violation(found.reuss, found.stiffness));
  return {worst, found.stiffness};
}

/// Homogenizes a cell some times over and tells iterations and medians of the times.
SolverRow measured(SolverRow row, const UnitCell &cell, const int repeats)
{
  std::vector<double> of_solver;
  row.outcome = "converged";
  row.repeats = repeats;
  try
  {
    row.seconds_total = median_seconds(
      [&]()
      {
        const homogenization::Homogenization found = solved(cell, row.order);
        of_solver.push_back(found.seconds.preconditioner + found.seconds.solve);
        row.dofs       = found.n_dofs;
        row.iterations = *std::max_element(found.iterations.begin(), found.iterations.end());
      },
      repeats);
    row.seconds = median(of_solver);
  }
  catch (const meshes::NotConverged &failure)
  {
    const std::string text = failure.what();
    row.outcome            = text.substr(0, text.find("; residual norms"));
  }
  return row;
}
} // namespace

std::vector<CellAxis> cell_axes(const std::vector<UnitCell> &given)
{
  std::vector<CellAxis> axes;
  const auto add = [&](const char *const parameter, const std::string &cell, const Theory theory,
                       const std::vector<double> &values, const auto &make) {
    axes.push_back({parameter, cell, theory, values, make});
  };
  const auto laminate = Theory::laminate, direct = Theory::direct_solve;

  const std::vector<double> contrasts = {1e-9, 1e-6, 1e-3, 1e0, 1e3, 1e6, 1e9, 1e12};
  add("contrast", "stripes", laminate, contrasts,
      [](const double contrast, const int n)
      { return stripe_cell(n, soft_phase(), stiff_phase(contrast)); });
  add("contrast", "square inclusion", direct, contrasts,
      [](const double contrast, const int n)
      { return inclusion_cell(n, soft_phase(), stiff_phase(contrast)); });
  for (const UnitCell &cell : given)
    if (has_contrast(cell))
      add("contrast", cell.name, direct, contrasts,
          [=](const double contrast, int) { return with_contrast(cell, contrast); });

  const std::vector<double> ratios = {-0.99, -0.9, -0.5, 0., 0.3, 0.49, 0.4999, 0.499999, 0.5};
  add("poisson", "stripes of contrast 10", laminate, ratios,
      [](const double nu, const int n)
      { return stripe_cell(n, soft_phase(nu), stiff_phase(10., nu)); });
  add("poisson", "square inclusion", direct, ratios,
      [](const double nu, const int n)
      { return inclusion_cell(n, soft_phase(nu), stiff_phase(10., nu)); });

  const std::vector<double> moduli = {1e0, 1e1, 1e2, 1e3, 1e4};
  add("anisotropy", "stripes of yarns at 30 degrees", laminate, moduli,
      [](const double ratio, const int n)
      { return stripe_cell(n, soft_phase(), yarn_phase(ratio, 30., 1e5, 1e5)); });
  add("anisotropy", "yarns along axis 1", direct, moduli,
      [](const double ratio, const int n)
      { return inclusion_cell(n, soft_phase(), yarn_phase(ratio, 0.)); });
  add("anisotropy", "yarns at 45 degrees", direct, moduli,
      [](const double ratio, const int n)
      { return inclusion_cell(n, soft_phase(), yarn_phase(ratio, 45.)); });

  // Where a row of needles of 1e-6 meets the outline its vertices count as one.
  add("sliver", "row of needles", laminate, {1e0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5},
      [](const double height, const int n)
      { return stripe_cell(n, soft_phase(), stiff_phase(10.), height); });
  add("sliver", "one obtuse triangle", laminate, {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6},
      [](const double height, const int n)
      { return capped_stripes(n, soft_phase(), stiff_phase(10.), height); });

  add(triangles, "square inclusion", direct, {128., 512., 2048., 8192.},
      [](const double n, int)
      { return inclusion_cell(rows_for(n), soft_phase(), stiff_phase(10.)); });
  add(triangles, "stripes of contrast 10", laminate, {1e4, 1e5, 1e6},
      [](const double n, int) { return stripe_cell(rows_for(n), soft_phase(), stiff_phase(10.)); });
  return axes;
}

std::vector<StressCase> axis_cases(const std::vector<CellAxis> &axes, const int most_triangles)
{
  std::vector<StressCase> cases;
  for (const CellAxis &axis : axes)
    for (const double value : axis.values)
      if (axis.parameter != triangles || value <= most_triangles)
      {
        const std::string theory =
          axis.theory == Theory::laminate ? "the closed form" : "a direct solve";
        const Limit limit = limit_of(axis.make(value, rows_of_cases),
                                     "largest relative energy difference to " + theory +
                                       "; or violation of Voigt or Reuss [-]");
        cases.emplace_back(
          "cell " + axis.parameter, short_text(value) + "; " + axis.cell,
          "finite; is that of " + theory, limit,
          axis.parameter == triangles && value >= 1e5 ? Repeats::once : Repeats::twice,
          [=](unsigned int)
          { return against_theory(axis.make(value, rows_of_cases), axis.theory); });
      }
  return cases;
}

std::vector<SolverMeasurement> solver_measurements(const std::vector<CellAxis> &axes)
{
  std::vector<SolverMeasurement> all;
  for (const CellAxis &axis : axes)
    for (const double value : axis.values)
      if (axis.parameter != triangles || value <= 1e4)
        for (const unsigned int order : {1u, 2u})
        {
          SolverRow keys;
          keys.parameter = axis.parameter;
          keys.value     = value;
          keys.cell      = axis.cell;
          keys.order     = order;
          all.push_back({keys, [=](const int repeats)
                         { return measured(keys, axis.make(value, rows_of(order)), repeats); }});
        }
  return all;
}
} // namespace homespun::verification
