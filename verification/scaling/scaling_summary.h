// SPDX-License-Identifier: MIT
// What the runs of `homespun scaling` say together: models of memory and time, claims, notes, the
// table for the terminal.
#pragma once

#include "verification/record/verdict.h"
#include "verification/scaling/scaling_tables.h"

#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// What does not fall with the number of ranks, what falls as one over it, and the largest relative
/// misfit of the least squares.
struct TwoTerms
{
  double fixed = 0., shared = 0., misfit = 0.;
};

/// The memory of the largest rank as a + b n/p [bytes], n DoFs on p ranks. Nothing below three
/// pairs of mesh and ranks, or where all have the same n/p: two terms need a third row to show
/// their misfit.
std::optional<TwoTerms> memory_model_of(const std::vector<ScalingRun> &runs);

/// The time as n (s + w/p) [s], from the runs on at most `cores` ranks. Nothing below three pairs
/// of mesh and ranks, or with one number of ranks alone, which does not tell what is serial.
std::optional<TwoTerms> time_model_of(const std::vector<ScalingRun> &runs, int cores);

/// C^H does not depend on the ranks, and the memory of a rank on the finest mesh falls with their
/// number; each where there is more than one to compare.
std::vector<Verdict> verdicts_of(const std::vector<ScalingRun> &runs);

/// What is told of the runs and not judged: by how much the iterations differ between meshes and
/// ranks, which theory bounds and does not number.
std::vector<std::string> notes_of(const std::vector<ScalingRun> &runs);

/// A table for the terminal: medians of the repeats, with the least and the largest.
std::string table_of(const std::vector<ScalingRun> &runs);
} // namespace homespun::verification
