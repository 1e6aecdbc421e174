// SPDX-License-Identifier: MIT
#include "verification/cell/cell_bracket.h"

#include "homogenization/bracket/bracket_sides.h"
#include "homogenization/bracket/compatible_strain.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/refine.h"
#include "verification/cell/energy_order.h"
#include "verification/cell/moduli_bars.h"
#include "verification/record/claim.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

namespace homespun::verification
{
using homogenization::Bracket;

namespace
{
/// What a bracket takes on one core.
struct Cost
{
  double seconds, bytes;
};

/// Measured with OpenBLAS on squares of P1 with 98,303 and 393,215 stress DoFs: 2.9 s and 14.9 s,
/// 2.3 and 2.4 kB for each, with whole Clough-Tocher triangles. In the limit of fine meshes the
/// exponent is 3/2 (nested dissection).
Cost cost_of_bracket(const double n_dofs)
{
  return {15. * std::pow(n_dofs / 4e5, 1.25), 2400. * n_dofs};
}

/// Memory that is free, or can be freed without swapping [bytes]; infinite where Linux does not
/// say.
double available_memory()
{
  std::ifstream input("/proc/meminfo");
  for (std::string line; std::getline(input, line);)
    if (line.rfind("MemAvailable:", 0) == 0)
      return 1024. * std::atof(line.c_str() + line.find(':') + 1);
  return std::numeric_limits<double>::infinity();
}
} // namespace

homogenization::TorusMesh torus_of(const homogenization::UnitCell &cell, const unsigned refine)
{
  homogenization::TorusMesh torus =
    homogenization::glued(cell.mesh, cell.lattice, cell.curved_sides);
  if (!torus.is_drawn())
    return homogenization::glued(meshes::refined(cell.mesh, static_cast<int>(refine)),
                                 cell.lattice);
  for (unsigned k = 0; k < refine; ++k)
    torus = homogenization::bisected(torus, std::vector<char>(torus.triangles.size(), 1));
  return torus;
}

std::string too_large_text(const homogenization::UnitCell &cell, const BracketOptions &options)
{
  // A periodic mesh has three edges to two triangles, and half as many vertices as triangles: 3
  // DoFs of a vertex, and one of an edge where normal derivatives are quadratic; P2 has 4 per
  // triangle.
  const double per_triangle = options.order == 2 ? 4. : cell.curved_sides.empty() ? 1.5 : 3.;
  const double n_triangles  = cell.mesh.n_triangles() * std::pow(4., options.refine);
  const double n_dofs       = per_triangle * n_triangles;
  const Cost cost           = cost_of_bracket(n_dofs);
  const double free         = available_memory();
  constexpr double giga     = 1e9;
  char text[200];
  if (n_dofs > static_cast<double>(options.max_dofs))
    std::snprintf(text, sizeof(text),
                  "none: it would take %.0f DoFs on this mesh, more than %u, which is about %.2g s "
                  "and %.2g GB: raise --max-dofs, or refine less",
                  n_dofs, options.max_dofs, cost.seconds, cost.bytes / giga);
  else if (cost.bytes > free)
    std::snprintf(text, sizeof(text),
                  "none: it would take %.0f DoFs on this mesh, which is about %.2g GB, and %.2g GB "
                  "of memory are free: refine less",
                  n_dofs, cost.bytes / giga, free / giga);
  else
    return "";
  return text;
}

std::string text_of(const homogenization::AdaptiveEnd ending, const BracketOptions &options)
{
  using homogenization::AdaptiveEnd;
  switch (ending)
  {
  case AdaptiveEnd::tolerance:
    return "the width that was asked for is reached";
  case AdaptiveEnd::max_dofs:
    return "stopped before a mesh of more than " + std::to_string(options.max_dofs) +
           " DoFs: raise --max-dofs";
  case AdaptiveEnd::round_off:
    return "stopped at round-off: a finer mesh does not narrow it";
  case AdaptiveEnd::resolution:
    return "stopped at triangles of 1e-100 of the cell: the singularity is too strong";
  }
  return "";
}

CellBracket bracket_of(const homogenization::UnitCell &cell, const BracketOptions &options,
                       const std::function<void(const std::string &)> &report)
{
  const auto start = std::chrono::steady_clock::now();
  CellBracket result;
  result.remark      = too_large_text(cell, options);
  result.is_left_out = !result.remark.empty();
  if (result.is_left_out)
    return result;
  const auto observe = [&](const Bracket &bracket)
  {
    const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result.history.push_back({bracket.n_triangles, bracket.n_displacement_dofs,
                              bracket.n_stress_dofs, bracket.width, seconds});
    if (!result.on_given_mesh)
      result.on_given_mesh = bracket.stiffness;
    char line[160];
    std::snprintf(line, sizeof(line),
                  "bracket of the %s: %u triangles, %u + %u DoFs, relative width %.2g, %.1f s",
                  name_of_subject(bracket), bracket.n_triangles, bracket.n_displacement_dofs,
                  bracket.n_stress_dofs, bracket.width, seconds);
    report(line);
  };
  try
  {
    const auto stiffness                  = cell.stiffness_of_phase();
    const homogenization::TorusMesh torus = torus_of(cell, options.refine);
    if (torus.is_drawn()) // whose displacements are others than those of the straight triangles
    {
      const homogenization::TorusMesh straight = homogenization::glued(
        meshes::refined(cell.mesh, static_cast<int>(options.refine)), cell.lattice);
      const homogenization::CompatibleStrain its(straight, stiffness, options.order);
      result.on_given_mesh = its.stiffness;
      result.products      = its.products();
    }
    if (options.tolerance)
    {
      homogenization::AdaptiveOptions adaptive;
      adaptive.order     = options.order;
      adaptive.tolerance = *options.tolerance;
      adaptive.max_dofs  = options.max_dofs;
      auto reached       = homogenization::adaptive_bracket(torus, stiffness, adaptive, observe);
      result.bracket     = std::move(reached.bracket);
      result.remark      = text_of(reached.ending, options);
    }
    else
    {
      result.bracket = homogenization::bracket_sides(torus, stiffness, options.order);
      observe(*result.bracket);
      result.remark = "on the mesh of the cell problems";
    }
    if (!torus.is_drawn())
      result.products = result.bracket->strain_products;
  }
  catch (const meshes::BadInput &bad)
  {
    result.remark = std::string("none: ") + bad.what();
  }
  catch (const meshes::NotConverged &failed)
  {
    result.remark = std::string("none: ") + failed.what();
  }
  return result;
}

std::vector<Verdict> checks_of(const CellBracket &bracket, const BracketOptions &options,
                               const Eigen::Matrix3d &stiffness, const double round_off)
{
  std::vector<Verdict> checks;
  if (!bracket.bracket)
  {
    const Words why   = {{"why", bracket.remark}};
    const double none = std::numeric_limits<double>::quiet_NaN();
    if (options.tolerance)
      checks.push_back(judged("bracket.no-tolerance", why, Outcome::fail, none));
    else if (!bracket.is_left_out)
      checks.push_back(judged("bracket.exists", why, Outcome::inconclusive, none));
    return checks;
  }
  const Bracket &found = *bracket.bracket;
  checks.push_back(at_most("bracket.order", {}, order_violation(found.lower, found.upper), 0.));
  // Each of these energies is one that the width speaks of.
  double gap = 0.;
  for (const Eigen::Vector3d &strain :
       {Eigen::Vector3d(1., 0., 0.), Eigen::Vector3d(0., 1., 0.), Eigen::Vector3d(0., 0., 1.),
        Eigen::Vector3d(1., 1., 0.), Eigen::Vector3d(1., -1., 0.)})
    gap = larger(gap, 1. - strain.dot(found.lower * strain) / strain.dot(found.upper * strain));
  checks.push_back(at_most("bracket.widest-load", {}, gap,
                           found.width + 64. * std::numeric_limits<double>::epsilon()));
  if (checks.front().outcome == Outcome::pass)
    checks.push_back(check_of_moduli("C^H", found.stiffness, found.lower, found.upper));
  // Images may lie 1e-7 of the cell apart, which the bracket's mesh mends and the other one does
  // not. That C lies above C_lower follows from both.
  const double difference = energy_difference(*bracket.on_given_mesh, stiffness), most = 1e-6;
  const bool may_be_round_off = difference > most && difference <= round_off;
  std::ostringstream remark;
  if (may_be_round_off)
    remark << ", of which round-off takes up to " << round_off << " at this contrast";
  checks.push_back(judged("bracket.second-code", {{"note", remark.str()}},
                          may_be_round_off     ? Outcome::inconclusive
                          : difference <= most ? Outcome::pass
                                               : Outcome::fail,
                          difference));
  if (options.tolerance)
    checks.push_back(at_most("bracket.tolerance", {}, found.width, *options.tolerance));
  return checks;
}

const char *name_of_subject(const Bracket &bracket)
{
  return bracket.is_of_drawing ? "drawing" : "mesh";
}

Eigen::Matrix3d bars_of(const Bracket &bracket)
{
  const Eigen::Vector3d diagonal =
    (bracket.upper - bracket.lower).diagonal().cwiseMax(0.).cwiseSqrt();
  return diagonal * diagonal.transpose();
}
} // namespace homespun::verification
