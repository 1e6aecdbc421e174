// SPDX-License-Identifier: MIT
#include "verification/extremes/stress_solver.h"

#include "homogenization/fem/homogenize.h"
#include "meshes/plain/errors.h"
#include "verification/extremes/stress_cells.h"
#include "verification/record/timing.h"

#include <algorithm>
#include <chrono>

namespace homespun::verification
{
using homogenization::isotropic;

namespace
{
/// Rectangles per side: as many DoFs with P1 as with P2, more than the preconditioner factorizes at
/// once.
constexpr int rows_of(const unsigned int order)
{
  return order == 1 ? 48 : 24;
}

/// Homogenizes a cell some times over and tells iterations and medians of the times.
SolverRow measured(SolverRow row, const UnitCell &cell, const int repeats)
{
  std::vector<double> of_solver, in_all;
  row.outcome = "converged";
  row.repeats = repeats;
  try
  {
    for (int k = 0; k < repeats; ++k)
    {
      const auto begin       = std::chrono::steady_clock::now();
      const SolvedCell found = solved(cell, row.order);
      in_all.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
      of_solver.push_back(found.seconds);
      row.dofs       = found.n_dofs;
      row.iterations = found.iterations;
    }
    row.seconds       = median(of_solver);
    row.seconds_total = median(in_all);
  }
  catch (const meshes::NotConverged &failure)
  {
    const std::string text = failure.what();
    row.outcome            = text.substr(0, text.find("; residual norms"));
  }
  return row;
}
} // namespace

SolvedCell solved(const UnitCell &cell, const unsigned int order)
{
  homogenization::HomogenizationOptions options;
  options.order = order;
  const homogenization::Homogenization found =
    homogenization::homogenize(cell, options, MPI_COMM_SELF);
  return {found.stiffness,
          found.voigt,
          found.reuss,
          found.n_dofs,
          *std::max_element(found.iterations.begin(), found.iterations.end()),
          found.seconds.preconditioner + found.seconds.solve};
}

std::vector<SolverMeasurement> solver_measurements()
{
  std::vector<SolverMeasurement> all;
  const auto add = [&](const char *parameter, const double value, const char *name,
                       const std::function<UnitCell(int)> &make)
  {
    for (const unsigned int order : {1u, 2u})
    {
      SolverRow keys;
      keys.parameter = parameter;
      keys.value     = value;
      keys.cell      = name;
      keys.order     = order;
      all.push_back(
        {keys, [=](const int repeats) { return measured(keys, make(rows_of(order)), repeats); }});
    }
  };
  const Phase soft = isotropic("soft", 1e6, 0.3, 5e-4, 400.);
  const auto stiff = [](const double contrast, const double nu = 0.3)
  { return isotropic("stiff", 1e6 * contrast, nu, 5e-4, 400.); };
  for (const double contrast : {1e-9, 1e-6, 1e-3, 1e0, 1e3, 1e6, 1e9, 1e12})
    for (const bool is_striped : {false, true})
      add("contrast", contrast, is_striped ? "stripes" : "square inclusion",
          [=](const int n)
          {
            return is_striped ? stripe_cell(n, soft, stiff(contrast))
                              : inclusion_cell(n, soft, stiff(contrast));
          });
  for (const double nu : {-0.99, -0.9, -0.5, 0., 0.3, 0.49, 0.4999, 0.499999})
    add("poisson", nu, "square inclusion",
        [=](const int n)
        { return inclusion_cell(n, isotropic("soft", 1e6, nu, 5e-4, 400.), stiff(10., nu)); });
  for (const double ratio : {1e0, 1e1, 1e2, 1e3, 1e4})
    for (const double angle : {0., 45.})
      add("anisotropy", ratio, angle == 0. ? "yarns along axis 1" : "yarns at 45 degrees",
          [=](const int n)
          {
            const Phase yarn = {"yarn", 1e6 * ratio, 1e6, 0.3, 4e5, angle, 5e-4, 400.};
            return inclusion_cell(n, soft, yarn);
          });
  for (const double aspect : {1e0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6})
  {
    add("sliver", aspect, "row of needles",
        [=](const int n)
        {
          GridLines rows = equal_lines(n);
          if (aspect < 1.)
            rows.insert(rows.begin() + n / 2 + 1, 0.5 + aspect / n);
          return grid_cell(equal_lines(n), rows, {soft, stiff(10.)},
                           [](double, const double y) { return y < 0.5 ? 0 : 1; });
        });
    if (aspect < 1.)
      add("sliver", aspect, "one obtuse triangle",
          [=](const int n) { return capped_stripes(n, soft, stiff(10.), aspect); });
  }
  for (const int rows : {8, 16, 32, 64})
    add("triangles", 2. * rows * rows, "square inclusion",
        [=](int) { return inclusion_cell(rows, soft, stiff(10.)); });
  return all;
}
} // namespace homespun::verification
