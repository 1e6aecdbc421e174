// SPDX-License-Identifier: MIT
#include "verification/cell/cell_bars.h"

#include "homogenization/bracket/loewner.h"
#include "homogenization/lint/facets.h"
#include "verification/cell/energy_order.h"
#include "verification/cell/moduli_bars.h"

#include <Eigen/LU>

#include <cstdio>

namespace homespun::verification
{
using homogenization::Homogenization;
using homogenization::UnitCell;

std::optional<Eigen::Matrix3d> bars_of_stiffness(const AssessedCell &assessed)
{
  if (!assessed.bracket || !assessed.bracket->bracket)
    return assessed.uncertainty;
  const homogenization::Bracket &found = *assessed.bracket->bracket;
  return Eigen::Matrix3d(bars_of(found) + (assessed.result.stiffness - found.stiffness).cwiseAbs());
}

std::optional<homogenization::EngineeringConstants> bars_of_moduli(const AssessedCell &assessed)
{
  if (assessed.bracket && assessed.bracket->bracket)
  {
    const homogenization::Bracket &found = *assessed.bracket->bracket;
    const Eigen::Matrix3d S = homogenization::inverse_of(assessed.result.stiffness).value;
    return bars_of_moduli(S, compliance_bars(found.lower, found.upper) +
                               (S - homogenization::inverse_of(found.stiffness).value).cwiseAbs());
  }
  const Eigen::Matrix3d S = assessed.result.stiffness.inverse();
  if (assessed.uncertainty)
    return bars_of_moduli(S, S.cwiseAbs() * *assessed.uncertainty * S.cwiseAbs());
  return std::nullopt;
}

Shown shown(const AssessedCell &assessed)
{
  if (!is_of_drawing(assessed))
    return {assessed.result.stiffness, bars_of_stiffness(assessed), bars_of_moduli(assessed)};
  const homogenization::Bracket &found = *assessed.bracket->bracket;
  const Eigen::Matrix3d middle         = 0.5 * (found.lower + found.upper);
  return {middle, 0.5 * bars_of(found),
          bars_of_moduli(homogenization::inverse_of(middle).value,
                         compliance_bars(found.lower, found.upper))};
}

std::string geometry_text(const UnitCell &cell, const Homogenization &result)
{
  const auto estimate = homogenization::geometry_estimate(cell, result.chi);
  if (!estimate)
    return "";
  char line[400];
  std::snprintf(line, sizeof(line),
                "geometry (an estimate, in no bar): the mesh is faceted; arcs through the "
                "vertices of %d sides would change energies by %.2g. If arcs are meant, mesh with "
                "six-node triangles (Gmsh: Mesh.ElementOrder = 2)\n",
                estimate->n_facets,
                energy_difference(result.stiffness + estimate->change, result.stiffness));
  return line;
}
} // namespace homespun::verification
