// SPDX-License-Identifier: MIT
// What `drape --keep` leaves for methods of other people, in CELL/positions/:
//   cloth.h5            where the cloth begins: /start (n,3) [m]  /triangles (m,3)
//                       /coarse_start (k,3) [m]  /coarse_triangles (l,3); of a sheet also where it
//                       is at rest: /rest (n,2) [m]  /coarse_rest (k,2) [m]  /material (m)
//   REFERENCE-FRAME.h5  a frame (record/kept_positions.h), with the attribute
//                       coarse_time_step_uncertainty_m
#pragma once

#include "verification/drape/draped_cell.h"
#include "verification/record/kept_positions.h"

#include <string>

namespace homespun::verification
{
/// `biot-0004`: what the files of a frame are called.
std::string file_name_of(const std::string &reference, int frame);

/// Writes the meshes.
/// @throws BadInput where the file cannot be written
void keep_cloth(const std::string &run, const DrapedCell &draped);

/// A frame of a reference.
struct KeptFrame
{
  std::string reference;
  int number = 0;
  KeptPositions positions;
  double coarse_step = 0.; ///< DrapeErrorBar::of_coarse_step_at() [m]; may be not a number
};

/// Writes a frame.
/// @throws BadInput where the file cannot be written
void keep_frame(const std::string &run, const DrapedCell &draped, const KeptFrame &frame);

/// KeptFrame::coarse_step of a frame that was kept; not a number where the run did not know it.
double kept_coarse_step(const std::string &folder, const std::string &name);
} // namespace homespun::verification
