// SPDX-License-Identifier: MIT
#include "verification/bend/wrinkles.h"

#include "homogenization/bracket/plate_waves.h"
#include "verification/cell/discretization_distance.h"

#include <cmath>

namespace homespun::verification
{
using homogenization::PlateWaves;
using homogenization::WrinkleOnset;

namespace
{
/// The least compression by the parabola through three wavenumbers, 2 % apart: the same on two
/// meshes, so that their distance is one of meshes.
WrinkleOnset parabola(const PlateWaves &waves, const Eigen::Vector2d &direction,
                      const WrinkleOnset &near, const double foundation)
{
  const double step = 0.02 * near.wavenumber;
  const auto at     = [&](const double wavenumber)
  { return waves.compression(wavenumber * direction, foundation); };
  const double left = at(near.wavenumber - step), middle = at(near.wavenumber),
               right = at(near.wavenumber + step), bend = left - 2. * middle + right;
  return {near.wavenumber + 0.5 * step * (left - right) / bend,
          middle - (left - right) * (left - right) / (8. * bend)};
}
} // namespace

std::vector<WrinkleRow> wrinkles(const CellTwice &cell, const std::vector<int> &cells_per_wave)
{
  const homogenization::UnitCell &unit = cell.drawn.cell;
  // A foundation holds the material and no holes.
  const double covered = meshes::signed_areas(unit.mesh).sum() / unit.lattice.area();
  std::vector<WrinkleRow> rows;
  for (int axis = 0; axis < 2; ++axis)
  {
    const double side       = unit.lattice.vectors.row(axis).norm();
    const Eigen::Vector2d n = unit.lattice.vectors.row(axis).transpose() / side;
    const auto waves        = [&](const BendingCell &on_mesh)
    {
      return PlateWaves(
        on_mesh.torus, on_mesh.bending_stiffness_of_phase,
        homogenization::stress_of_compression(on_mesh.torus, unit.stiffness_of_phase(), n));
    };
    const PlateWaves drawn = waves(cell.drawn), finer = waves(cell.finer);
    const auto bends = [&](const BendingCell &on_mesh)
    {
      const Eigen::Vector3d kappa(n(0) * n(0), n(1) * n(1), 2. * n(0) * n(1));
      return kappa.dot(on_mesh.solved.stiffness * kappa);
    };
    for (const int n_cells : cells_per_wave)
    {
      WrinkleRow row;
      row.cell                    = unit.name;
      row.axis                    = axis + 1;
      row.cells_per_wave          = n_cells;
      const double wavenumber     = 2. * std::acos(-1.) / (n_cells * side);
      row.foundation              = bends(cell.drawn) * std::pow(wavenumber, 4);
      row.homogenized_wavelength  = n_cells * side;
      row.homogenized_compression = 2. * std::sqrt(row.foundation * bends(cell.drawn));
      const double foundation     = row.foundation / covered;
      const WrinkleOnset onset    = drawn.onset(n, wavenumber, foundation),
                         here     = parabola(drawn, n, onset, foundation),
                         there    = parabola(finer, n, onset, foundation);
      const auto length           = [](const WrinkleOnset &one)
      { return 2. * std::acos(-1.) / one.wavenumber; };
      row.wavelength      = length(onset);
      row.compression     = onset.compression;
      row.wavelength_bar  = safety_unconfirmed * std::abs(length(here) - length(there));
      row.compression_bar = safety_unconfirmed * std::abs(here.compression - there.compression);
      rows.push_back(row);
    }
  }
  return rows;
}
} // namespace homespun::verification
