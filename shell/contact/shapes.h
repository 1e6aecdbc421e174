// SPDX-License-Identifier: MIT
// Bodies by their signed distance: planes, spheres, closed meshes.
#pragma once

#include "shell/contact/closed_surface.h"

#include <memory>
#include <optional>

namespace homespun::shell
{
/// A body by its signed distance, in its own frame.
class Shape
{
public:
  virtual ~Shape() = default;

  /// Signed distance and its gradient; none where the distance is larger than `within`.
  virtual std::optional<SurfacePoint> nearest(const Eigen::Vector3d &point,
                                              double within) const = 0;

  /// Where the segment first enters.
  virtual std::optional<SurfaceEntry> first_entry(const Eigen::Vector3d &from,
                                                  const Eigen::Vector3d &to) const = 0;

  virtual std::size_t bytes() const = 0;
};

/// All that lies below a plane.
/// @param normal any length but zero, out of the body
/// @throws BadInput for a normal without direction
std::shared_ptr<const Shape> plane(const Eigen::Vector3d &point, const Eigen::Vector3d &normal);

/// @throws BadInput for a radius that is not positive
std::shared_ptr<const Shape> sphere(const Eigen::Vector3d &centre, double radius);

std::shared_ptr<const Shape> closed_mesh(ClosedSurface surface);
} // namespace homespun::shell
