// SPDX-License-Identifier: MIT
#include "verification/bend/wrinkles.h"

#include "homogenization/bracket/plate_waves.h"
#include "meshes/plain/errors.h"
#include "verification/cell/discretization_distance.h"

#include <cmath>

namespace homespun::verification
{
using homogenization::PlateWaves;
using homogenization::WrinkleOnset;

namespace
{
/// The least compression by the parabola through three wavenumbers so near to it that what the
/// parabola misses, the square of their distance, is no more than round-off leaves.
WrinkleOnset parabola(const PlateWaves &waves, const Eigen::Vector2d &direction,
                      const WrinkleOnset &near, const double foundation)
{
  const double step = 2e-4 * near.wavenumber;
  const auto value  = [&](const double wavenumber)
  { return waves.compression(wavenumber * direction, foundation); };
  const double left = value(near.wavenumber - step), middle = value(near.wavenumber),
               right = value(near.wavenumber + step), bend = left - 2. * middle + right;
  return {near.wavenumber + 0.5 * step * (left - right) / bend,
          middle - (left - right) * (left - right) / (8. * bend)};
}

/// @param factor of the distance between both meshes, for bars
/// @param row has the wavelength of D^H
void resolve(const PlateWaves &drawn, const PlateWaves &finer, const Eigen::Vector2d &direction,
             const double foundation, const double factor, WrinkleRow &row)
{
  const double turn        = 2. * std::acos(-1.);
  const WrinkleOnset onset = drawn.onset(direction, turn / row.homogenized_wavelength, foundation),
                     here  = parabola(drawn, direction, onset, foundation),
                     there = parabola(finer, direction, onset, foundation);
  row.wavelength           = turn / here.wavenumber;
  row.compression          = here.compression;
  row.wavelength_bar       = factor * std::abs(turn / here.wavenumber - turn / there.wavenumber);
  row.compression_bar      = factor * std::abs(here.compression - there.compression);
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
    const Eigen::Vector3d kappa = homogenization::curvature_across(n);
    const Eigen::Matrix3d mean =
      homogenization::mean_of_materials(cell.drawn.torus, cell.drawn.bending_stiffness_of_phase);
    const double D      = kappa.dot(cell.drawn.solved.stiffness * kappa),
                 mean_D = kappa.dot(mean * kappa);
    for (const int n_cells : cells_per_wave)
    {
      WrinkleRow row;
      row.cell                    = unit.name;
      row.axis                    = axis + 1;
      row.cells_per_wave          = n_cells;
      const double wavenumber     = 2. * std::acos(-1.) / (n_cells * side);
      row.foundation              = D * std::pow(wavenumber, 4);
      row.homogenized_wavelength  = n_cells * side;
      row.homogenized_compression = 2. * std::sqrt(row.foundation * D);
      row.most_compression        = 2. * std::sqrt(row.foundation * mean_D);
      try
      {
        resolve(drawn, finer, n, row.foundation / covered, cell.factor, row);
      }
      catch (const meshes::NotConverged &)
      {
        // The row says that nothing was found.
      }
      rows.push_back(row);
    }
  }
  return rows;
}
} // namespace homespun::verification
