// SPDX-License-Identifier: MIT
#include "verification/bloch/pattern_rows.h"

#include "meshes/plain/errors.h"
#include "verification/bloch/supercell.h"

#include <cmath>

namespace homespun::verification
{
namespace
{
PatternRow pattern_row(const MeshOfCell &mesh, const StrainPath &path, const CellEquilibrium &state,
                       const Eigen::Vector2i &n)
{
  PatternRow row;
  row.cells_1 = n(0);
  row.cells_2 = n(1);
  row.outcome = "not-found";
  try
  {
    const Supercell supercell(mesh.cell, n);
    const CellAssembly all(supercell.cell, mesh.phases, mesh.law);
    const auto found = followed_pattern(mesh.bloch, supercell, all, state, path.dead_loads());
    if (!found)
    {
      row.outcome = "no-wave";
      return row;
    }
    row.outcome         = found->lower() > 0. ? "found" : "not-found";
    row.wave            = found->wave.wave.text();
    row.beta            = found->wave.beta;
    row.energy_periodic = found->periodic.energy;
    row.energy          = found->state.energy;
    row.lower           = found->lower();
    row.largest =
      (found->state.fluctuation - found->periodic.fluctuation).rowwise().norm().maxCoeff() /
      std::sqrt(mesh.cell.lattice.area());
  }
  catch (const meshes::NotConverged &)
  {
  }
  return row;
}
} // namespace

std::vector<PatternRow> patterns_of(const MeshOfCell &mesh, const Load &load,
                                    const std::vector<StabilityRow> &levels,
                                    const std::optional<Eigen::Vector2i> &cells)
{
  std::vector<PatternRow> rows;
  StrainPath path(mesh.assembly, load);
  for (const StabilityRow &level : levels)
  {
    if (level.state != "unstable-proved" || !(cells || level.cells_1 * level.cells_2 > 1))
      continue;
    const Eigen::Vector2i n = cells ? *cells : Eigen::Vector2i(level.cells_1, level.cells_2);
    PatternRow row          = pattern_row(mesh, path, path.at(level.strain), n);
    row.cell                = level.cell;
    row.law                 = level.law;
    row.load                = level.load;
    row.strain              = level.strain;
    rows.push_back(row);
  }
  return rows;
}
} // namespace homespun::verification
