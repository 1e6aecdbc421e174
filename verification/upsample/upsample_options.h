// SPDX-License-Identifier: MIT
// What up-sampling the frames of another program is told.
#pragma once

#include "localization/options.h"
#include "verification/record/earlier.h"

#include <string>
#include <vector>

namespace homespun::verification
{
struct UpsampleOptions
{
  std::string cell_file;                       ///< cell.h5
  std::string rest_file;                       ///< .obj or .ply, whose faces all frames have
  std::vector<std::string> frames;             ///< files and patterns
  std::vector<std::string> formats = {"vtu"};  ///< vtu, ply, obj, usda, pc2
  std::vector<double> origin       = {0., 0.}; ///< a lattice point of the cells, at rest [m]
  double angle        = 0.;    ///< of the cell's first axis against the first rest axis [degrees]
  double unit         = 1.;    ///< metres per unit of the positions, at rest and of frames [m]
  double vt_unit      = 1.;    ///< metres per unit of vt [m]
  bool is_flat        = false; ///< the rest state is that of the positions, although there are vt
  bool accepts_strain = false; ///< what looks like another unit is none (unit_question.h)
  std::string method  = "localized"; ///< as localization::Method reads it
  std::vector<std::string> held;     ///< edges of a sheet (localization/given_method.h)
  localization::Slip slip = localization::Slip::added; ///< of clamped edges
  std::string up          = "z";                       ///< y or z: said in .usda
  std::string validity_file;                           ///< empty: beside the cell, if there is one
  double limit = 0.01; ///< of the error, as a part of the cell side: of the range of validity
  std::string output, command;
  Earlier earlier = Earlier::keep_work;
  bool quiet      = false;
};
} // namespace homespun::verification
