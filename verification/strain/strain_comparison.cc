// SPDX-License-Identifier: MIT
#include "verification/strain/strain_comparison.h"

#include "meshes/plain/errors.h"
#include "verification/ellipticity/yarn_cells.h"
#include "verification/method/anchor_choice.h"
#include "verification/method/mode_fit.h"
#include "verification/record/main_reference.h"
#include "verification/record/number_text.h"
#include "verification/record/timing.h"
#include "verification/strain/force_rows.h"
#include "verification/strain/kept_positions.h"
#include "verification/strain/level_ellipticity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace homespun::verification
{
std::vector<Law> laws_of_second_order(const StrainStudyOptions &options)
{
  std::vector<Law> laws;
  for (const Law law : meshes::laws_with(&meshes::LawProperties::has_second_order))
    if (std::find(options.references.begin(), options.references.end(), name_of(law)) !=
          options.references.end() &&
        std::any_of(options.methods.begin(), options.methods.end(),
                    [&](const std::string &name) { return Method(name).is_of_second_order(law); }))
      laws.push_back(law);
  return laws;
}

bool has_edges(const StrainStudyOptions &options)
{
  return std::any_of(options.methods.begin(), options.methods.end(),
                     [](const std::string &name) { return Method(name).has(Term::edges); });
}

MethodsOnSheet methods_on_sheet(const homogenization::UnitCell &cell,
                                const meshes::HomogenizedCell &homogenized, const KnownEdges &edges,
                                const meshes::Sheet &sheet, const Load &load)
{
  return {{{homogenized, edges.edges ? &*edges.edges : nullptr}, sheet, load},
          FluctuationMeasure(homogenized, sheet, load),
          cell,
          edges.why_not};
}

double pictured_strain(const StrainStudyOptions &options)
{
  return strain_nearest_to(0.1, options.strains);
}

double compared_strain(const StrainStudyOptions &options)
{
  return strain_nearest_to(0.01, options.strains);
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
  meshes::Points positions = {}; ///< none where its own coarse cloth has no equilibrium [m]
  double seconds_coarse    = 0.; ///< of one run
  double seconds_upsample  = 0.;
  const MovedModel *moved  = nullptr;
};

/// @throws NotConverged where the coarse cloth of the method finds no equilibrium, or positions are
///   not finite
UpsampledMethod upsampled(const std::string &name, const StrainLevel &level,
                          MethodsOnSheet &methods)
{
  MovedModel &moved = methods.at(level.law, name);
  UpsampledMethod result;
  result.name           = name;
  result.moved          = &moved;
  result.seconds_coarse = seconds_of([&]() { moved.move(level.strain); });
  const auto upsampler  = moved.model.upsampler<double>();
  localization::Upsampler<2, double>::Fine fine;
  result.seconds_upsample =
    seconds_of([&]() { upsampler.upsample(moved.model.on_grid(*moved.state), fine); });
  result.positions = fine;
  if (!result.positions.allFinite())
    throw meshes::NotConverged(
      level.cell + ", " + level.load + ", " + name + ": positions that are not finite", {});
  return result;
}

/// The same, or a note that the method has no equilibrium here.
UpsampledMethod upsampled_or_noted(const std::string &name, const StrainLevel &level,
                                   MethodsOnSheet &methods, StrainOutput &output)
{
  try
  {
    return upsampled(name, level, methods);
  }
  catch (const meshes::NotConverged &failure)
  {
    output.write_note(level, "method " + name +
                               ": its coarse cloth finds no equilibrium, and its error is not "
                               "known; " +
                               failure.what());
    return {name};
  }
}

/// Where the coarse cloth of a method is in the box of its fitted modes, if it has any.
void note_strains_outside(const UpsampledMethod &of, const StrainLevel &level,
                          const MethodsOnSheet &methods, StrainOutput &output)
{
  const CoarseModel &model = of.moved->model;
  if (!model.method.has_fitted_modes(level.law))
    return;
  const meshes::TriangleMesh &rest = model.mesh();
  const int n = n_outside(methods.fitted.at(level.law), rest, of.moved->state->without_edges);
  if (n > 0)
    output.write_note(level, "method " + of.name + ": " + std::to_string(n) + " of " +
                               std::to_string(rest.n_triangles()) +
                               " coarse triangles are strained beyond the box that its modes are "
                               "fitted over; there they are those at its border");
}

/// Pictures are of the method that the page speaks of, among those that have an equilibrium.
std::string pictured_method(std::vector<std::string> names,
                            const std::vector<UpsampledMethod> &missing)
{
  for (const UpsampledMethod &of : missing)
    if (of.moved == nullptr)
      names.erase(std::remove(names.begin(), names.end(), of.name), names.end());
  return main_method(names);
}

/// Which edges have terms, or why a method is another one here.
void write_notes_of_methods(const StrainLevel &level, const std::vector<UpsampledMethod> &all,
                            const MethodsOnSheet &methods, StrainOutput &output)
{
  for (const UpsampledMethod &of : all)
  {
    const Method method = under(Method(of.name), level.law, methods.load);
    if (!CoarseSpace::fits(methods.sheet, element_of(method)))
      output.write_note(level, "method " + of.name +
                                 ": its triangles are two cells wide, and the sheet has an odd "
                                 "number of cells along a side; its coarse cloth has triangles of "
                                 "three nodes here");
    if (!method.has(Term::edges))
      continue;
    output.write_note(level, "method " + of.name + ": " +
                               (methods.cell.edges != nullptr
                                  ? sentence_of_edges(edge_kinds(methods.load))
                                  : "without the terms of edges here; " + methods.why_no_edges));
  }
}

/// What is said once: of the methods under a load, of the coarse cloth's yarns.
void write_first_notes(const StrainStudyOptions &options, const StrainLevel &level,
                       const std::vector<UpsampledMethod> &all, const MethodsOnSheet &methods,
                       StrainOutput &output)
{
  if (name_of(level.law) == options.references.front())
    write_notes_of_methods(level, all, methods, output);
  if (is_of_yarns(level.law) && level.load == options.loads.front())
    output.write_note(level, note_on_coarse_yarns(level.law, methods.cell.cell.stiffness));
}

LevelRow step_of(const StrainLevel &level, const ResolvedLevel &resolved,
                 const UpsampledMethod &localized, const Fluctuation &fluctuation,
                 const Law homogenized_law)
{
  LevelRow step            = row_of(level);
  step.seconds_coarse      = localized.seconds_coarse;
  step.seconds_upsample    = localized.seconds_upsample;
  step.seconds_fine        = resolved.fine.seconds;
  step.coarse_iterations   = localized.moved->state->iterations;
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
                       "mode, and the stable one that was found is compared; from here on "
                       "no error bar is known and no budget: both are measured on the other one");
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
                               const ResolvedLevel &resolved, MethodsOnSheet &methods,
                               StrainOutput &output)
{
  const ReferenceStep &fine           = resolved.fine;
  const Load &load                    = methods.load;
  const meshes::HomogenizedCell &cell = methods.cell.cell;
  write_ellipticity(level, resolved, methods.resolved, output);
  const auto distance_of = [&](const meshes::Points &positions)
  { return (positions - fine.positions).rowwise().norm(); };
  const UpsampledMethod affine    = upsampled("affine", level, methods),
                        localized = upsampled("localized", level, methods);
  const CoarseModel &model        = localized.moved->model;
  const CoarseState &coarse       = *localized.moved->state;
  write_coarse_ellipticity(level, model.mesh(), cell.stiffness, coarse.positions, output);
  const Fluctuation fluctuation =
    fluctuation_of(level, fine.positions, methods.fluctuation, output);
  // All methods before the first row: a level has a row of each, or is unreached.
  std::vector<UpsampledMethod> missing;
  const std::vector<std::string> distinct = distinct_methods(options.methods, level.law, load);
  for (const std::string &name : distinct)
    if (!output.has_errors(level, name))
      missing.push_back(name == "affine"      ? affine
                        : name == "localized" ? localized
                                              : upsampled_or_noted(name, level, methods, output));
  if (!missing.empty() && level.strain == options.strains.front())
    write_first_notes(options, level, missing, methods, output);
  if (!missing.empty())
    for (const ForceRow &row : force_rows(level, resolved, methods, model, coarse))
      output.forces.append_if_missing(row);
  if (options.keep && !missing.empty())
    keep(options.output, level, resolved.sheet, model.mesh(), {coarse.positions, fine.positions});
  const std::string pictured = pictured_method(distinct, missing);
  for (const UpsampledMethod &of : missing)
  {
    StrainRow row = row_of(level, of.name, resolved.sheet);
    if (of.moved == nullptr)
    {
      output.strain.append(row);
      continue;
    }
    note_strains_outside(of, level, methods, output);
    set_errors(row, distance_of(of.positions), resolved.sheet, fluctuation.mean);
    row.uncertainty       = resolved.bar.mean;
    row.uncertainty_max   = resolved.bar.max;
    row.to_refined        = resolved.bar.to_refined;
    row.seconds           = of.seconds_coarse + of.seconds_upsample;
    row.seconds_reference = fine.seconds;
    if (const auto bar = resolved.error_bars.find(of.name); bar != resolved.error_bars.end())
    {
      row.bar        = bar->second.mean;
      row.bar_safety = bar->second.safety;
    }
    // The row comes last: where it is there, so is all that belongs to it.
    if (of.name == pictured && has_pictures(options, load, level))
      write_pictures(options, level, resolved.sheet, model.mesh(),
                     {load.name, level.strain, name_of(level.law), of.name, fine.positions,
                      of.positions, affine.positions, coarse.positions});
    if (of.name == "localized")
      output.write_step(
        step_of(level, resolved, of, fluctuation, homogenized_law(level.law, cell.stiffness)));
    output.strain.append(row);
  }
  if (!load.is_periodic() && name_of(level.law) == main_reference(options.references) &&
      level.strain == compared_strain(options))
    if (const std::string note =
          note_of_anchor(errors_of_other_anchors(cell, model.mesh(), resolved.sheet, level.law,
                                                 coarse.positions, fine.positions),
                         distance_of(localized.positions).mean(),
                         distance_of(affine.positions).mean(), resolved.bar.mean);
        !note.empty())
      output.write_note(level, note);
  return {coarse.positions, localized.positions};
}
} // namespace homespun::verification
