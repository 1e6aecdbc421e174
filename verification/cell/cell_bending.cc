// SPDX-License-Identifier: MIT
#include "verification/cell/cell_bending.h"

#include "meshes/plain/errors.h"
#include "verification/cell/energy_order.h"
#include "verification/cell/moduli_bars.h"
#include "verification/record/claim.h"

#include <Eigen/LU>

#include <chrono>
#include <cstdio>
#include <limits>

namespace homespun::verification
{
using homogenization::BendingBracket;

CellBending bending_of(const homogenization::UnitCell &cell, const BracketOptions &options,
                       const std::function<void(const std::string &)> &report)
{
  const auto start = std::chrono::steady_clock::now();
  CellBending result;
  result.remark      = too_large_text(cell, options);
  result.is_left_out = !result.remark.empty();
  if (result.is_left_out)
    return result;
  const auto observe = [&](const BendingBracket &bracket)
  {
    const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result.history.push_back({bracket.n_triangles, bracket.n_moment_dofs, bracket.n_deflection_dofs,
                              bracket.width, seconds});
    char line[160];
    std::snprintf(line, sizeof(line),
                  "bracket of bending: %u triangles, %u + %u DoFs, relative width %.2g, %.1f s",
                  bracket.n_triangles, bracket.n_moment_dofs, bracket.n_deflection_dofs,
                  bracket.width, seconds);
    report(line);
  };
  try
  {
    const auto stiffness                  = cell.bending_stiffness_of_phase();
    const homogenization::TorusMesh torus = torus_of(cell, options.refine);
    if (options.tolerance)
    {
      homogenization::AdaptiveOptions adaptive;
      adaptive.order     = options.order;
      adaptive.tolerance = *options.tolerance;
      adaptive.max_dofs  = options.max_dofs;
      auto reached = homogenization::adaptive_bending_bracket(torus, stiffness, adaptive, observe);
      result.bracket = std::move(reached.bracket);
      result.remark  = text_of(reached.ending, options);
    }
    else
    {
      result.bracket = homogenization::bending_bracket(torus, stiffness, options.order);
      observe(*result.bracket);
      result.remark = "on the mesh of the cell problems";
    }
  }
  catch (const meshes::BadInput &bad)
  {
    result.remark = std::string("none: ") + bad.what();
  }
  catch (const meshes::NotConverged &failed)
  {
    result.remark = std::string("none: ") + failed.what();
  }
  // A refined mesh has the vertices of the cell in front.
  if (result.bracket)
    result.bracket->deflection.conservativeResize(cell.mesh.n_vertices(), 3);
  return result;
}

KnownRoll roll_of(const homogenization::UnitCell &cell, const BracketOptions &options)
{
  if (const std::string why = too_large_text(cell, options); !why.empty())
    return {std::nullopt, why};
  try
  {
    return {homogenization::rolled_cell(torus_of(cell, options.refine),
                                        cell.bending_stiffness_of_phase(),
                                        cell.stiffness_of_phase()),
            ""};
  }
  catch (const meshes::BadInput &bad)
  {
    return {std::nullopt, bad.what()};
  }
  catch (const meshes::NotConverged &failed)
  {
    return {std::nullopt, failed.what()};
  }
}

std::vector<Verdict> checks_of(const CellBending &bending, const BracketOptions &options)
{
  if (!bending.bracket)
  {
    const Words why   = {{"why", bending.remark}};
    const double none = std::numeric_limits<double>::quiet_NaN();
    if (options.tolerance)
      return {judged("bending-bracket.no-tolerance", why, Outcome::fail, none)};
    if (!bending.is_left_out)
      return {judged("bending-bracket.exists", why, Outcome::inconclusive, none)};
    return {};
  }
  const BendingBracket &found = *bending.bracket;
  std::vector<Verdict> checks = {at_most("bending-bracket.order", {},
                                         larger(order_violation(found.lower, found.stiffness),
                                                order_violation(found.stiffness, found.upper)),
                                         0.)};
  if (checks.front().outcome == Outcome::pass)
    checks.push_back(check_of_moduli("D^H", found.stiffness, found.lower, found.upper));
  if (options.tolerance)
    checks.push_back(at_most("bending-bracket.tolerance", {}, found.width, *options.tolerance));
  return checks;
}

Eigen::Matrix3d bars_of(const BendingBracket &bracket)
{
  const Eigen::Vector3d root = (bracket.upper - bracket.lower).diagonal().cwiseMax(0.).cwiseSqrt();
  return root * root.transpose();
}

homogenization::EngineeringConstants bending_moduli(const BendingBracket &bracket)
{
  return homogenization::engineering_constants(bracket.stiffness);
}

homogenization::EngineeringConstants bars_of_bending_moduli(const BendingBracket &bracket)
{
  return bars_of_moduli(homogenization::inverse_of(bracket.stiffness).value,
                        compliance_bars(bracket.lower, bracket.upper));
}

std::string range_text(const Eigen::Matrix3d &bending_stiffness)
{
  std::string text;
  for (int k = 0; k < 2; ++k)
    if (!(bending_stiffness(k, k) >= softest_cloth && bending_stiffness(k, k) <= stiffest_cloth))
    {
      char line[240];
      std::snprintf(line, sizeof(line),
                    "warning: D%d%d = %.3g N m is outside of cloth, %g to %g N m: is a thickness "
                    "not in metres, or a modulus not in Pa?\n",
                    k + 1, k + 1, bending_stiffness(k, k), softest_cloth, stiffest_cloth);
      text += line;
    }
  return text;
}
} // namespace homespun::verification
