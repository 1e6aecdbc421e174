// SPDX-License-Identifier: MIT
#include "verification/strain/level_ellipticity.h"

#include "verification/laws/ellipticity.h"
#include "verification/record/number_text.h"
#include "verification/strain/ellipticity_rows.h"

#include <algorithm>

namespace homespun::verification
{
namespace
{
/// The rows of a part under one reference.
std::vector<EllipticityRow> rows_of(const std::vector<EllipticityRow> &all, const StrainLevel &of,
                                    const std::string &part)
{
  std::vector<EllipticityRow> rows;
  for (const EllipticityRow &row : all)
    if (row.cell == of.cell && row.load == of.load && row.reference == name_of(of.law) &&
        row.part == part)
      rows.push_back(row);
  return rows;
}

EllipticityRow row_of(const StrainLevel &level, const std::string &part,
                      const PhaseEllipticity &found)
{
  EllipticityRow row;
  row.cell      = level.cell;
  row.load      = level.load;
  row.reference = name_of(level.law);
  row.strain    = level.strain;
  row.part      = part;
  row.triangles = found.n_triangles;
  row.lost      = found.n_lost;
  row.least     = found.least;
  return row;
}

std::string lost_of_all(const EllipticityRow &row)
{
  return std::to_string(row.lost) + " of " + std::to_string(row.triangles) + " triangles";
}
} // namespace

void write_ellipticity(const StrainLevel &level, const ResolvedLevel &resolved,
                       const std::vector<Eigen::Matrix3d> &stiffness_of_phase,
                       const std::vector<std::string> &phases, StrainOutput &output)
{
  if (level.law == Law::linear)
    return;
  const std::vector<PhaseEllipticity> found = ellipticity_of_phases(
    resolved.sheet.mesh, stiffness_of_phase, level.law, resolved.fine.positions);
  std::vector<std::string> groups;
  std::vector<PhaseEllipticity> of_group;
  for (std::size_t p = 0; p < found.size(); ++p)
  {
    const auto place = std::find(groups.begin(), groups.end(), phases[p]);
    const auto g     = static_cast<std::size_t>(place - groups.begin());
    if (place == groups.end())
    {
      groups.push_back(phases[p]);
      of_group.emplace_back();
    }
    of_group[g].n_triangles += found[p].n_triangles;
    of_group[g].n_lost += found[p].n_lost;
    of_group[g].least = std::min(of_group[g].least, found[p].least);
  }
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    const EllipticityRow row = row_of(level, groups[g], of_group[g]);
    output.ellipticity.append_if_missing(row);
    if (row.lost > 0)
      output.write_note(
        level,
        lost_of_all(row) + " of phase " + groups[g] + " are not elliptic under " + row.reference +
          ", the first from a strain of " +
          percent_text(strain_of_loss(rows_of(output.ellipticity.rows(), level, groups[g]))) +
          " on: no minimum of the energy need exist, and what is compared is one "
          "equilibrium of its mesh");
  }
}

void write_coarse_ellipticity(const StrainLevel &level, const MethodOnSheet &method,
                              const meshes::Points &positions, StrainOutput &output)
{
  if (level.law == Law::linear)
    return;
  const Law law            = homogenized_law(level.law, method.cell.stiffness);
  meshes::TriangleMesh one = method.cloth.coarse;
  one.material.setZero(one.n_triangles());
  const EllipticityRow row =
    row_of(level, coarse_cloth_part,
           ellipticity_of_phases(one, {method.cell.stiffness}, law, positions).front());
  const std::vector<EllipticityRow> &all = output.ellipticity.rows();
  const bool is_told                     = std::any_of(all.begin(), all.end(),
                                                       [&](const EllipticityRow &known)
                                                       {
                                     return known.cell == level.cell && known.load == level.load &&
                                            known.part == coarse_cloth_part && known.lost > 0;
                                   });
  output.ellipticity.append_if_missing(row);
  if (row.lost > 0 && !is_told)
    output.write_note(
      level, lost_of_all(row) + " of the coarse cloth are not elliptic under its law, " +
               name_of(law) + " with C^H, the first from a strain of " +
               percent_text(strain_of_loss(rows_of(all, level, coarse_cloth_part))) +
               " on: from there its equilibrium, too, is one of its mesh (said once per load)");
}
} // namespace homespun::verification
