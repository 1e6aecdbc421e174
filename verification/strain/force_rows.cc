// SPDX-License-Identifier: MIT
#include "verification/strain/force_rows.h"

#include "meshes/plain/errors.h"

#include <Eigen/LU>

#include <cmath>

namespace homespun::verification
{
namespace
{
ForceRow row_of(const StrainLevel &level, const char *method)
{
  return {level.cell, level.load, level.strain, name_of(level.law), method};
}

void put_stress(const Eigen::Matrix2d &stress, ForceRow &row)
{
  row.stress_11 = stress(0, 0);
  row.stress_22 = stress(1, 1);
  row.stress_12 = stress(0, 1);
  row.stress_21 = stress(1, 0);
}

ForceRow row_of_forces(const StrainLevel &level, const char *method, const Load &load,
                       const Eigen::Matrix2d &sides, const LoadForces &forces)
{
  ForceRow row  = row_of(level, method);
  row.force     = force_along(load, sides, forces);
  row.per_width = force_per_width(load, sides, forces);
  put_stress(forces.stress, row);
  return row;
}

/// How far the clamp that moves has moved from the one that stays, vertices of both in the mean; of
/// an infinite cloth not a number [m].
/// @param rest, positions (n,2) of the resolved vertices or of coarse nodes [m]
double travel_of(const Load &load, const meshes::Sheet &sheet, const meshes::Points &rest,
                 const meshes::Points &positions)
{
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero(); // rows: of the clamp that stays, that moves
  Eigen::Vector2d n   = Eigen::Vector2d::Zero();
  for (const int v : held_vertices(load, sheet, rest))
  {
    const double place = sheet.fraction(rest.row(v))(load.axis());
    const int clamp    = place > 0.5 ? 1 : 0;
    if (std::abs(place - clamp) > 2. * meshes::image_tolerance / std::min(sheet.n1, sheet.n2))
      continue; // beside the clamp, and held all the same
    sum.row(clamp) += positions.row(v) - rest.row(v);
    n(clamp) += 1.;
  }
  return (sum.row(1) / n(1) - sum.row(0) / n(0)).norm();
}

ForceRow affine_row(const StrainLevel &level, const MethodsOnSheet &methods,
                    const CoarseModel &model, const CoarseState &coarse)
{
  ForceRow row = row_of(level, "affine");
  const localization::Upsampler<2, double> interpolated(
    methods.cell.cell, model.mesh(), methods.sheet, Method("affine").options(level.law));
  // Of the resolved sheet where the coarse motion, interpolated, puts it.
  const auto energy_at = [&](const CoarseState &state)
  {
    localization::Upsampler<2, double>::Fine fine;
    interpolated.upsample(state.positions, fine);
    return sheet_energy(methods.sheet, methods.resolved.stiffness_of_phase(), level.law, fine);
  };
  const auto slope = [&]() // dE/d(strain) [J]
  {
    if (level.law == Law::linear)
      return 2. * energy_at(coarse).energy / level.strain;
    constexpr double part = 1e-3;
    const double ahead = (1. + part) * level.strain, behind = (1. - part) * level.strain;
    return (energy_at(model.solve(ahead, &coarse)).energy -
            energy_at(model.solve(behind, &coarse)).energy) /
           (ahead - behind);
  };
  const Load &load             = methods.load;
  const Eigen::Matrix2d sides  = methods.sheet.sides();
  const Eigen::Matrix2d stress = energy_at(coarse).stress;
  put_stress(stress, row);
  if (load.has_free_sides())
  {
    // The free strains of the motion do work too: no stress alone is the derivative of the energy.
    row.per_width = slope() / std::abs(sides.determinant());
    return row;
  }
  if (load.is_periodic())
  {
    // The motion is given: its slope is that of the macro strain alone.
    LoadForces forces;
    forces.stress = stress;
    row.per_width = force_per_width(load, sides, forces);
    return row;
  }
  try
  {
    const double width = sides.row(1 - load.axis()).norm();
    row.force          = slope() / load.displacement({1., 1.}, sides, 1.).norm();
    row.per_width      = row.force / width;
  }
  catch (const meshes::NotConverged &)
  {
    row.force = row.per_width = ForceRow::none;
  }
  return row;
}
} // namespace

std::vector<ForceRow> force_rows(const StrainLevel &level, const ResolvedLevel &resolved,
                                 const MethodsOnSheet &methods, const CoarseModel &model,
                                 const CoarseState &coarse)
{
  const Load &load            = methods.load;
  const Eigen::Matrix2d sides = resolved.sheet.sides();
  std::vector<ForceRow> rows = {row_of_forces(level, "resolved", load, sides, resolved.fine.forces),
                                row_of_forces(level, "coarse", load, sides, model.forces(coarse)),
                                affine_row(level, methods, model, coarse)};
  rows[0].travel =
    travel_of(load, resolved.sheet, resolved.sheet.mesh.vertices, resolved.fine.positions);
  rows[1].travel = rows[2].travel =
    travel_of(load, resolved.sheet, model.mesh().vertices, coarse.positions);
  const double bar = resolved.bar.force * std::abs(rows.front().per_width);
  for (ForceRow &row : rows)
    row.bar = bar;
  return rows;
}
} // namespace homespun::verification
