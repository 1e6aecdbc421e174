// SPDX-License-Identifier: MIT
#include "verification/strain/level_ellipticity.h"

#include "verification/ellipticity/ellipticity.h"
#include "verification/ellipticity/end_of_path.h"
#include "verification/ellipticity/worst_triangle.h"
#include "verification/record/number_text.h"
#include "verification/strain/validity.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace homespun::verification
{
namespace
{
LevelRow row_of(const StrainLevel &level, const std::string &part, const PhaseEllipticity &found)
{
  return {level.cell, level.load,        name_of(level.law), level.strain,
          part,       found.n_triangles, found.n_lost,       found.least};
}

/// Where a triangle of a sheet is, what pulls or presses it, and how far from elliptic it is.
std::string words_of(const WorstTriangle &worst, const meshes::Sheet &sheet)
{
  Eigen::RowVector2d centre = Eigen::RowVector2d::Zero();
  for (int k = 0; k < 3; ++k)
    centre += sheet.mesh.vertices.row(sheet.mesh.triangles(worst.triangle, k)) / 3.;
  const Eigen::RowVector2d place = sheet.fraction(centre);
  return "at (" + short_text(place(0)) + ", " + short_text(place(1)) +
         ") of the sides of the sheet, " + stress_text(worst);
}

/// How elliptic a resolved sheet is, by groups of phases of one name.
struct Groups
{
  std::vector<std::string> names;
  std::vector<PhaseEllipticity> found;
};

Groups by_group(const meshes::Sheet &sheet, const homogenization::UnitCell &cell, const Law law,
                const meshes::Points &positions)
{
  const std::vector<PhaseEllipticity> of_phase =
    ellipticity_of_phases(sheet.mesh, cell.stiffness_of_phase(), law, positions);
  Groups all;
  for (std::size_t p = 0; p < of_phase.size(); ++p)
  {
    const std::string &name = cell.phases[p].name;
    const auto place        = std::find(all.names.begin(), all.names.end(), name);
    const auto g            = static_cast<std::size_t>(place - all.names.begin());
    if (place == all.names.end())
    {
      all.names.push_back(name);
      all.found.emplace_back();
    }
    all.found[g] = together({all.found[g], of_phase[p]});
  }
  return all;
}

const std::string &phase_of(const WorstTriangle &worst, const meshes::Sheet &sheet,
                            const homogenization::UnitCell &cell)
{
  return cell.phases[static_cast<std::size_t>(sheet.mesh.material(worst.triangle))].name;
}

/// What a note says of a part that is lost.
std::string note_of_loss(const LevelRow &row, const std::string &part, const StrainOutput &output,
                         const std::string &law)
{
  std::vector<LevelRow> its;
  for (const LevelRow &known : output.levels.rows())
    if (known.cell == row.cell && known.load == row.load && known.reference == row.reference &&
        known.part == row.part)
      its.push_back(known);
  return std::to_string(*row.lost) + " of " + std::to_string(*row.triangles) + " triangles of " +
         part + " are not elliptic under " + law + ", the first from a strain of " +
         percent_text(strain_of_loss(its)) + " on: ";
}
} // namespace

void write_ellipticity(const StrainLevel &level, const ResolvedLevel &resolved,
                       const homogenization::UnitCell &cell, StrainOutput &output)
{
  if (level.law == Law::linear)
    return;
  const auto [groups, of_group] =
    by_group(resolved.sheet, cell, level.law, resolved.fine.positions);
  std::string worst_group, worst_words;
  if (std::any_of(of_group.begin(), of_group.end(),
                  [](const PhaseEllipticity &one) { return one.n_lost > 0; }))
  {
    const WorstTriangle worst = worst_triangle(resolved.sheet.mesh, cell.stiffness_of_phase(),
                                               level.law, resolved.fine.positions);
    worst_group               = phase_of(worst, resolved.sheet, cell);
    worst_words               = "; the worst, " + words_of(worst, resolved.sheet);
  }
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    const LevelRow row = row_of(level, groups[g], of_group[g]);
    output.levels.append_if_missing(row);
    if (row.lost > 0)
      output.write_note(level, note_of_loss(row, "phase " + groups[g], output, row.reference) +
                                 "no minimum of the energy need exist, and what is compared is one "
                                 "equilibrium of its mesh" +
                                 (groups[g] == worst_group ? worst_words : ""));
  }
}

namespace
{
std::string note_of_stop(const StrainLevel &level, const StoppedReference &stopped,
                         const std::optional<WorstTriangle> &worst)
{
  const std::string none = "no equilibrium found; " +
                           stopped.step.why.substr(0, stopped.step.why.find("; residual norms"));
  if (!worst)
    return none;
  const std::string phase = phase_of(*worst, stopped.sheet, stopped.cell);
  const std::string its   = words_of(*worst, stopped.sheet);
  if (worst->is_lost)
    return none +
           "; the law ends there, not the solver: at the last equilibrium a triangle of phase " +
           phase + ", " + its + ", is not elliptic under " + name_of(level.law) + " (least wave " +
           short_text(worst->least) + " of that at rest)";
  const std::string all =
    none + "; at the last equilibrium every triangle is elliptic (least wave " +
    short_text(worst->least) + " of that at rest, phase " + phase + ", " + its + ")";
  switch (stopped.at_the_end)
  {
  case Stability::every_triangle:
  case Stability::stable:
    return all + ", and it is a minimum: a limit point beyond it or the solver ends the path";
  case Stability::left:
  case Stability::unstable:
    return all + ", and it is no minimum: the path has passed a limit point or a bifurcation";
  case Stability::unknown:
    break;
  }
  return all + "; whether it is a minimum is not known";
}

/// What ends the path of a small sheet up to the level.
EndOfPath end_of(const StrainLevel &level, const StoppedReference &stopped,
                 const std::vector<double> &path)
{
  constexpr int most_cells = 2; // a sheet that is resolved twice, by a direct solver
  return end_of_path(stopped.cell, Load(level.load), level.law,
                     {path.begin(), std::upper_bound(path.begin(), path.end(), level.strain)},
                     std::min({stopped.sheet.n1, stopped.sheet.n2, most_cells}));
}

/// @param end of the small sheet's path, where the law ends it: on the way there from the last
///   equilibrium of the study ellipticity is lost
void write_ellipticity_of(const StrainLevel &level, const StoppedReference &stopped,
                          const std::optional<EndOfPath> &end, StrainOutput &output)
{
  StrainLevel last = level;
  last.strain      = stopped.step.stopped_at;
  const auto [groups, of_group] =
    by_group(stopped.sheet, stopped.cell, level.law, stopped.step.positions);
  for (std::size_t g = 0; g < groups.size(); ++g)
    output.levels.append_if_missing(row_of(last, groups[g], of_group[g]));
  if (!end || ending_of(*end) != Ending::law || !(end->as_given.farthest > last.strain))
    return;
  const std::string n = std::to_string(end->n_cells), part = "sheet of " + n + " x " + n + " cells";
  output.levels.append_if_missing(row_of(last, part, together(of_group)));
  last.strain = end->as_given.farthest;
  output.levels.append_if_missing(row_of(last, part, *end->as_given.triangles));
}
} // namespace

void write_stop(const StrainLevel &level, const StoppedReference &stopped,
                const std::vector<double> &path, StrainOutput &output)
{
  std::optional<WorstTriangle> worst; // of the last equilibrium, where there is one
  if (level.law != Law::linear && stopped.step.positions.rows() > 0)
    worst = worst_triangle(stopped.sheet.mesh, stopped.cell.stiffness_of_phase(), level.law,
                           stopped.step.positions);
  std::string note = note_of_stop(level, stopped, worst);
  std::optional<EndOfPath> end;
  if (worst && !worst->is_lost && !path.empty() && !Load(level.load).is_periodic())
  {
    end = end_of(level, stopped, path);
    note += "; " + text_of(*end);
  }
  output.write_note(level, note);
  if (worst && stopped.step.stopped_at > 0.)
    write_ellipticity_of(level, stopped, end, output);
}

void write_coarse_ellipticity(const StrainLevel &level, const meshes::TriangleMesh &coarse,
                              const Eigen::Matrix3d &stiffness, const meshes::Points &positions,
                              StrainOutput &output)
{
  if (level.law == Law::linear)
    return;
  const Law law            = homogenized_law(level.law, stiffness);
  meshes::TriangleMesh one = coarse;
  one.material.setZero(one.n_triangles());
  const PhaseEllipticity found = ellipticity_of_phases(one, {stiffness}, law, positions).front();
  const LevelRow row           = row_of(level, coarse_cloth_part, found);
  const std::vector<LevelRow> &all = output.levels.rows();
  const bool is_told               = std::any_of(all.begin(), all.end(),
                                                 [&](const LevelRow &known)
                                                 {
                                     return known.cell == level.cell && known.load == level.load &&
                                            known.part == coarse_cloth_part && known.lost > 0;
                                   });
  output.levels.append_if_missing(row);
  if (row.lost > 0 && !is_told)
    output.write_note(
      level,
      note_of_loss(row, "the coarse cloth", output, "its law, " + name_of(law) + " with C^H") +
        "from there its equilibrium, too, is one of its mesh (said once per load)");
}
} // namespace homespun::verification
