// SPDX-License-Identifier: MIT
// The width of the bracket on C^H against DoFs, on adaptive and on uniform meshes. It is direct
// solvers' work, done on the first rank.
#include "homogenization/bracket/bracket.h"
#include "homogenization/cell/corners.h"
#include "meshes/plain/refine.h"
#include "verification/converge/converge_cases.h"
#include "verification/record/on_root.h"

#include <chrono>
#include <cmath>

namespace homespun::verification
{
using homogenization::Bracket;
using homogenization::UnitCell;

namespace
{
using Clock = std::chrono::steady_clock;

Series width_series(const char *meshes, const unsigned int order)
{
  Series series;
  series.quantity = std::string(meshes) + " meshes: relative width of the bracket [-]";
  series.order    = order;
  series.h_unit   = "1 / sqrt(DoFs)";
  return series;
}

void add_level(Series &series, const Bracket &bracket, const Clock::time_point start)
{
  const double n_dofs = bracket.n_displacement_dofs;
  series.levels.push_back({1. / std::sqrt(n_dofs), bracket.n_displacement_dofs, std::nullopt,
                           bracket.width,
                           std::chrono::duration<double>(Clock::now() - start).count()});
}

/// DoFs of the larger of the two problems: a periodic mesh has three edges to two triangles.
unsigned long dofs_of(const meshes::TriangleMesh &mesh, const unsigned int order)
{
  return static_cast<unsigned long>(mesh.n_triangles()) * (order == 2 ? 4 : 3);
}

/// A laminate's fields are held by both spaces: nothing is left to converge.
Verdict closes_at_once(const UnitCell &cell, const unsigned int order)
{
  const Bracket bracket = homogenization::bracket(homogenization::glued(cell.mesh, cell.lattice),
                                                  cell.stiffness_of_phase(), order);
  // Two round-offs wider than this would hold brackets that are plainly open.
  constexpr double vacuous = 1e-6;
  return judged("adaptive.laminate", {{"order", order}, {"limit", 2. * bracket.round_off}},
                !(bracket.width <= 2. * bracket.round_off) ? Outcome::fail
                : bracket.width <= vacuous                 ? Outcome::pass
                                                           : Outcome::inconclusive,
                bracket.width);
}

/// How far an order in DoFs^-1/2 may be from 2p: as asked for, +- 0.2 in DoFs.
constexpr double adaptive_order_tolerance = 0.4;

/// Adaptive width over the uniform one with at least as many DoFs, at the finest of two uniform
/// meshes or more that allows it.
Verdict is_narrower(const Series &adaptive, const Series &uniform)
{
  Verdict verdict =
    judged("adaptive.narrower", {{"order", adaptive.order}}, Outcome::inconclusive, std::nan(""));
  const ConvergenceLevel &finest = uniform.levels.back();
  for (const ConvergenceLevel &level : adaptive.levels)
    if (level.n_dofs <= finest.n_dofs)
      verdict.value = *level.error / *finest.error; // the last one is the largest such mesh
  // Before the corners show, halving every triangle may be as good: the uniform width then falls
  // with nearly the order of the elements.
  const ConvergenceLevel &before = uniform.levels[uniform.levels.size() - 2];
  const double order_of_uniform =
    2. * std::log(*before.error / *finest.error) /
    std::log(static_cast<double>(finest.n_dofs) / static_cast<double>(before.n_dofs));
  verdict.outcome = verdict.value < 1. ? Outcome::pass
                    : order_of_uniform > 2. * adaptive.order - adaptive_order_tolerance
                      ? Outcome::inconclusive
                      : Outcome::fail;
  if (std::isnan(verdict.value))
    verdict.outcome = Outcome::inconclusive;
  return verdict;
}

void narrow(const UnitCell &cell, const unsigned int order, const ConvergenceSizes &sizes,
            ConvergenceResult &result)
{
  Series adaptive = width_series("adaptive", order), uniform = width_series("uniform", order);
  homogenization::AdaptiveOptions options;
  options.order                      = order;
  options.tolerance                  = 0.;
  options.max_dofs                   = sizes.adaptive_dofs;
  const auto start                   = Clock::now();
  homogenization::AdaptiveEnd ending = homogenization::AdaptiveEnd::round_off;
  result.solves(
    [&]()
    {
      ending = homogenization::adaptive_bracket(
                 cell.mesh, cell.lattice, cell.stiffness_of_phase(), options,
                 [&](const Bracket &bracket) { add_level(adaptive, bracket, start); })
                 .ending;
    });
  meshes::TriangleMesh mesh = cell.mesh;
  while (dofs_of(mesh, order) <= sizes.adaptive_dofs &&
         result.solves(
           [&]()
           {
             const auto begin = Clock::now();
             add_level(uniform,
                       homogenization::bracket(homogenization::glued(mesh, cell.lattice),
                                               cell.stiffness_of_phase(), order),
                       begin);
           }))
    mesh = meshes::refined(mesh, 1);
  // What so few DoFs cannot decide is no claim, but if there is no other.
  const bool is_narrowing = uniform.levels.size() >= 2 && !adaptive.levels.empty(),
             has_order    = adaptive.levels.size() >= fewest_uneven_levels ||
                         ending != homogenization::AdaptiveEnd::max_dofs;
  if (has_order || !is_narrowing)
    adaptive.judgement = judge_uneven_errors(adaptive.sizes(), adaptive.errors(),
                                             about(2. * order, adaptive_order_tolerance));
  if (!has_order && !is_narrowing)
    adaptive.judgement->outcome = Outcome::inconclusive;
  result.add(adaptive, "adaptive.order", {{"order", order}, {"twice", 2 * order}});
  result.add(uniform);
  if (is_narrowing)
    result.verdicts.push_back(is_narrower(adaptive, uniform));
}

ConvergenceResult adapt(const UnitCell &cell, const ConvergenceSizes &sizes,
                        const MPI_Comm communicator)
{
  ConvergenceResult result;
  on_root(
    communicator,
    [&]()
    {
      try
      {
        const bool is_laminate =
          homogenization::corners_of(cell.mesh, cell.lattice, cell.stiffness_of_phase()).empty();
        for (const unsigned int order : {1u, 2u})
          if (is_laminate)
            result.verdicts.push_back(closes_at_once(cell, order));
          else
            narrow(cell, order, sizes, result);
      }
      catch (const meshes::BadInput &bad) // of a cell that the solvers take and brackets do not
      {
        result.verdicts.push_back(
          judged("bracket.exists", {{"why", bad.what()}}, Outcome::inconclusive, std::nan("")));
      }
    });
  return result;
}
} // namespace

std::vector<ConvergenceCase> adaptive_cases(const UnitCell &cell, const ConvergenceSizes &sizes,
                                            const MPI_Comm communicator)
{
  return {{cell.name, "adaptive", "bracket",
           [&cell, sizes, communicator]() { return adapt(cell, sizes, communicator); }}};
}
} // namespace homespun::verification
