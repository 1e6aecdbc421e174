// SPDX-License-Identifier: MIT
// Whether frames, rest mesh and cell are likely in one unit: numbers in centimetres that are taken
// for metres give a cloth that is pressed by 97 %, or one of a hundred times as many cells along
// each side. Both are asked about before anything is written.
#pragma once

#include "localization/coarse_frames.h"
#include "meshes/cloth/cloth_mesh.h"

#include <string>

namespace homespun::localization
{
/// How an answer is given: `--vt-unit 0.01`, or in Python `vt_unit=0.01`.
enum class AnswerBy
{
  option,
  keyword
};

/// Where the rest state comes from, as far as its unit can be answered for.
struct RestUnits
{
  std::string file;
  double unit      = 1.;    ///< metres per unit of positions
  double vt_unit   = 1.;    ///< metres per unit of vt
  bool has_vt      = false; ///< the rest state is that of vt
  bool may_be_flat = false; ///< it is, and x and y of the mesh would be another
  AnswerBy answer  = AnswerBy::option;
};

/// Above this mean strain, or mean compression, a frame is asked about: parts of a cloth may go
/// farther, a cloth as a whole does not.
constexpr double questionable_strain = 0.5, questionable_compression = 0.3;

/// Cells along a coarse triangle, above which they are asked about: that triangle alone has 1e4
/// cells, and its strain is that of all.
constexpr double questionable_cells = 100.;

/// What to answer where a coarse triangle at rest is longer than a hundred cells; empty where none
/// is.
std::string question_of_cells(const meshes::ClothMesh &rest, double cell_side,
                              const RestUnits &units);

/// What to answer where the mean strain of a frame, or its mean compression, by rest area, is
/// questionable; empty where they are not.
/// @param coarse of the rest state
/// @param frame its file
/// @param positions (n,3) [m]
std::string question_of_strain(const meshes::ClothMesh &rest, const CoarseFrames<3> &coarse,
                               const std::string &frame, const meshes::SpacePoints &positions,
                               const RestUnits &units);
} // namespace homespun::localization
