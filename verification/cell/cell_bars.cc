// SPDX-License-Identifier: MIT
#include "verification/cell/cell_bars.h"

#include "homogenization/bracket/loewner.h"
#include "homogenization/lint/facets.h"
#include "verification/cell/energy_order.h"

#include <Eigen/LU>

#include <cstdio>

namespace homespun::verification
{
using homogenization::Homogenization;
using homogenization::UnitCell;

namespace
{
/// How far an entry of a compliance between the inverses of both sides may be from that of C^H
/// [m/N]: with D their difference |S_ij − S^H_ij| <= sqrt(D_ii D_jj).
Eigen::Matrix3d compliance_bars(const homogenization::Bracket &found)
{
  const homogenization::RoundedInverse most  = homogenization::inverse_of(found.lower),
                                       least = homogenization::inverse_of(found.upper);
  const Eigen::Vector3d root =
    (most.value / (1. - most.round_off) - least.value / (1. + least.round_off))
      .diagonal()
      .cwiseMax(0.)
      .cwiseSqrt();
  return root * root.transpose();
}

/// Bars of moduli from those of the compliance S.
homogenization::EngineeringConstants bars_of_moduli(const Eigen::Matrix3d &S,
                                                    const Eigen::Matrix3d &bars)
{
  // 1/S_ii and S_12/S_ii over all S within their bars.
  const auto least = [&](const int i) { return bars(i, i) < S(i, i) ? S(i, i) - bars(i, i) : 0.; };
  const auto of_modulus = [&](const int i) { return bars(i, i) / (S(i, i) * least(i)); };
  const auto of_ratio   = [&](const int i)
  { return (bars(0, 1) + std::abs(S(0, 1) / S(i, i)) * bars(i, i)) / least(i); };
  return {of_modulus(0), of_modulus(1), of_modulus(2), of_ratio(0), of_ratio(1)};
}
} // namespace

std::optional<Eigen::Matrix3d> bars_of_stiffness(const AssessedCell &assessed)
{
  if (!assessed.bracket || !assessed.bracket->bracket)
    return assessed.uncertainty;
  const homogenization::Bracket &found = *assessed.bracket->bracket;
  return Eigen::Matrix3d(bars_of(found) + (assessed.result.stiffness - found.stiffness).cwiseAbs());
}

std::optional<homogenization::EngineeringConstants> bars_of_moduli(const AssessedCell &assessed)
{
  const Eigen::Matrix3d S = assessed.result.stiffness.inverse();
  if (assessed.bracket && assessed.bracket->bracket)
  {
    const homogenization::Bracket &found = *assessed.bracket->bracket;
    return bars_of_moduli(S, compliance_bars(found) + (S - found.stiffness.inverse()).cwiseAbs());
  }
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
  return {middle, 0.5 * bars_of(found), bars_of_moduli(middle.inverse(), compliance_bars(found))};
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
