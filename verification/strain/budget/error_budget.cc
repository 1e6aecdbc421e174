// SPDX-License-Identifier: MIT
#include "verification/strain/budget/error_budget.h"

#include "localization/upsampler.h"
#include "meshes/plain/errors.h"
#include "verification/method/method.h"
#include "verification/strain/budget/second_code.h"

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
/// Of an infinite cloth the affine motion is exact on any mesh.
std::array<Quads, 2> quads_of(const meshes::Sheet &sheet, const Load &load, const int refinement)
{
  if (load.is_periodic())
    return {{{1, 1}, {1, 1}}};
  return {quads_per_cell(sheet, refinement), quads_per_cell(sheet, refinement / 2)};
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
    , quads(quads_of(sheet, load, refinement))
    , coarse(sheet, quads_per_cell(sheet, 1))
    , resolved(sheet, quads[0])
    , half_resolved(sheet, quads[1])
{
  const CoarseState u    = sheets(Law::linear).resolved.solve(linear_strain);
  const LocalState state = resolved.at_fine_vertices(Law::linear, u.positions);
  if (cells.edges && !load.is_periodic())
    edges = edges_piece_by_piece(*cells.edges);
  const Points with_chi = localized(state, cells.given, sheet);
  ErrorBudget linear;
  measure_edges(u, with_chi, Law::linear, linear);
  with_terms   = edge_terms_of(linear) / linear_strain;
  rest         = (with_chi - second) / linear_strain + with_terms;
  fluctuation  = (second - state.positions) / linear_strain;
  localization = (with_chi - state.positions) / linear_strain;
}

/// Made where a law is first asked for.
const LoadBudget::SheetsOfLaw &LoadBudget::sheets(const Law law)
{
  std::unique_ptr<const SheetsOfLaw> &its = of_laws[law];
  const Method method("localized");
  if (!its)
    its.reset(new SheetsOfLaw{{{cells.given}, sheet, load, method, law, quads[0]},
                              {{cells.given}, sheet, load, method, law, quads[1]},
                              {{cells.best}, sheet, load, method, law},
                              {{cells.tight}, sheet, load, method, law}});
  return *its;
}

/// The parts that edges make up, at a strain and law: fields of zeros where there are none.
void LoadBudget::measure_edges(const CoarseState &u, const Points &with_exact, const Law law,
                               ErrorBudget &budget)
{
  const Points zero        = Points::Zero(with_exact.rows(), 2);
  const EdgeParts parts    = edges ? edge_parts(sheets(law).resolved, load, *edges, u, with_exact)
                                   : EdgeParts{zero, zero, zero, zero};
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
  last                         = sheets(law).resolved.solve(strain, last ? &*last : nullptr);
  const shell::Positions<2> &u = last->positions;
  const LocalState exact       = resolved.at_fine_vertices(law, u);
  const Points with_exact      = localized(exact, cells.given, sheet);

  budget.parts["macro-law"] = budget.parts["modes"] = zero;
  if (law != Law::linear)
    measure_nonlinearity(law, u, with_exact, budget);
  if (level.tight_reference == nullptr)
    return budget;
  measure_edges(*last, with_exact, law, budget);
  budget.parts["rest"] = strain * rest;
  if (law == Law::linear || level.second != nullptr)
    budget.bar = bar_of_sum(law, level, exact.positions, with_exact, budget);
  const Points with_averaged =
    localized(resolved.at_fine_vertices(law, u, coarse), cells.given, sheet);
  budget.parts["coarse-mesh"] =
    localized(coarse.at_fine_vertices(law, level.coarse), cells.given, sheet) - with_averaged;
  budget.parts["blending"]   = with_averaged - with_exact;
  budget.parts["resolution"] = resolution(law, strain, with_exact);

  const CoarseState u_coarse = {strain, level.coarse, level.coarse};
  const CoarseModel &best = sheets(law).best, &tight = sheets(law).tight;
  budget.parts["cell"] = level.upsampled - best.upsample(best.solve(strain, &u_coarse));
  if (level.p2_reference != nullptr)
    budget.parts["reference"] = *level.p2_reference - level.reference;

  shell::EquilibriumOptions options;
  options.relative_tolerance = 1e-13;
  budget.parts["solver"] =
    (level.upsampled - tight.upsample(tight.solve(strain, &u_coarse, options))) -
    (level.reference - *level.tight_reference);

  localization::Upsampler<2, float>::Fine in_float;
  localization::Upsampler<2, float>(cells.given, best.mesh(), sheet, best.parts.options)
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
  try
  {
    last_half = sheets(law).half_resolved.solve(strain, last_half ? &*last_half : nullptr);
    return with_exact -
           localized(half_resolved.at_fine_vertices(law, last_half->positions), cells.given, sheet);
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
  budget.misfit_of_localization = at_finite_strain.misfit();
  const shell::Positions<2> u_nonlinear =
    load.is_periodic()
      ? u
      : resolved.with_excess(law, cells.given.stiffness, load, at_finite_strain, u);
  const LocalState state      = resolved.at_fine_vertices(law, u_nonlinear);
  const Points with_small_chi = localized(state, cells.given, sheet);
  budget.parts["macro-law"]   = with_exact - with_small_chi;
  budget.parts["modes"] = with_small_chi - localized(state, cells.given, sheet, &at_finite_strain);
}
} // namespace homespun::verification
