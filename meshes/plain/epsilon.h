// SPDX-License-Identifier: MIT
// The round-off of a double.
#pragma once

#include <limits>

namespace homespun::meshes
{
/// From 1 to the next larger double.
inline constexpr double epsilon = std::numeric_limits<double>::epsilon();
} // namespace homespun::meshes
