// SPDX-License-Identifier: MIT
#include "verification/strain/claims/force_verdicts.h"

#include "meshes/plain/epsilon.h"
#include "meshes/plain/sheet.h"
#include "verification/cell/algebraic_limit.h"
#include "verification/cell/discretization_distance.h"
#include "verification/law/laws.h"
#include "verification/record/claim.h"
#include "verification/reference/fine_reference.h"
#include "verification/reference/loads.h"
#include "verification/strain/strain_cases.h"
#include "verification/strain/validity.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>

namespace homespun::verification
{
std::vector<double> small_strains(const std::vector<double> &asked)
{
  std::vector<double> two;
  for (const double strain : asked)
    if (two.size() < 2 && strain < 0.0101 && (two.empty() || strain >= 2. * two[0]))
      two.push_back(strain);
  return two.size() == 2 ? two : std::vector<double>();
}

std::vector<Verdict> verdicts_of_forces(const std::vector<ForceRow> &rows)
{
  std::vector<Verdict> verdicts;
  for (const auto &of_case : linear_sheets_of(rows))
  {
    std::map<double, std::pair<double, double>> of_strain; // resolved, affine
    for (const ForceRow &row : rows)
      if (is_of_case(row, of_case))
      {
        if (row.method == "resolved")
          of_strain[row.strain].first = row.per_width;
        if (row.method == "affine")
          of_strain[row.strain].second = row.per_width;
      }
    double worst  = 0.5; // of the ratios the one that is farthest from the middle of 0 and 1
    bool is_known = false;
    for (const auto &[strain, forces] : of_strain)
      if (std::isfinite(forces.first) && std::isfinite(forces.second) && forces.second != 0.)
      {
        const double ratio = forces.first / forces.second;
        if (!is_known || std::abs(ratio - 0.5) > std::abs(worst - 0.5))
          worst = ratio;
        is_known = true;
      }
    if (is_known)
      verdicts.push_back(
        judged("force-of-reference", {{"cell", of_case.cell}, {"load", of_case.load}},
               worst > 0. && worst <= 1. + 10. * solved_to ? Outcome::pass : Outcome::fail, worst));
  }
  return verdicts;
}

double per_width_of(const std::vector<ForceRow> &rows, const ForceRow &of)
{
  const auto found =
    std::find_if(rows.begin(), rows.end(),
                 [&](const ForceRow &row) { return keys_of_row(row) == keys_of_row(of); });
  return found == rows.end() ? ForceRow::none : found->per_width;
}

bool has_claim_on_laws(const StrainStudyOptions &options, const Law law)
{
  const auto &all = options.references;
  return law != Law::linear && std::count(all.begin(), all.end(), name_of(Law::linear)) > 0 &&
         !small_strains(options.strains).empty();
}

bool is_sound_up_to(const std::vector<LevelRow> &levels, const ForceRow &of)
{
  if (of.strain > elliptic_up_to(levels, of.cell, of.load, of.reference))
    return false;
  return std::none_of(levels.begin(), levels.end(),
                      [&](const LevelRow &row)
                      {
                        return is_of_case(row, of) && row.strain <= of.strain &&
                               (row.stability == name_of(Stability::left) ||
                                row.stability == name_of(Stability::unstable));
                      });
}

std::vector<Verdict> verdicts_of_laws(const std::vector<ForceRow> &rows,
                                      const std::vector<LevelRow> &levels,
                                      const StrainStudyOptions &options,
                                      const homogenization::UnitCell &cell,
                                      const Eigen::Matrix3d &stiffness)
{
  constexpr double smallness        = 0.1;
  constexpr double difference       = 1e-5; // of the affine motion's energy, a central one
  const std::vector<double> strains = small_strains(options.strains);
  double anisotropy                 = contrast_of({stiffness});
  for (const Eigen::Matrix3d &C : cell.stiffness_of_phase())
    anisotropy = larger(anisotropy, contrast_of({C}));
  std::vector<Verdict> verdicts;
  for (const std::string &load : options.loads)
    for (const std::string &reference : options.references)
    {
      if (!has_claim_on_laws(options, law_of(reference)))
        continue;
      double worst       = 0.;
      bool all_are_known = true;
      for (const char *method : {"resolved", "coarse", "affine"})
      {
        const auto off = [&](const double strain)
        {
          return per_width_of(rows, {cell.name, load, strain, reference, method}) /
                   per_width_of(rows, {cell.name, load, strain, name_of(Law::linear), method}) -
                 1.;
        };
        const double first = off(strains[0]), second = off(strains[1]),
                     slope = (second - first) / (strains[1] - strains[0]),
                     limit =
                       strains[0] * larger(1., safety_unconfirmed * std::abs(slope)) + difference;
        if (limit <= smallness)
          worst = larger(worst, std::abs(first) / limit);
        else
          all_are_known = false;
      }
      Verdict verdict = at_most(
        "laws-agree", {{"cell", cell.name}, {"load", load}, {"reference", reference}}, worst, 1.);
      // Tension stiffens shear: a strain is small beside the softest direction over the stiffest.
      if ((worst <= 1. && !all_are_known) || !(anisotropy * strains[1] <= 1.) ||
          !is_sound_up_to(levels, {cell.name, load, strains[1], reference}))
        verdict.outcome = Outcome::inconclusive;
      verdicts.push_back(verdict);
    }
  return verdicts;
}

double left_in_stress(const homogenization::UnitCell &cell)
{
  return solved_to *
         std::sqrt(contrast_of(cell.stiffness_of_phase()) * 0.5 * cell.mesh.n_triangles());
}

namespace
{
/// The claim on the worst row of a cell and load, by a number; rows without one decide nothing.
Verdict worst_row(const std::string &id, const Words &of, const std::vector<ForceRow> &rows,
                  const double limit,
                  const std::function<std::optional<double>(const ForceRow &)> &number_of)
{
  double worst = 0.;
  int n_rows   = 0;
  for (const ForceRow &row : rows)
    if (row.cell == of.at("cell") && row.load == of.at("load"))
      if (const std::optional<double> number = number_of(row))
      {
        worst = larger(worst, *number);
        ++n_rows;
      }
  return open_without(n_rows, at_most(id, of, worst, limit));
}
} // namespace

std::vector<Verdict> verdicts_of_moments(const std::vector<ForceRow> &rows,
                                         const StrainStudyOptions &options,
                                         const homogenization::UnitCell &cell)
{
  std::vector<Verdict> verdicts;
  for (const std::string &name : options.loads)
  {
    const Load load(name);
    if (!load.is_periodic() || load.has_free_sides())
      continue;
    const auto moment_of = [&](const ForceRow &row)
    {
      Eigen::Matrix2d moment;
      moment << row.stress_11, row.stress_12, row.stress_21, row.stress_22;
      if (law_of(row.reference) != Law::linear)
        moment *= load.gradient(row.strain).transpose();
      return std::abs(moment(0, 1) - moment(1, 0)) / moment.norm();
    };
    verdicts.push_back(worst_row("no-moment", {{"cell", cell.name}, {"load", name}}, rows,
                                 left_in_stress(cell), moment_of));
  }
  return verdicts;
}

std::vector<Verdict> verdicts_of_travel(const std::vector<ForceRow> &rows,
                                        const StrainStudyOptions &options,
                                        const homogenization::UnitCell &cell)
{
  std::vector<Verdict> verdicts;
  for (const std::string &name : options.loads)
  {
    const Load load(name);
    if (load.is_periodic())
      continue;
    const double apart = options.n_cells * cell.lattice.vectors.row(load.axis()).norm(),
                 rounding =
                   4. * meshes::epsilon * (apart + cell.mesh.vertices.cwiseAbs().maxCoeff());
    const auto off = [&](const ForceRow &row) -> std::optional<double>
    {
      const double expected = row.strain * apart;
      if (row.method == "affine" || rounding >= meshes::image_tolerance * expected)
        return {};
      return std::abs(row.travel / expected - 1.);
    };
    verdicts.push_back(worst_row("clamp-travel", {{"cell", cell.name}, {"load", name}}, rows,
                                 2. * meshes::image_tolerance, off));
  }
  return verdicts;
}
} // namespace homespun::verification
