// SPDX-License-Identifier: MIT
// The coarse cloth of a scene over all its frames, up-sampled every step; and what each term that
// the scene leaves out would have cost.
#pragma once

#include "verification/drape/drape_options.h"
#include "verification/drape/drape_output.h"
#include "verification/drape/drape_schedule.h"
#include "verification/drape/draped_cell.h"
#include "verification/record/json_files.h"
#include "verification/record/progress.h"
#include "verification/record/timing.h"

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// A coarse cloth that is run.
struct CoarseCloth
{
  std::string variant;      ///< the name of its membrane, or that of the method
  std::optional<Law> law;   ///< none: nodal warping
  Method method;            ///< whose cloth it is
  bool is_of_method = true; ///< else a variant of the membrane, which goes with many
};

/// The coarse cloths of a cell: variants of the membrane, the main one first, and the methods that
/// have cloths of their own.
/// @param used a method as the scene, or a cell in it, has it
/// @param main where no variants are asked for
std::vector<CoarseCloth> cloths_of(const DrapeOptions &options, Law main,
                                   const std::function<Method(const Method &)> &used);

/// Waves of a run that are too short for its mesh.
struct RunOfWaves
{
  /// Those of one more frame.
  /// @param sides_of_frame their length; infinite where none are too short
  /// @param side of the mesh [m]
  void add(int frame_number, double sides_of_frame, double side);

  double sides  = std::numeric_limits<double>::infinity(); ///< length of the shortest
  double metres = std::numeric_limits<double>::infinity(); ///< the same [m]
  int frame     = 0;                                       ///< that has it
  int n         = 0;                                       ///< frames with such waves
};

/// A coarse cloth at every frame.
struct CoarseRun
{
  CoarseCloth cloth;
  bool is_main        = false; ///< the variant that is the method, against which others are held
  std::string failure = {};
  std::vector<shell::Vectors> frames = {};                   ///< (n_coarse,3) [m]
  double seconds_per_step = 0., seconds_per_upsampling = 0.; ///< medians [s]
  RunOfWaves waves                   = {};
  nlohmann::ordered_json description = {}; ///< for drape.json
};

/// What is to be said of them, after the name of a run; empty where none are too short.
std::string sentence_of(const RunOfWaves &waves, std::size_t n_frames);

/// Whether a run is up-sampled by a method: one with a cloth of its own goes with that cloth alone.
bool belongs(const CoarseRun &run, const DrapedCell &draped, const std::string &method);

/// Runs it and writes its frames and its rows of motion.csv. Takes seconds, and is computed again
/// when a study is resumed. A cloth that does not converge ends the run, with the reason in
/// `failure`.
CoarseRun run_coarse(const DrapedCell &draped, const CoarseCloth &cloth,
                     const DrapeSchedule &schedule, DrapeOutput &output, Progress &progress);

/// Writes terms.csv: median time per step with its spread, and memory, as the scene is and with
/// each term that it does not have forced upon it at zero strength. A time of steps that do not
/// converge stays empty.
void measure_term_costs(const DrapedCell &draped, DrapeOutput &output, Progress &progress);
} // namespace homespun::verification
