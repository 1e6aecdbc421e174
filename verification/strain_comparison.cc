// SPDX-License-Identifier: MIT
#include "verification/strain_comparison.h"

#include "meshes/errors.h"
#include "verification/sheet_fields.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
bool has_biot(const StrainStudyOptions &options)
{
  return std::find(options.references.begin(), options.references.end(), "biot") !=
         options.references.end();
}

double pictured_strain(const StrainStudyOptions &options)
{
  return *std::min_element(options.strains.begin(), options.strains.end(),
                           [](double a, double b)
                           { return std::abs(std::log(a / 0.1)) < std::abs(std::log(b / 0.1)); });
}

namespace
{
/// One picture per sheet load, against biot if it is there.
bool is_pictured(const StrainStudyOptions &options, const Load &load, const StrainLevel &level)
{
  return !load.is_periodic() && level.strain == pictured_strain(options) &&
         (has_biot(options) ? level.law == Law::biot
                            : name_of(level.law) == options.references.front());
}
} // namespace

UpsampledLevel compare_methods(const StrainStudyOptions &options, const StrainLevel &level,
                               const ResolvedLevel &resolved, LightweightCloth &cloth,
                               const Load &load, StrainOutput &output)
{
  const ReferenceStep &fine = resolved.fine;
  const CoarseStep coarse   = cloth.solve(level.law, level.strain);
  const auto upsampled_with = [&](const std::string &name)
  {
    UpsampledSheet upsampled = cloth.upsample(Method(name), level.law, coarse.positions);
    if (!upsampled.positions.allFinite())
      throw meshes::NotConverged(
        level.cell + ", " + level.load + ", " + name + ": positions that are not finite", {});
    return upsampled;
  };
  const auto distance_of = [&](const meshes::Points &positions)
  { return (positions - fine.positions).rowwise().norm(); };
  const UpsampledSheet affine = upsampled_with("affine"), localized = upsampled_with("localized");
  StrainErrors errors;
  errors.fluctuation       = distance_of(affine.positions).mean();
  errors.side              = std::sqrt(resolved.sheet.lattice.area());
  errors.uncertainty       = resolved.uncertainty;
  errors.seconds_reference = fine.seconds;
  // All methods before the first row: a level has the errors of all, or is unreached.
  std::vector<std::pair<std::string, UpsampledSheet>> missing;
  for (const std::string &name : options.methods)
    if (Method(name).has_meaning(level.law) && !output.has_errors(level, name))
      missing.emplace_back(name, name == "affine"      ? affine
                                 : name == "localized" ? localized
                                                       : upsampled_with(name));
  for (const auto &[name, upsampled] : missing)
  {
    errors.distance = distance_of(upsampled.positions);
    errors.seconds  = coarse.seconds + upsampled.seconds;
    // The row comes last: where it is there, so is all that belongs to it.
    if (name == "localized")
    {
      if (is_pictured(options, load, level))
        write_sheet_fields(options.output + "/" + level.cell + "/fields-" + load.name + ".h5",
                           resolved.sheet, cloth.coarse,
                           {load.name, level.strain, name_of(level.law), name, fine.positions,
                            upsampled.positions, coarse.positions});
      output.write_step(level, {coarse.seconds, upsampled.seconds, fine.seconds, coarse.iterations,
                                fine.n_newton, resolved.n_dofs, resolved.n_ranks});
    }
    output.write_errors(level, name, resolved.sheet, cloth.coarse.n_triangles(), errors);
  }
  return {coarse.positions, localized.positions};
}
} // namespace homespun::verification
