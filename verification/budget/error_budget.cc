// SPDX-License-Identifier: MIT
#include "verification/budget/error_budget.h"

#include "localization/upsampler.h"
#include "meshes/plain/errors.h"
#include "verification/budget/second_code.h"
#include "verification/method/method.h"

#include <algorithm>
#include <limits>

namespace homespun::verification
{
using meshes::Points;

const std::vector<std::string> &budget_parts()
{
  static const std::vector<std::string> names = {
    "slip", "selvedge", "bulk",      "layer",  "rest",      "macro-law", "modes",     "coarse-mesh",
    "cell", "blending", "time-step", "solver", "precision", "reference", "resolution"};
  return names;
}

bool is_in_sum(const std::string &part)
{
  return part != "cell" && part != "reference" && part != "precision" && part != "resolution";
}

Points ErrorBudget::sum() const
{
  Points result = Points::Zero(total.rows(), 2);
  for (const auto &[name, field] : parts)
    if (is_in_sum(name))
      result += field;
  return result;
}

int budget_refinement(const meshes::Sheet &sheet)
{
  return std::clamp(160 / std::max(sheet.n1, sheet.n2) / 2 * 2, 4, 16);
}

namespace
{
/// The method with its default options.
Points upsampled(const meshes::HomogenizedCell &cell, const meshes::TriangleMesh &coarse,
                 const meshes::Sheet &sheet, const Law law, const shell::Positions<2> &positions)
{
  localization::Upsampler<2, double>::Fine fine;
  localization::Upsampler<2, double>(cell, coarse, sheet, Method("localized").options(law))
    .upsample(positions, fine);
  return fine;
}

/// S4 − S0 of a budget: what the terms of edges add.
Points edge_terms_of(const ErrorBudget &budget)
{
  return -(budget.parts.at("slip") + budget.parts.at("selvedge") + budget.parts.at("bulk") +
           budget.parts.at("layer"));
}
} // namespace

LoadBudget::LoadBudget(const BudgetCells &cells, const meshes::Sheet &sheet, const Load &load,
                       const Points &second, const double linear_strain, const int refinement)
    : cells(cells)
    , sheet(sheet)
    , load(load)
    , coarse(cells.given.stiffness, sheet, load, sheet.n1, sheet.n2)
    , coarse_best(cells.best.stiffness, sheet, load, sheet.n1, sheet.n2)
    , coarse_tight(cells.tight.stiffness, sheet, load, sheet.n1, sheet.n2)
    , resolved(cells.given.stiffness, sheet, load, load.is_periodic() ? 1 : sheet.n1 * refinement,
               load.is_periodic() ? 1 : sheet.n2 * refinement)
    , half_resolved(cells.given.stiffness, sheet, load,
                    load.is_periodic() ? 1 : sheet.n1 * refinement / 2,
                    load.is_periodic() ? 1 : sheet.n2 * refinement / 2)
{
  const shell::Positions<2> u = resolved.solve(Law::linear, resolved.prescribed(linear_strain));
  const LocalState state      = resolved.at_fine_vertices(Law::linear, u);
  if (cells.edges && !load.is_periodic())
    edges.emplace(cells.given, *cells.edges, sheet, load, refinement);
  const Points with_chi = localized(state, cells.given, sheet);
  ErrorBudget linear;
  measure_edges(Law::linear, u, with_chi, linear);
  with_terms   = edge_terms_of(linear) / linear_strain;
  rest         = (with_chi - second) / linear_strain + with_terms;
  fluctuation  = (second - state.positions) / linear_strain;
  localization = (with_chi - state.positions) / linear_strain;
}

/// The parts that edges make up, at a strain and law: fields of zeros where there are none.
void LoadBudget::measure_edges(const Law law, const shell::Positions<2> &u,
                               const Points &with_exact, ErrorBudget &budget) const
{
  const Points zero = Points::Zero(with_exact.rows(), 2);
  const EdgeParts parts =
    edges ? edges->measure(law, u, with_exact) : EdgeParts{zero, zero, zero, zero};
  budget.parts["slip"]     = parts.slip;
  budget.parts["selvedge"] = parts.selvedge;
  budget.parts["bulk"]     = parts.bulk;
  budget.parts["layer"]    = parts.layer;
}

double LoadBudget::bar_of_sum(const Law law, const SolvedLevel &level, const Points &homogenized,
                              const Points &with_exact, const ErrorBudget &budget) const
{
  const auto mean        = [](const Points &field) { return field.rowwise().norm().mean(); };
  const double strain    = level.strain;
  const Points part_2    = budget.parts.at("macro-law") + budget.parts.at("modes");
  const double of_part_2 = budget.misfit_of_localization * mean(part_2);
  const double of_codes  = agreement * strain * std::sqrt(sheet.lattice.area());
  if (law == Law::linear || load.is_periodic())
    return of_part_2 + of_codes;
  const Points of_sheet = *level.second - homogenized - strain * fluctuation;
  const Points of_cell  = with_exact - part_2 - homogenized - strain * localization;
  const Points of_edges = edge_terms_of(budget) - strain * with_terms;
  return mean(of_sheet) + mean(of_cell) + mean(of_edges) + of_part_2 + of_codes;
}

ErrorBudget LoadBudget::measure(const Law law, const SolvedLevel &level)
{
  ErrorBudget budget;
  const double strain = level.strain;
  budget.total        = level.upsampled - level.reference;
  const Points zero   = Points::Zero(budget.total.rows(), 2);

  // The resolved homogenized solution starts from that of the strain before.
  shell::Positions<2> start = resolved.prescribed(strain);
  if (last_displacement.size() > 0)
    start = resolved.with_held(resolved.mesh.vertices + strain * last_displacement, strain);
  const shell::Positions<2> u = resolved.solve(law, start);
  last_displacement           = (u - resolved.mesh.vertices) / strain;
  const LocalState exact      = resolved.at_fine_vertices(law, u);
  const LocalState averaged   = resolved.at_fine_vertices(law, u, coarse);
  const Points with_exact     = localized(exact, cells.given, sheet);
  const Points with_averaged  = localized(averaged, cells.given, sheet);

  measure_edges(law, u, with_exact, budget);
  budget.parts["rest"]      = strain * rest;
  budget.parts["macro-law"] = budget.parts["modes"] = zero;
  if (law != Law::linear)
    measure_nonlinearity(law, u, with_exact, budget);
  if (law == Law::linear || level.second != nullptr)
    budget.bar = bar_of_sum(law, level, exact.positions, with_exact, budget);
  budget.parts["coarse-mesh"] =
    localized(coarse.at_fine_vertices(law, level.coarse), cells.given, sheet) - with_averaged;
  budget.parts["blending"]   = with_averaged - with_exact;
  budget.parts["resolution"] = resolution(law, strain, with_exact);

  const shell::Positions<2> u_best =
    coarse_best.solve(law, coarse_best.with_held(level.coarse, strain));
  budget.parts["cell"] = level.upsampled - upsampled(cells.best, coarse.mesh, sheet, law, u_best);
  if (level.p2_reference != nullptr)
    budget.parts["reference"] = *level.p2_reference - level.reference;

  shell::EquilibriumOptions tight;
  tight.relative_tolerance          = 1e-13;
  const shell::Positions<2> u_tight = coarse_tight.solve(law, level.coarse, tight);
  budget.parts["solver"] =
    (level.upsampled - upsampled(cells.tight, coarse.mesh, sheet, law, u_tight)) -
    (level.reference - level.tight_reference);

  localization::Upsampler<2, float>::Fine in_float;
  localization::Upsampler<2, float>(cells.given, coarse.mesh, sheet,
                                    Method("localized").options(law))
    .upsample(level.coarse, in_float);
  budget.parts["precision"] = in_float.cast<double>() - level.upsampled;
  budget.parts["time-step"] = zero;
  return budget;
}

/// What the homogenized sheet moves by from a mesh half as fine. It stands beside the sum: where
/// that mesh finds no equilibrium it is not a number, and the other parts stay.
Points LoadBudget::resolution(const Law law, const double strain, const Points &with_exact)
{
  if (load.is_periodic()) // the affine motion is exact on any mesh
    return Points::Zero(with_exact.rows(), 2);
  shell::Positions<2> start = half_resolved.prescribed(strain);
  if (last_half_displacement.size() > 0)
    start = half_resolved.with_held(half_resolved.mesh.vertices + strain * last_half_displacement,
                                    strain);
  try
  {
    const shell::Positions<2> u = half_resolved.solve(law, start);
    last_half_displacement      = (u - half_resolved.mesh.vertices) / strain;
    return with_exact - localized(half_resolved.at_fine_vertices(law, u), cells.given, sheet);
  }
  catch (const meshes::NotConverged &)
  {
    return Points::Constant(with_exact.rows(), 2, std::numeric_limits<double>::quiet_NaN());
  }
}

/// Part 2: the homogenized sheet and its localization by the small-strain theory, against both at
/// finite strain, one after the other.
void LoadBudget::measure_nonlinearity(const Law law, const shell::Positions<2> &u,
                                      const Points &with_exact, ErrorBudget &budget) const
{
  const NonlinearCell cell(cells.given, cells.stiffness_of_phase, law);
  const NonlinearLocalization at_finite_strain(cell, cells.given, resolved.strains(law, u));
  budget.misfit_of_localization         = at_finite_strain.misfit();
  const shell::Positions<2> u_nonlinear = resolved.solve(law, at_finite_strain, u);
  const LocalState state                = resolved.at_fine_vertices(law, u_nonlinear);
  const Points with_small_chi           = localized(state, cells.given, sheet);
  budget.parts["macro-law"]             = with_exact - with_small_chi;
  budget.parts["modes"] = with_small_chi - localized(state, cells.given, sheet, &at_finite_strain);
}
} // namespace homespun::verification
