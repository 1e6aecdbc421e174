// SPDX-License-Identifier: MIT
// The table of an up-sampled motion: what can be said of a frame without a reference.
#pragma once

#include "verification/record/table.h"

#include <limits>
#include <optional>
#include <string>

namespace homespun::verification
{
/// upsample.csv: one indicator of one frame, over the coarse triangles; coarse_indicators.h says
/// what each is. All values are dimensionless. `limit` is empty where none is known.
struct UpsampleRow
{
  static constexpr const char *file   = "upsample.csv";
  static constexpr std::size_t n_keys = 2;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  std::string frame, indicator;
  std::string checksum; ///< of the file of the frame, CRC-32
  int triangles       = 0;
  double mean         = none; ///< by rest area
  double quantile     = none; ///< 99 % of the rest area lie at or below it
  double largest      = none;
  int worst           = 0;    ///< coarse triangle with the largest one, from 0
  double worst_rest_1 = none; ///< its middle at rest [m]
  double worst_rest_2 = none;
  double worst_x      = none; ///< and in space [m]
  double worst_y      = none;
  double worst_z      = none;
  double limit        = none;
  std::optional<int> beyond;  ///< triangles above the limit
  double share_beyond = none; ///< of the rest area

  template <typename Column>
  static void columns(Column &&column)
  {
    column("frame", &UpsampleRow::frame, Domain::name);
    column("indicator", &UpsampleRow::indicator, Domain::name);
    column("frame_crc32", &UpsampleRow::checksum, Domain::name);
    column("triangles", &UpsampleRow::triangles, Domain::positive);
    column("mean", &UpsampleRow::mean, Domain::needed_not_negative);
    column("quantile_99", &UpsampleRow::quantile, Domain::needed_not_negative);
    column("largest", &UpsampleRow::largest, Domain::needed_not_negative);
    column("worst_triangle", &UpsampleRow::worst, Domain::needed_not_negative);
    column("worst_rest_1_m", &UpsampleRow::worst_rest_1, Domain::real);
    column("worst_rest_2_m", &UpsampleRow::worst_rest_2, Domain::real);
    column("worst_x_m", &UpsampleRow::worst_x, Domain::real);
    column("worst_y_m", &UpsampleRow::worst_y, Domain::real);
    column("worst_z_m", &UpsampleRow::worst_z, Domain::real);
    column("limit", &UpsampleRow::limit, Domain::not_negative);
    column("triangles_beyond", &UpsampleRow::beyond, Domain::not_negative);
    column("area_share_beyond", &UpsampleRow::share_beyond, Domain::not_negative);
  }
};
} // namespace homespun::verification
