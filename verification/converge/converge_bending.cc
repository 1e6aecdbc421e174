// SPDX-License-Identifier: MIT
// The study of bending: what D^H alone, w3 of the cell and the terms of edges leave of the error of
// a bent sheet, on sheets of more and more cells in linear theory.
#include "homogenization/bracket/bending_bracket.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/index.h"
#include "verification/bend/bent_sheet.h"
#include "verification/converge/converge_cases.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

namespace homespun::verification
{
using homogenization::UnitCell;
using meshes::at;

namespace
{
/// Judges the order of the deflection with all terms: 2 in sheet sides, or that of corners.
OrderJudgement judge_deflection(const BendingCell &bent, const BendingLoad &load,
                                const Series &series, const double floor)
{
  const std::vector<double> h = series.sizes();
  // The next power of the expansion is 3, and shows where the second has a small coefficient.
  OrderLimit limit = {2., 2.1}, together = {2., 3.1};
  // In the analogous membrane free edges are clamped, and clamped ones free.
  for (int axis = 0; axis < 2; ++axis)
    if (load.is_clamped[at(2 * axis)] && !load.is_clamped[at(2 - 2 * axis)])
    {
      const double exponent = corner_exponent(
        bent.cell.lattice, homogenization::analogous_membrane(bent.solved.stiffness), 1 - axis);
      limit.lowest    = std::min(limit.lowest, 2. * exponent);
      together.lowest = std::min(together.lowest, order_beside_a_corner(exponent, h.back()));
    }
  limit.lowest -= 0.1;
  together.lowest -= 0.1;
  return judge_errors(h, series.errors(), limit, floor, together);
}

/// The errors of a method over the levels: of the deflection and of the normal.
struct MethodSeries
{
  explicit MethodSeries(const std::string &method)
  {
    position.quantity = method + ": mean error of the deflection [k L^2]";
    normal.quantity   = method + ": mean error of the normal [k L]";
    position.h_unit = normal.h_unit = "cell sides per sheet side";
  }

  Series position, normal;
};

ConvergenceResult bend(const BendingCell &bent, const BendingLoad &load, const std::vector<int> &ns)
{
  std::vector<MethodSeries> methods;
  for (std::size_t k = 0; k + 1 < bending_methods.size(); ++k) // all but flat triangles
    methods.emplace_back(bending_methods[k]);
  if (!bent.known.edges)
    methods.resize(2, methods.front());
  ConvergenceResult result;
  double unresolved = 0.; // of the macro problem on the last sheet [k L^2]
  const auto solve  = [&](const int n)
  {
    const auto start = std::chrono::steady_clock::now();
    const BentSheet sheet(bent, load, n, macro_quads_per_cell(n));
    const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double side = std::sqrt(bent.cell.lattice.area()), length = n * side;
    unresolved = sheet.of_macro_mesh[methods.size() - 1].position / (length * length);
    for (std::size_t k = 0; k < methods.size(); ++k)
    {
      const auto add = [&](Series &series, const double error) {
        series.levels.push_back({1. / n, sheet.n_dofs, std::nullopt, error, seconds});
      };
      const BendingError error = mean_of(sheet.error_of_method[k]);
      add(methods[k].position, error.position / (length * length));
      add(methods[k].normal, error.normal / length);
    }
  };
  for (const int n : ns)
    if (!result.solves([&]() { solve(n); }))
      break;
  if (methods.front().position.levels.empty())
    return result;
  if (bent.is_of_one_material())
  {
    result.unfinished            = "the cell bends like one material: there is nothing to restore";
    result.outcome_of_unfinished = Outcome::inconclusive;
  }
  else if (bent.known.edges)
  {
    MethodSeries &full      = methods.back();
    full.position.judgement = judge_deflection(bent, load, full.position, 3. * unresolved);
    const auto closer       = [&](const char *what, const Series &with, const Series &without)
    {
      const double ratio = *with.levels.back().error / *without.levels.back().error;
      result.verdicts.push_back(judged("closer-when-bent", {{"what", what}},
                                       ratio < 1. ? Outcome::pass : Outcome::fail, ratio));
    };
    closer("deflection", full.position, methods.front().position);
    closer("normal", full.normal, methods.front().normal);
  }
  else if (result.unfinished.empty())
  {
    result.unfinished            = "no terms of edges; " + bent.known.why_not;
    result.outcome_of_unfinished = Outcome::inconclusive;
  }
  for (MethodSeries &method : methods)
  {
    if (method.position.judgement)
      result.add(method.position, "bending-order.edges");
    else
      result.add(method.position);
    result.add(method.normal);
  }
  return result;
}
} // namespace

std::vector<ConvergenceCase> bending_cases(const UnitCell &cell, const ConvergenceSizes &sizes)
{
  const auto bent = std::make_shared<std::unique_ptr<BendingCell>>(); // made by the first case
  std::vector<ConvergenceCase> cases;
  for (const BendingLoad &load : bending_loads)
    cases.push_back({cell.name, "bending", load.name,
                     [&cell, bent, load, ns = sizes.cells_of_bending]()
                     {
                       if (!*bent)
                         *bent = std::make_unique<BendingCell>(cell);
                       return bend(**bent, load, ns);
                     }});
  return cases;
}
} // namespace homespun::verification
