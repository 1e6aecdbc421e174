// SPDX-License-Identifier: MIT
#include "verification/reference/loads.h"

#include "meshes/plain/errors.h"

#include <algorithm>

namespace homespun::verification
{
const std::vector<std::string> &Load::names()
{
  static const std::vector<std::string> all = {"periodic-11", "periodic-22", "periodic-12",
                                               "strip-1",     "strip-2",     "shear-frame"};
  return all;
}

Load::Load(const std::string &name)
    : name(name)
{
  if (std::find(names().begin(), names().end(), name) == names().end())
    throw meshes::BadInput("unknown load `" + name +
                           "`; expected periodic-11, periodic-22, periodic-12, strip-1, strip-2 or "
                           "shear-frame");
}

bool Load::is_periodic() const
{
  return name.rfind("periodic", 0) == 0;
}

Eigen::Matrix2d Load::gradient(const double strain) const
{
  Eigen::Matrix2d F = Eigen::Matrix2d::Identity();
  if (name == "periodic-11")
    F(0, 0) += strain;
  else if (name == "periodic-22")
    F(1, 1) += strain;
  else
    F(0, 1) += strain;
  return F;
}

int Load::clamped_axis() const
{
  return name == "strip-1" ? 0 : 1;
}

bool Load::holds(const Eigen::RowVector2d &fraction) const
{
  constexpr double close = 1e-5; // far below a mesh width, far above the tolerance of images
  const double f         = fraction(clamped_axis());
  return f < close || f > 1. - close;
}

Eigen::RowVector2d Load::displacement(const Eigen::RowVector2d &fraction,
                                      const Eigen::Matrix2d &sides, const double strain) const
{
  const Eigen::RowVector2d far_edge = name == "shear-frame"
                                        ? sides.row(1).norm() * sides.row(0).normalized()
                                        : Eigen::RowVector2d(sides.row(clamped_axis()));
  return strain * fraction(clamped_axis()) * far_edge;
}
} // namespace homespun::verification
