// SPDX-License-Identifier: MIT
#include "verification/strain/claims/cubic_verdicts.h"

#include "verification/cell/discretization_distance.h"
#include "verification/law/laws.h"
#include "verification/record/claim.h"
#include "verification/strain/claims/force_verdicts.h"
#include "verification/strain/strain_comparison.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
namespace
{
/// The stress beyond that of C^H over strain squared; not a number where it was not reached.
double beyond_linear(const std::vector<ForceRow> &rows, ForceRow level)
{
  level.method          = "resolved";
  const double resolved = per_width_of(rows, level);
  level.method          = "coarse";
  return (resolved - per_width_of(rows, level)) / (level.strain * level.strain);
}
} // namespace

bool has_cubic_claim(const StrainStudyOptions &options, const Load &load, const Law law)
{
  const std::vector<Law> laws = laws_of_second_order(options);
  return load.is_periodic() && !load.has_free_sides() && !small_strains(options.strains).empty() &&
         std::find(laws.begin(), laws.end(), law) != laws.end();
}

std::vector<Verdict> cubic_verdicts(const std::vector<ForceRow> &rows,
                                    const std::vector<LevelRow> &levels,
                                    const StrainStudyOptions &options,
                                    const homogenization::UnitCell &cell,
                                    const meshes::HomogenizedCell &homogenized)
{
  constexpr double smallness        = 0.1;
  const std::vector<double> strains = small_strains(options.strains);
  std::vector<Verdict> verdicts;
  for (const std::string &name : options.loads)
    for (const std::string &reference : options.references)
    {
      const Load load(name);
      const Law law = law_of(reference);
      if (!has_cubic_claim(options, load, law))
        continue;
      const Eigen::Matrix2d F = load.gradient(1.);
      const Eigen::Vector3d unit(F(0, 0) - 1., F(1, 1) - 1., F(0, 1) + F(1, 0));
      const double scale  = unit.dot(homogenized.stiffness * unit),
                   first  = beyond_linear(rows, {cell.name, name, strains[0], reference}),
                   second = beyond_linear(rows, {cell.name, name, strains[1], reference}),
                   slope  = (second - first) / (strains[1] - strains[0]),
                   limit  = safety_unconfirmed * std::abs(slope * strains[0]) / scale +
                           left_in_stress(cell) / strains[0],
                   off = first - 3. * homogenized.second_order.at(reference).energy.value(unit);
      Verdict verdict =
        at_most("cubic-energy", {{"cell", cell.name}, {"load", name}, {"reference", reference}},
                std::abs(off) / scale, limit);
      if (!(limit <= smallness) ||
          !is_sound_up_to(levels, {cell.name, name, strains[1], reference}))
        verdict.outcome = Outcome::inconclusive;
      verdicts.push_back(verdict);
    }
  return verdicts;
}
} // namespace homespun::verification
