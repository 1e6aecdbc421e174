// SPDX-License-Identifier: MIT
// How far the up-sampled cloth is from a full-resolution one at a frame.
#pragma once

#include "verification/drape/coarse_run.h"
#include "verification/drape/drape_error_bar.h"
#include "verification/drape/drape_output.h"
#include "verification/drape/draped_cell.h"

#include <map>
#include <string>
#include <vector>

namespace homespun::verification
{
/// Holds the coarse runs of one cell, up-sampled by some methods, against references.
class DrapeComparison
{
public:
  /// Tabulates every method once.
  /// @param runs kept by reference
  DrapeComparison(const DrapedCell &draped, const std::vector<std::string> &methods,
                  const std::vector<CoarseRun> &runs);

  /// Writes a row of drape.csv for each coarse run and method at a frame.
  /// @param positions of the reference at the vertices that up-sampling gives (n_fine,3) [m]
  /// @return the distance of each vertex of the method from the reference (n_fine,1) [m], named
  ///   `error`; nothing where it was not asked for or did not come so far
  /// @throws NotConverged where up-sampled positions are not finite
  std::vector<meshes::VertexData> compare(const std::string &reference, int frame,
                                          const meshes::SpacePoints &positions,
                                          const DrapeErrorBar &bar, DrapeOutput &output) const;

  /// Whether the rows of a frame are on the disk: those that compare() writes, and those of the
  /// reference's motion and of what is held.
  bool has_rows(const std::string &reference, int frame, const DrapeOutput &output) const;

private:
  meshes::SpacePoints upsampled(const std::string &method, const shell::Vectors &coarse) const;

  const DrapedCell &draped;
  const std::vector<std::string> methods;
  const std::vector<std::string> places; ///< that are held
  const std::vector<CoarseRun> &runs;
  std::map<std::string, Upsampler3d> upsamplers; ///< of the methods, and `affine` in any case
};
} // namespace homespun::verification
