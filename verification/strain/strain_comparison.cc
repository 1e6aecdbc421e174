// SPDX-License-Identifier: MIT
#include "verification/strain/strain_comparison.h"

#include "meshes/plain/errors.h"
#include "verification/method/anchor_choice.h"
#include "verification/record/number_text.h"
#include "verification/strain/force_rows.h"
#include "verification/strain/level_ellipticity.h"
#include "verification/strain/sheet_fields.h"
#include "verification/strain/yarn_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
bool has_biot(const StrainStudyOptions &options)
{
  return std::find(options.references.begin(), options.references.end(), "biot") !=
         options.references.end();
}

std::vector<homogenization::MembraneLaw> laws_of_second_order(const StrainStudyOptions &options)
{
  std::vector<homogenization::MembraneLaw> laws;
  if (std::any_of(options.methods.begin(), options.methods.end(),
                  [](const std::string &name) { return Method(name).is_of_second_order(); }))
    for (const auto law : {homogenization::MembraneLaw::biot, homogenization::MembraneLaw::green})
      if (std::find(options.references.begin(), options.references.end(), name_of(law)) !=
          options.references.end())
        laws.push_back(law);
  return laws;
}

bool has_edges(const StrainStudyOptions &options)
{
  return std::find(options.methods.begin(), options.methods.end(), "edges") !=
         options.methods.end();
}

MethodOnSheet method_on_sheet(const StrainStudyOptions &options,
                              const homogenization::UnitCell &cell,
                              const meshes::HomogenizedCell &homogenized, const KnownEdges &edges,
                              const meshes::Sheet &sheet, const Load &load)
{
  MethodOnSheet method = {homogenized, LightweightCloth(homogenized, sheet, load),
                          FluctuationMeasure(homogenized.stiffness, sheet, load),
                          cell.stiffness_of_phase()};
  for (const homogenization::Phase &phase : cell.phases)
    method.phases.push_back(phase.name);
  if (!laws_of_second_order(options).empty())
    method.second_order =
      std::make_unique<LightweightCloth>(homogenized, sheet, load, CoarseEnergy::cubic);
  method.why_no_edges = edges.why_not;
  if (edges.edges && !load.is_periodic())
    method.edged =
      std::make_unique<EdgedSheet>(CellWithEdges{homogenized, *edges.edges}, sheet, load);
  return method;
}

double pictured_strain(const StrainStudyOptions &options)
{
  return *std::min_element(options.strains.begin(), options.strains.end(),
                           [](double a, double b)
                           { return std::abs(std::log(a / 0.1)) < std::abs(std::log(b / 0.1)); });
}

double compared_strain(const StrainStudyOptions &options)
{
  return *std::min_element(options.strains.begin(), options.strains.end(),
                           [](double a, double b)
                           { return std::abs(std::log(a / 0.01)) < std::abs(std::log(b / 0.01)); });
}

namespace
{
/// The fluctuation, or a note why there is none.
Fluctuation fluctuation_of(const StrainLevel &level, const meshes::Points &reference,
                           FluctuationMeasure &measure, StrainOutput &output)
{
  try
  {
    return measure.at(level.law, level.strain, reference);
  }
  catch (const meshes::NotConverged &failure)
  {
    output.write_note(level,
                      std::string("the homogenized sheet, resolved, finds no equilibrium, and the "
                                  "fluctuation is not known; ") +
                        failure.what());
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    return {unknown, unknown, unknown};
  }
}

/// What is said once: the terms of edges of a load, the coarse cloth's yarns.
void write_first_notes(const StrainStudyOptions &options, const StrainLevel &level,
                       const std::vector<std::pair<std::string, UpsampledSheet>> &missing,
                       const MethodOnSheet &method, StrainOutput &output)
{
  if (name_of(level.law) == options.references.front() &&
      std::any_of(missing.begin(), missing.end(),
                  [](const auto &each) { return each.first == "edges"; }))
    output.write_note(level, method.edged ? method.edged->sentence()
                                          : "method edges: its rows are those of localized; " +
                                              method.why_no_edges);
  if (level.law == Law::yarn && level.load == options.loads.front())
    output.write_note(level, note_on_coarse_yarns(method.cell.stiffness));
}

/// Pictures are of sheets, against biot if it is there.
bool has_pictures(const StrainStudyOptions &options, const Load &load, const StrainLevel &level)
{
  return !load.is_periodic() &&
         (has_biot(options) ? level.law == Law::biot
                            : name_of(level.law) == options.references.front());
}

/// One picture for the report, and for ParaView that level and the largest.
void write_pictures(const StrainStudyOptions &options, const StrainLevel &level,
                    const meshes::Sheet &sheet, const meshes::TriangleMesh &coarse_rest,
                    const SheetFields &fields)
{
  const bool is_pictured   = level.strain == pictured_strain(options);
  const std::string folder = options.output + "/" + level.cell + "/";
  if (is_pictured)
    write_sheet_fields(folder + "fields-" + level.load + ".h5", sheet, coarse_rest, fields);
  if (is_pictured ||
      level.strain == *std::max_element(options.strains.begin(), options.strains.end()))
    write_sheet_vtu(folder + "sheet-" + level.load + "-" + short_text(level.strain) + ".vtu", sheet,
                    fields);
}
} // namespace

std::vector<std::string> notes_of(const ReferenceStep &fine, const Stability stability)
{
  std::vector<std::string> notes;
  if (stability == Stability::left)
    notes.emplace_back("the equilibrium that was found first is not stable; it was left along its "
                       "mode, and the stable one that was found is compared");
  if (stability == Stability::unstable)
    notes.emplace_back(
      "the equilibrium that is compared is not stable, and no stable one was found "
      "along its mode");
  if (fine.n_inverted > 0)
    notes.push_back(std::to_string(fine.n_inverted) +
                    " triangles of the fine reference are inverted (det F <= 0)");
  if (const std::string note = note_of_round_off(fine); !note.empty())
    notes.push_back(note);
  return notes;
}

UpsampledLevel compare_methods(const StrainStudyOptions &options, const StrainLevel &level,
                               const ResolvedLevel &resolved, MethodOnSheet &method,
                               const Load &load, StrainOutput &output)
{
  const ReferenceStep &fine = resolved.fine;
  LightweightCloth &cloth   = method.cloth;
  write_ellipticity(level, resolved, method.stiffness_of_phase, method.phases, output);
  const CoarseStep coarse = cloth.solve(level.law, level.strain);
  write_coarse_ellipticity(level, method, coarse.positions, output);
  const auto upsampled_with = [&](const std::string &name, const CoarseStep &step)
  {
    // Where a cell has no terms of edges the method is the one without them.
    UpsampledSheet upsampled =
      name == "edges" && method.edged
        ? method.edged->upsample(level.law, step.positions)
        : cloth.upsample(Method(name == "edges" ? "localized" : name), level.law, step.positions);
    if (!upsampled.positions.allFinite())
      throw meshes::NotConverged(
        level.cell + ", " + level.load + ", " + name + ": positions that are not finite", {});
    return upsampled;
  };
  const auto distance_of = [&](const meshes::Points &positions)
  { return (positions - fine.positions).rowwise().norm(); };
  const UpsampledSheet affine    = upsampled_with("affine", coarse),
                       localized = upsampled_with("localized", coarse);
  StrainErrors errors;
  const Fluctuation fluctuation = fluctuation_of(level, fine.positions, method.fluctuation, output);
  errors.fluctuation            = fluctuation.mean;
  errors.side                   = std::sqrt(resolved.sheet.lattice.area());
  errors.reference_bar          = resolved.bar;
  errors.seconds_reference      = fine.seconds;
  // All methods before the first row: a level has the errors of all, or is unreached.
  std::vector<std::pair<std::string, UpsampledSheet>> missing;
  CoarseStep second_order;
  for (const std::string &name : options.methods)
    if (const Method its(name);
        has_meaning(its, level.law, load) && !output.has_errors(level, name))
    {
      if (its.is_of_second_order())
        second_order = method.second_order->solve(level.law, level.strain);
      missing.emplace_back(
        name, name == "affine" ? affine
              : name == "localized"
                ? localized
                : upsampled_with(name, its.is_of_second_order() ? second_order : coarse));
    }
  if (!missing.empty() && level.strain == options.strains.front())
    write_first_notes(options, level, missing, method, output);
  if (!missing.empty())
    for (const ForceRow &row : force_rows(level, resolved, method, load, coarse))
      output.write_forces(row);
  for (const auto &[name, upsampled] : missing)
  {
    errors.distance = distance_of(upsampled.positions);
    errors.seconds  = upsampled.seconds +
                     (Method(name).is_of_second_order() ? second_order.seconds : coarse.seconds);
    // The row comes last: where it is there, so is all that belongs to it.
    if (name == "localized")
    {
      if (has_pictures(options, load, level))
        write_pictures(options, level, resolved.sheet, cloth.coarse,
                       {load.name, level.strain, name_of(level.law), name, fine.positions,
                        upsampled.positions, affine.positions, coarse.positions});
      StepRow step;
      step.seconds_coarse      = coarse.seconds;
      step.seconds_upsample    = upsampled.seconds;
      step.seconds_fine        = fine.seconds;
      step.coarse_iterations   = coarse.iterations;
      step.fine_iterations     = fine.n_newton;
      step.fine_dofs           = resolved.n_dofs;
      step.ranks               = resolved.n_ranks;
      step.fluctuation         = fluctuation.mean;
      step.fluctuation_bar     = fluctuation.bar;
      step.homogenized_law     = name_of(homogenized_law(level.law, method.cell.stiffness));
      step.seconds_homogenized = fluctuation.seconds;
      step.stability           = name_of(resolved.stability);
      step.seconds_stability   = resolved.seconds_stability;
      output.write_step(level, step);
    }
    output.write_errors(level, name, resolved.sheet, cloth.coarse.n_triangles(), errors);
  }
  if (!load.is_periodic() && level.law == Law::biot && level.strain == compared_strain(options))
    if (const std::string note =
          note_of_anchor(errors_of_other_anchors(method.cell, cloth.coarse, resolved.sheet,
                                                 level.law, coarse.positions, fine.positions),
                         distance_of(localized.positions).mean(),
                         distance_of(affine.positions).mean(), resolved.bar.mean);
        !note.empty())
      output.write_note(level, note);
  return {coarse.positions, localized.positions};
}
} // namespace homespun::verification
