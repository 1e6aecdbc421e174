// SPDX-License-Identifier: MIT
#include "verification/reference_uncertainty.h"

#include "verification/fine_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
const std::vector<std::string> &uncertainty_columns()
{
  static const std::vector<std::string> columns = {"cell",
                                                   "load",
                                                   "reference",
                                                   "strain",
                                                   "cells",
                                                   "p1_minus_p2_m",
                                                   "p1_minus_refined_p2_m",
                                                   "p2_minus_refined_p2_m",
                                                   "uncertainty_per_strain_and_side"};
  return columns;
}

namespace
{
double mean_distance(const meshes::Points &a, const meshes::Points &b)
{
  return (a - b).rowwise().norm().mean();
}
} // namespace

DiscretizationDistance ReferenceUncertainty::measure(const int n, const Law law,
                                                     const double strain, const bool with_refined)
{
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n, n);
  std::vector<meshes::Points> positions;
  const std::vector<ReferenceOptions> ladder = {{1, 0}, {2, 0}, {2, 1}};
  for (std::size_t k = 0; k < (with_refined ? 3u : 2u); ++k)
  {
    FineReference reference(sheet, cell.stiffness_of_phase(), ladder[k], communicator);
    reference.start(load, law);
    const ReferenceStep step = reference.advance(strain);
    if (!step.reached)
      return {};
    positions.push_back(step.positions);
  }
  const double unit = strain * side;
  DiscretizationDistance distance;
  distance.reached  = true;
  distance.p1_to_p2 = mean_distance(positions[0], positions[1]) / unit;
  if (with_refined)
  {
    distance.p1_to_refined = mean_distance(positions[0], positions[2]) / unit;
    distance.p2_to_refined = mean_distance(positions[1], positions[2]) / unit;
  }
  return distance;
}

ReferenceUncertainty::ReferenceUncertainty(const homogenization::UnitCell &cell, const Load &load,
                                           const std::vector<Law> &laws, const int n_cells,
                                           const int n_small, ResultTable *table,
                                           const MPI_Comm communicator,
                                           const std::function<void(const std::string &)> &tell)
    : cell(cell)
    , load(load)
    , communicator(communicator)
    , side(std::sqrt(cell.lattice.area()))
{
  const int n_full     = load.is_periodic() ? 1 : n_cells;
  const int n_measured = load.is_periodic() ? 1 : std::min(n_small, n_cells);
  // Rank 0 keeps the table; whether a row is there is told to all.
  const auto distance =
    [&](const int n, const Law law, const double strain, const bool with_refined)
  {
    const std::vector<std::string> keys = {cell.name, load.name, name_of(law), csv_number(strain),
                                           std::to_string(n)};
    double stored[4]                    = {0., 0., 0., 0.};
    if (table)
      for (const std::vector<std::string> &row : table->rows())
        // A row without refined P2 does not answer a request with it, unless P1 was not reached.
        if (std::equal(keys.begin(), keys.end(), row.begin()) &&
            (!with_refined || !row[6].empty() || row[5].empty()))
        {
          stored[0] = 1.;
          for (std::size_t k = 0; k < 3; ++k)
            stored[k + 1] = csv_value(row[5 + k]);
        }
    MPI_Bcast(stored, 4, MPI_DOUBLE, 0, communicator);
    const double unit = strain * side;
    if (stored[0] > 0.)
    {
      DiscretizationDistance known;
      known.reached       = std::isfinite(stored[1]);
      known.p1_to_p2      = stored[1] / unit;
      known.p1_to_refined = stored[2] / unit;
      known.p2_to_refined = stored[3] / unit;
      return known;
    }
    tell("error bar of " + name_of(law) + ", " + std::to_string(n) + " x " + std::to_string(n) +
         " cells: P1, P2" + (with_refined ? ", refined P2" : ""));
    const DiscretizationDistance measured = measure(n, law, strain, with_refined);
    const double missing                  = std::numeric_limits<double>::quiet_NaN();
    if (table)
      table->append(
        {keys[0], keys[1], keys[2], keys[3], keys[4],
         csv_number(measured.reached ? measured.p1_to_p2 * unit : missing),
         csv_number(measured.reached && with_refined ? measured.p1_to_refined * unit : missing),
         csv_number(measured.reached && with_refined ? measured.p2_to_refined * unit : missing),
         csv_number(measured.reached && with_refined ? measured.uncertainty() : missing)});
    return measured;
  };

  const DiscretizationDistance small = distance(n_measured, Law::linear, small_strain, true);
  const double unknown               = std::numeric_limits<double>::quiet_NaN();
  linear_bar                         = small.reached ? small.uncertainty() : unknown;
  if (n_full != n_measured)
  {
    const DiscretizationDistance full = distance(n_full, Law::linear, small_strain, false);
    carry_over = full.reached && small.p1_to_p2 > 0. ? full.p1_to_p2 / small.p1_to_p2 : unknown;
  }
  for (const Law law : laws)
    if (law != Law::linear)
    {
      const DiscretizationDistance large = distance(n_measured, law, large_strain, true);
      large_bars.emplace_back(law, large.reached ? large.uncertainty() : linear_bar);
    }
}

double ReferenceUncertainty::at(const Law law, const double strain) const
{
  double bar = linear_bar;
  for (const auto &[its_law, large_bar] : large_bars)
    if (its_law == law)
      bar = std::max(linear_bar + (large_bar - linear_bar) * strain / large_strain,
                     0.5 * std::min(linear_bar, large_bar));
  return bar * carry_over * strain * side;
}
} // namespace homespun::verification
