// SPDX-License-Identifier: MIT
// What a table says of the errors at many vertices.
#pragma once

#include <Eigen/Core>

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
} // namespace homespun::verification
