// SPDX-License-Identifier: MIT
// What a table says of the errors at many vertices.
#pragma once

#include "meshes/plain/sheet.h"

#include <Eigen/Core>

#include <utility>

namespace homespun::verification
{
struct ErrorNorms
{
  double mean; ///< sum d_v / n
  double rms;  ///< sqrt(sum d_v² / n)
  double max;
};

/// @param distances d (n), n > 0, none negative [m]
/// @return in the unit of the distances
ErrorNorms error_norms(const Eigen::VectorXd &distances);

/// Means over the vertices of no cell at an edge of the sheet, and over the others; not a number
/// where there are none.
std::pair<double, double> apart_from_edges(const Eigen::VectorXd &distances,
                                           const meshes::Sheet &sheet);
} // namespace homespun::verification
