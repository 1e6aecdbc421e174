// SPDX-License-Identifier: MIT
// A way that is gone as a whole, or where that does not converge in halves, and these in halves.
#pragma once

#include "meshes/plain/errors.h"

#include <functional>
#include <optional>

namespace homespun::verification
{
struct GoneWay
{
  double reached       = 0.;                   ///< part of the way; 1: all of it
  unsigned int n_parts = 0;                    ///< that it was gone in
  std::optional<meshes::NotConverged> failure; ///< of the last part that failed, if one did
};

/// Every part is the longest of 1, 1/2, 1/4, ... that begins where the last one ended and has not
/// failed, so that parts grow again behind a difficult place.
/// @param most_halvings of the whole, after which the way ends where it is
/// @param go_part goes from one part of the way to another, each an exact dyadic fraction; throws
///   NotConverged
GoneWay go_in_halves(unsigned int most_halvings,
                     const std::function<void(double from, double to)> &go_part);
} // namespace homespun::verification
