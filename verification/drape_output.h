// SPDX-License-Identifier: MIT
// What a scene run leaves on the disk as it goes on: the tables drape.csv (errors), motion.csv (motion and
// energies) and terms.csv (what absent terms would cost), and the frames.
#pragma once

#include "meshes/surface_files.h"
#include "verification/result_files.h"

#include <Eigen/Core>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace homespun::verification
{
/// A row of motion.csv. What does not apply is not a number.
struct MotionRow
{
  Eigen::RowVector3d centre; ///< of the vertex in the middle [m]
  double kinetic      = 0.;  ///< [J]
  double elastic      = 0.;  ///< of membrane and plate, not of terms without an energy [J]
  double gravity      = 0.;  ///< potential of the weight, zero at the origin [J]
  double stretch      = 0.;  ///< the largest [-]
  double step_seconds = 0., upsampling = 0.; ///< medians so far [s]
};

/// A row of drape.csv.
struct ErrorRow
{
  double mean = 0., rms = 0., max = 0.; ///< over the fine vertices [m]
  double per_cell = 0., per_fluctuation = 0.;
  double uncertainty = 0.; ///< of the reference [m]
};

/// Time of a step over repeats [s]; of a cloth that did not converge not a number.
struct StepTime
{
  double median = std::numeric_limits<double>::quiet_NaN();
  double spread = std::numeric_limits<double>::quiet_NaN(); ///< half of the interquartile range
};

/// A row of terms.csv.
struct TermRow
{
  bool is_present = false;
  StepTime time, forced_time;
  std::size_t bytes = 0, forced_bytes = 0;
};

/// Tables and frames in a folder. Rows that are there already are not written again.
class DrapeOutput
{
public:
  /// @param interval between frames [s]
  /// @param formats of the frames: vtu, ply, obj
  /// @param with_terms whether terms.csv is to be written
  DrapeOutput(std::string folder, std::string scene, double interval,
              std::vector<std::string> formats, bool with_terms, bool resume);

  void write_error(const std::string &cell, const std::string &variant,
                   const std::string &reference, const std::string &method, int frame,
                   const ErrorRow &row);
  bool has_error(const std::string &cell, const std::string &variant, const std::string &reference,
                 const std::string &method, int frame) const;
  void write_motion(const std::string &cell, const std::string &variant, int frame,
                    const MotionRow &row);
  bool has_motion(const std::string &cell, const std::string &variant, int frame) const;
  bool has_term(const std::string &cell, const std::string &term) const;
  void write_term(const std::string &cell, const std::string &term, const TermRow &row);

  /// A frame on the disk in every format; the .vtu is listed in the collection, where there is one.
  /// @param run folder of the run, in that of the study
  /// @param what coarse or fine
  void write_frame(const std::string &run, const std::string &what, int frame,
                   const meshes::FloatPoints &positions, const meshes::Triangles &triangles,
                   const std::vector<meshes::VertexData> &data,
                   meshes::FrameCollection *collection) const;

  /// Lists the frames that an earlier run wrote.
  void list_earlier_frames(const std::string &run, int n,
                           meshes::FrameCollection &collection) const;

  /// Largest mean error of `localized` over time, in cell sides, of each cell against each reference; from
  /// the table, so that a resumed run speaks of all its frames. Ready lines.
  std::vector<std::string> worst_errors() const;

  const std::string folder;

private:
  const std::string scene;
  const double interval;
  const std::vector<std::string> formats;
  std::unique_ptr<ResultTable> errors, motion, terms;
};
} // namespace homespun::verification
