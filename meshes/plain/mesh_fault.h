// SPDX-License-Identifier: MIT
// The faults of a mesh with their places, so that they can be shown as well as told.
#pragma once

#include <Eigen/Core>

#include <limits>
#include <string>
#include <vector>

namespace homespun::meshes
{
/// Where in a mesh something is; not finite where it is everywhere or nowhere.
struct Place
{
  Eigen::RowVector2d point = Eigen::RowVector2d::Constant(
    std::numeric_limits<double>::quiet_NaN()); ///< in the unit of the mesh
  int triangle = -1;                           ///< or -1
  int vertex   = -1;                           ///< or -1

  bool is_known() const
  {
    return point.allFinite();
  }
};

/// What was found, what was expected, what to do, and where.
struct MeshFault
{
  std::string message;
  Place place;
};

/// The messages alone.
inline std::vector<std::string> messages_of(const std::vector<MeshFault> &faults)
{
  std::vector<std::string> messages;
  for (const MeshFault &fault : faults)
    messages.push_back(fault.message);
  return messages;
}
} // namespace homespun::meshes
