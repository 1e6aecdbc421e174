// SPDX-License-Identifier: MIT
// A field that is known everywhere, as manufactured solutions are, and the distance of a
// finite-element field from it.
#pragma once

#include <Eigen/Core>

#include <functional>

namespace homespun::verification
{
/// A vector; of fields in the plane the third component is not read.
using FieldValue = Eigen::Vector3d;
/// Derivatives of a field by the two rest coordinates.
using FieldGradient = Eigen::Matrix<double, 3, 2>;

/// A known field.
struct KnownField
{
  std::function<FieldValue(const Eigen::RowVector2d &rest_point)> value;
  std::function<FieldGradient(const Eigen::RowVector2d &rest_point)> gradient;
};

/// Norms of a difference of fields over the rest area.
struct FieldDistance
{
  double L2 = 0.; ///< sqrt(integral |v|²) [m · m]
  double H1 = 0.; ///< sqrt(integral |grad v|²), the seminorm [m]
};
} // namespace homespun::verification
