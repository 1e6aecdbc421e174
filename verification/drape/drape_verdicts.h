// SPDX-License-Identifier: MIT
// What a scene run claims: how what is held must move and what a turned sheet must look like, that
// each cloth comes to the end of the scene, and how near the method is to a reference.
#pragma once

#include "verification/drape/drape_tables.h"
#include "verification/record/claim.h"

#include <string>
#include <vector>

namespace homespun::verification
{
class DrapedCell;

/// The claim of a coarse cloth. That of a variant that is not the method is open where it stops: it
/// is there to be compared, and what it would have been is not known.
/// @param n_found frames, with that of the beginning
inline Verdict verdict_of_cloth(const std::string &cell, const std::string &variant,
                                const bool is_method, const int n_found, const int n_wanted)
{
  return judged(is_method ? "scene-end.cloth" : "scene-end.variant",
                {{"cell", cell}, {"variant", variant}, {"frames", n_wanted}},
                n_found == n_wanted ? Outcome::pass
                : is_method         ? Outcome::fail
                                    : Outcome::inconclusive,
                n_found);
}

/// The claim of a reference. One without a single frame after the beginning says nothing at all; of
/// one that stops later it is open how far the method is from it then.
inline Verdict verdict_of_reference(const std::string &cell, const std::string &reference,
                                    const int n_found, const int n_wanted)
{
  return judged("scene-end.reference",
                {{"cell", cell}, {"reference", reference}, {"frames", n_wanted}},
                n_found == n_wanted ? Outcome::pass
                : n_found <= 1      ? Outcome::fail
                                    : Outcome::inconclusive,
                n_found);
}

/// The rows of drape.csv that are judged: of one cell, coarse cloth and reference.
struct JudgedErrors
{
  std::string cell, variant, reference;
};

/// What is asked of the method in a scene: places in the fabric to a twentieth of the way that they
/// went, and to a tenth of a cell.
constexpr double most_per_displacement = 0.05, most_per_cell = 0.1;

/// The claim that a method is closer to a reference than another one: a ratio of means over the
/// frames of the former after the beginning. The bar of an error is that of the reference's mesh
/// and that of the time step together; bars of both hold whatever the methods share, so that their
/// sum is safe by the triangle inequality. A claim that they could turn round is open, as is one of
/// which some frame has no bar, or which the other method does not have.
/// @param rows of drape.csv of one scene
Verdict verdict_of_closer(const std::vector<DrapeRow> &rows, const JudgedErrors &of,
                          const std::string &method, const std::string &other);

/// The method that is judged: `localized`, or of a run without it the last that is not `affine`.
std::string judged_method(const std::vector<DrapeRow> &rows, const std::string &cell);

/// Judges judged_method() against one reference that has an error bar, over the frames after the
/// beginning:
/// - it is closer than affine, by more than the bars
/// - the error over the displacement of the reference, and over the side of a cell, is below what
///   is asked, by more than the bar
/// @param side of a cell [m]
std::vector<Verdict> verdicts_of_accuracy(const std::vector<DrapeRow> &rows, const JudgedErrors &of,
                                          double side);

/// What is known of a scene before it runs:
/// - where it moves what it holds: that starts and ends at rest, evenly accelerated
/// - of a sheet: up-sampling in space what lies in a plane is up-sampling in that plane, turned,
/// and
///   its energy is that in the plane; for a plane across all axes and strains that change from cell
///   to cell
std::vector<Verdict> checks_of_scene(const DrapedCell &draped);
} // namespace homespun::verification
