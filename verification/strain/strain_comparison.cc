// SPDX-License-Identifier: MIT
#include "verification/strain/strain_comparison.h"

#include "meshes/plain/errors.h"
#include "verification/laws/yarn_cells.h"
#include "verification/method/anchor_choice.h"
#include "verification/method/mode_fit.h"
#include "verification/record/main_reference.h"
#include "verification/record/number_text.h"
#include "verification/strain/force_rows.h"
#include "verification/strain/level_ellipticity.h"
#include "verification/strain/sheet_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace homespun::verification
{
std::vector<Law> laws_of_second_order(const StrainStudyOptions &options)
{
  std::vector<Law> laws;
  if (std::any_of(options.methods.begin(), options.methods.end(),
                  [](const std::string &name) { return Method(name).is_of_second_order(); }))
    for (const Law law : all_laws())
      if (meshes::properties_of(law).has_second_order &&
          std::find(options.references.begin(), options.references.end(), name_of(law)) !=
            options.references.end())
        laws.push_back(law);
  return laws;
}

Method used_on(const Method &method, const meshes::Sheet &sheet)
{
  return CoarseSpace::fits(sheet, method.coarse(Law::linear).element) ? method
                                                                      : method.without_six_nodes();
}

bool has_edges(const StrainStudyOptions &options)
{
  return std::any_of(options.methods.begin(), options.methods.end(),
                     [](const std::string &name) { return Method(name).has_edge_terms(); });
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
  for (const std::string &name : options.methods)
    if (has_meaning(Method(name), load))
      for (const std::string &law : options.references)
        if (const Method used = used_on(Method(name), sheet); used.has_meaning(law_of(law)))
          if (const CoarseChoice choice = used.coarse(law_of(law)); CoarseChoice() < choice)
            method.others.try_emplace(choice, homogenized, sheet, load, choice);
  method.why_no_edges = edges.why_not;
  if (edges.edges && !load.is_periodic())
    for (const std::string &name : options.methods)
      if (Method(name).has_edge_terms())
        method.edged.try_emplace(name, CellWithEdges{homogenized, *edges.edges}, sheet, load,
                                 used_on(Method(name), sheet));
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

/// Pictures are of sheets, against the main reference.
bool has_pictures(const StrainStudyOptions &options, const Load &load, const StrainLevel &level)
{
  return !load.is_periodic() && name_of(level.law) == main_reference(options.references);
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
/// A method at a level.
struct UpsampledMethod
{
  std::string name;
  std::optional<UpsampledSheet> sheet; ///< nothing where its own coarse cloth has no equilibrium
  double seconds_coarse = 0.;
};

/// The methods at one level; each coarse cloth is solved once.
class MethodsAtLevel
{
public:
  /// @throws NotConverged where the coarse cloth of `localized` finds no equilibrium
  MethodsAtLevel(const StrainLevel &level, const meshes::Sheet &sheet, MethodOnSheet &method)
      : coarse(method.cloth.solve(level.law, level.strain))
      , level(level)
      , sheet(sheet)
      , method(method)
  {
  }

  /// @throws NotConverged where the coarse cloth of this method finds no equilibrium, or positions
  ///   are not finite
  UpsampledMethod upsampled(const std::string &name)
  {
    const meshes::FittedModes *const fitted = fitted_by(name);
    if (Method(name).has_fitted_modes(level.law) && fitted == nullptr)
      throw meshes::NotConverged("no modes could be fitted under this law", {});
    const auto edged = method.edged.find(name);
    const Method of  = used_on(Method(name), sheet);
    // Where a cell has no terms of edges the method is the one without them.
    const Method used      = edged == method.edged.end() ? of.without_edge_terms() : of;
    const CoarseStep &step = step_of(used.coarse(level.law));
    UpsampledMethod result = {
      name,
      edged == method.edged.end()
        ? cloth_of(used.coarse(level.law)).upsample(used, level.law, step.positions, fitted)
        : edged->second.upsample(level.law, step.positions, fitted),
      step.seconds};
    if (!result.sheet->positions.allFinite())
      throw meshes::NotConverged(
        level.cell + ", " + level.load + ", " + name + ": positions that are not finite", {});
    return result;
  }

  /// The same, or a note that the method has no equilibrium here.
  UpsampledMethod upsampled_or_noted(const std::string &name, StrainOutput &output)
  {
    try
    {
      return upsampled(name);
    }
    catch (const meshes::NotConverged &failure)
    {
      output.write_note(level, "method " + name +
                                 ": its coarse cloth finds no equilibrium, and its error is not "
                                 "known; " +
                                 failure.what());
      return {name, std::nullopt};
    }
  }

  /// Where the coarse cloth of a method is in the box of its fitted modes, if it has any.
  void note_strains_outside(const std::string &name, StrainOutput &output)
  {
    const meshes::FittedModes *const fitted = fitted_by(name);
    if (fitted == nullptr)
      return;
    const CoarseChoice choice        = Method(name).coarse(level.law);
    const meshes::TriangleMesh &rest = cloth_of(choice).coarse;
    const int n                      = n_outside(*fitted, rest, step_of(choice).positions);
    if (n > 0)
      output.write_note(level, "method " + name + ": " + std::to_string(n) + " of " +
                                 std::to_string(rest.n_triangles()) +
                                 " coarse triangles are strained beyond the box that its modes are "
                                 "fitted over; there they are those at its border");
  }

  const CoarseStep coarse;

private:
  const meshes::FittedModes *fitted_by(const std::string &name) const
  {
    const auto found = method.fitted.find(level.law);
    return Method(name).has_fitted_modes(level.law) && found != method.fitted.end() ? &found->second
                                                                                    : nullptr;
  }

  LightweightCloth &cloth_of(const CoarseChoice &choice)
  {
    const auto other = method.others.find(choice);
    return other == method.others.end() ? method.cloth : other->second;
  }

  const CoarseStep &step_of(const CoarseChoice &choice)
  {
    if (method.others.count(choice) == 0)
      return coarse;
    auto step = steps.find(choice);
    if (step == steps.end())
      step = steps.emplace(choice, cloth_of(choice).solve(level.law, level.strain)).first;
    return step->second;
  }

  const StrainLevel &level;
  const meshes::Sheet &sheet;
  MethodOnSheet &method;
  std::map<CoarseChoice, CoarseStep> steps;
};

/// Which edges have terms, or why a method is another one here.
void write_notes_of_methods(const StrainLevel &level, const std::vector<UpsampledMethod> &methods,
                            const meshes::Sheet &sheet, const MethodOnSheet &method,
                            StrainOutput &output)
{
  for (const UpsampledMethod &of : methods)
  {
    const Method named(of.name);
    if (!CoarseSpace::fits(sheet, named.coarse(level.law).element))
      output.write_note(level, "method " + of.name +
                                 ": its triangles are two cells wide, and the sheet has an odd "
                                 "number of cells along a side; its coarse cloth has triangles of "
                                 "three nodes here");
    if (!named.has_edge_terms())
      continue;
    const auto edged = method.edged.find(of.name);
    output.write_note(level, edged != method.edged.end()
                               ? edged->second.sentence()
                               : "method " + of.name + ": without the terms of edges here; " +
                                   method.why_no_edges);
  }
}

/// What is said once: of the methods under a load, of the coarse cloth's yarns.
void write_first_notes(const StrainStudyOptions &options, const StrainLevel &level,
                       const std::vector<UpsampledMethod> &methods, const meshes::Sheet &sheet,
                       const MethodOnSheet &method, StrainOutput &output)
{
  if (name_of(level.law) == options.references.front())
    write_notes_of_methods(level, methods, sheet, method, output);
  if (is_of_yarns(level.law) && level.load == options.loads.front())
    output.write_note(level, note_on_coarse_yarns(level.law, method.cell.stiffness));
}

/// The row of a level but for its keys and the up-sampling.
StepRow step_of(const ResolvedLevel &resolved, const CoarseStep &coarse,
                const Fluctuation &fluctuation, const Law homogenized_law)
{
  StepRow step;
  step.seconds_coarse      = coarse.seconds;
  step.seconds_fine        = resolved.fine.seconds;
  step.coarse_iterations   = coarse.iterations;
  step.fine_iterations     = resolved.fine.n_newton;
  step.fine_dofs           = resolved.n_dofs;
  step.ranks               = resolved.n_ranks;
  step.fluctuation         = fluctuation.mean;
  step.fluctuation_bar     = fluctuation.bar;
  step.homogenized_law     = name_of(homogenized_law);
  step.seconds_homogenized = fluctuation.seconds;
  step.stability           = name_of(resolved.stability);
  step.seconds_stability   = resolved.seconds_stability;
  return step;
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
  const ReferenceStep &fine     = resolved.fine;
  const LightweightCloth &cloth = method.cloth;
  write_ellipticity(level, resolved, method.stiffness_of_phase, method.phases, output);
  MethodsAtLevel methods(level, resolved.sheet, method);
  const CoarseStep &coarse = methods.coarse;
  write_coarse_ellipticity(level, method, coarse.positions, output);
  const auto distance_of = [&](const meshes::Points &positions)
  { return (positions - fine.positions).rowwise().norm(); };
  const UpsampledMethod affine    = methods.upsampled("affine"),
                        localized = methods.upsampled("localized");
  StrainErrors errors;
  const Fluctuation fluctuation = fluctuation_of(level, fine.positions, method.fluctuation, output);
  errors.fluctuation            = fluctuation.mean;
  errors.side                   = std::sqrt(resolved.sheet.lattice.area());
  errors.reference_bar          = resolved.bar;
  errors.seconds_reference      = fine.seconds;
  // All methods before the first row: a level has a row of each, or is unreached.
  std::vector<UpsampledMethod> missing;
  for (const std::string &name : options.methods)
    if (has_meaning(Method(name), level.law, load) && !output.has_errors(level, name))
      missing.push_back(name == "affine"      ? affine
                        : name == "localized" ? localized
                                              : methods.upsampled_or_noted(name, output));
  if (!missing.empty() && level.strain == options.strains.front())
    write_first_notes(options, level, missing, resolved.sheet, method, output);
  if (!missing.empty())
    for (const ForceRow &row : force_rows(level, resolved, method, load, coarse))
      output.write_forces(row);
  const int n_coarse = cloth.coarse.n_triangles();
  for (const UpsampledMethod &of : missing)
  {
    if (!of.sheet)
    {
      output.write_without_errors(level, of.name, resolved.sheet, n_coarse);
      continue;
    }
    methods.note_strains_outside(of.name, output);
    errors.distance = distance_of(of.sheet->positions);
    errors.seconds  = of.sheet->seconds + of.seconds_coarse;
    // The row comes last: where it is there, so is all that belongs to it.
    if (of.name == "localized")
    {
      if (has_pictures(options, load, level))
        write_pictures(options, level, resolved.sheet, cloth.coarse,
                       {load.name, level.strain, name_of(level.law), of.name, fine.positions,
                        of.sheet->positions, affine.sheet->positions, coarse.positions});
      StepRow step =
        step_of(resolved, coarse, fluctuation, homogenized_law(level.law, method.cell.stiffness));
      step.seconds_upsample = of.sheet->seconds;
      output.write_step(level, step);
    }
    output.write_errors(level, of.name, resolved.sheet, n_coarse, errors);
  }
  if (!load.is_periodic() && name_of(level.law) == main_reference(options.references) &&
      level.strain == compared_strain(options))
    if (const std::string note =
          note_of_anchor(errors_of_other_anchors(method.cell, cloth.coarse, resolved.sheet,
                                                 level.law, coarse.positions, fine.positions),
                         distance_of(localized.sheet->positions).mean(),
                         distance_of(affine.sheet->positions).mean(), resolved.bar.mean);
        !note.empty())
      output.write_note(level, note);
  return {coarse.positions, localized.sheet->positions};
}
} // namespace homespun::verification
