// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <cstddef>

namespace homespun::meshes
{
/// An index of a matrix, which has a sign, as one of the standard library's containers.
inline std::size_t at(const Eigen::Index index)
{
  return static_cast<std::size_t>(index);
}
} // namespace homespun::meshes
