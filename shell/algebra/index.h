// SPDX-License-Identifier: MIT
// An index of Eigen, which counts with a sign, as one of the standard library, which does not.
#pragma once

#include <cstddef>

namespace homespun::shell
{
/// @param i not negative
inline std::size_t index(const int i)
{
  return static_cast<std::size_t>(i);
}
} // namespace homespun::shell
