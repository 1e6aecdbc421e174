// SPDX-License-Identifier: MIT
#include "verification/strain/budget/energy_sides.h"

#include "meshes/plain/errors.h"
#include "verification/record/claim.h"
#include "verification/record/on_root.h"
#include "verification/record/timing.h"
#include "verification/reference/displacement_energy.h"
#include "verification/reference/equilibrated_sheet.h"
#include "verification/reference/fine_reference.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
namespace
{
constexpr double strain        = 0.01; // any: the law is linear
constexpr const char *energies = "energies";

CrossCheckRow row_of(const homogenization::UnitCell &cell, const Load &load)
{
  return {cell.name, load.name, strain, name_of(Law::linear), energies};
}

ReferenceStep linear_reference(const meshes::Sheet &sheet,
                               const std::vector<Eigen::Matrix3d> &stiffness_of_phase,
                               const Load &load, const unsigned int order,
                               const MPI_Comm communicator)
{
  ReferenceOptions options;
  options.order = order;
  FineReference reference(sheet, stiffness_of_phase, options, communicator);
  reference.start(load, Law::linear);
  return reference.advance(strain);
}

void add_fault(CrossCheckRow &row, const std::string &what, const std::string &why)
{
  row.fault +=
    (row.fault.empty() ? "" : "; ") + what + ": " + why.substr(0, why.find("; residual norms"));
}

void measure_stresses(const meshes::Sheet &sheet,
                      const std::vector<Eigen::Matrix3d> &stiffness_of_phase, const Load &load,
                      CrossCheckRow &row)
{
  row.seconds_lower = seconds_of(
    [&]()
    {
      try
      {
        const EquilibratedSheet stress(sheet, stiffness_of_phase, load, strain);
        row.lower = stress.energy;
        row.round_off += stress.round_off;
        row.bar = std::sqrt(std::max(0., row.upper - row.lower + row.round_off) / row.upper);
      }
      catch (const meshes::NotConverged &failure)
      {
        row.round_off = CrossCheckRow::none;
        add_fault(row, "stresses", failure.what());
      }
    });
}
} // namespace

CrossCheckRow energy_sides(const homogenization::UnitCell &cell, const Load &load,
                           const int n_cells, const MPI_Comm communicator)
{
  CrossCheckRow row = row_of(cell, load);
  row.cells         = n_cells;
  row.seconds       = seconds_of(
    [&]()
    {
      const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n_cells, n_cells);
      const auto stiffness      = cell.stiffness_of_phase();
      const ReferenceStep p1    = linear_reference(sheet, stiffness, load, 1, communicator),
                          p2    = linear_reference(sheet, stiffness, load, 2, communicator);
      on_root(communicator,
                    [&]()
                    {
                if (!p1.reached)
                {
                  add_fault(row, "P1", p1.why);
                  return;
                }
                const DisplacementEnergy upper =
                  displacement_energy(sheet, stiffness, load, strain, p1.positions);
                row.upper          = upper.energy;
                row.round_off      = upper.round_off;
                row.misfit         = std::abs(upper.energy - upper.affine_work);
                row.largest_misfit = upper.largest_misfit(p1.relative_residual);
                if (!p2.reached)
                  add_fault(row, "P2", p2.why);
                else
                {
                  row.p2       = p2.energy;
                  row.p1_to_p2 = std::sqrt(std::max(0., row.upper - row.p2) / row.upper);
                }
                measure_stresses(sheet, stiffness, load, row);
              });
    });
  return row;
}

void measure_energies(const homogenization::UnitCell &cell, const Load &load, const int n_cells,
                      Table<CrossCheckRow> *const table, const MPI_Comm communicator)
{
  constexpr int most_cells = 4;
  int is_missing           = table != nullptr && !table->contains(row_of(cell, load));
  MPI_Bcast(&is_missing, 1, MPI_INT, 0, communicator);
  if (!is_missing)
    return;
  const CrossCheckRow row = energy_sides(cell, load, std::min(n_cells, most_cells), communicator);
  on_root(communicator, [&]() { table->append(row); });
}

std::vector<Verdict> energy_verdicts(const std::vector<CrossCheckRow> &rows)
{
  std::vector<Verdict> verdicts;
  for (const CrossCheckRow &row : rows)
  {
    if (row.what != energies)
      continue;
    const std::string why = row.fault.empty() ? "" : "; " + row.fault;
    /// Figure and limit relative to the energy.
    const auto judge = [&](const char *claim, const double figure, const double limit)
    {
      const double value = figure / row.upper, most = limit / row.upper;
      verdicts.push_back(at_most(
        claim, {{"cell", row.cell}, {"load", row.load}, {"cells", *row.cells}, {"note", why}},
        value, most));
      if (!std::isfinite(value) || !std::isfinite(most))
        verdicts.back().outcome = Outcome::inconclusive;
    };
    judge("energy-above-stress", row.lower - row.upper, row.round_off);
    judge("energy-of-p2", larger(row.lower - row.p2, row.p2 - row.upper),
          row.round_off + row.largest_misfit);
    judge("energy-is-work", row.misfit, row.largest_misfit);
  }
  return verdicts;
}
} // namespace homespun::verification
