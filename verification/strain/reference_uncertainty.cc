// SPDX-License-Identifier: MIT
#include "verification/strain/reference_uncertainty.h"

#include "verification/reference/fine_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
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
                                           const int n_small, Table<UncertaintyRow> *table,
                                           const MPI_Comm communicator,
                                           const std::function<void(const std::string &)> &tell)
    : cell(cell)
    , load(load)
    , communicator(communicator)
    , side(std::sqrt(cell.lattice.area()))
    , order(order_of_p2(cell, load.is_periodic() ? order_of_p2_smooth : order_of_p2_sheet))
{
  const int n_full     = load.is_periodic() ? 1 : n_cells;
  const int n_measured = load.is_periodic() ? 1 : std::min(n_small, n_cells);
  // Rank 0 keeps the table; whether a row is there is told to all.
  const auto distance =
    [&](const int n, const Law law, const double strain, const bool with_refined)
  {
    UncertaintyRow row = {cell.name, load.name, name_of(law), strain, n};
    double stored[4]   = {0., 0., 0., 0.};
    if (table && table->contains(row))
      for (const UncertaintyRow &known : table->rows())
        // A row without refined P2 does not answer a request with it, unless P1 was not reached.
        if (keys_of_row(known) == keys_of_row(row) &&
            (!with_refined || std::isfinite(known.p1_to_refined) || !std::isfinite(known.p1_to_p2)))
        {
          stored[0] = 1.;
          stored[1] = known.p1_to_p2;
          stored[2] = known.p1_to_refined;
          stored[3] = known.p2_to_refined;
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
    if (measured.reached)
    {
      row.p1_to_p2 = measured.p1_to_p2 * unit;
      if (with_refined)
      {
        row.p1_to_refined = measured.p1_to_refined * unit;
        row.p2_to_refined = measured.p2_to_refined * unit;
        row.bar           = measured.uncertainty(order);
      }
    }
    if (table)
      table->append(row);
    return measured;
  };

  const DiscretizationDistance small = distance(n_measured, Law::linear, small_strain, true);
  const double unknown               = std::numeric_limits<double>::quiet_NaN();
  linear_bar                         = small.reached ? small.uncertainty(order) : unknown;
  if (n_full != n_measured)
  {
    const DiscretizationDistance full = distance(n_full, Law::linear, small_strain, false);
    carry_over = full.reached && small.p1_to_p2 > 0. ? full.p1_to_p2 / small.p1_to_p2 : unknown;
  }
  for (const Law law : laws)
    if (law != Law::linear)
    {
      const DiscretizationDistance large = distance(n_measured, law, large_strain, true);
      large_bars.emplace_back(law, large.reached ? large.uncertainty(order) : linear_bar);
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
