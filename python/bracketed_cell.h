// SPDX-License-Identifier: MIT
// What homogenization gives Python: a cell with the guaranteed brackets on its stiffness.
#pragma once

#include "meshes/plain/homogenized_cell.h"

#include <Eigen/Core>

#include <optional>

namespace homespun::python
{
/// lower <= the exact stiffness <= upper as quadratic forms, and entry by entry the exact one is no
/// farther from `centre` than `half_width`. [N/m] of C^H, [N m] of D^H.
struct BracketOfStiffness
{
  Eigen::Matrix3d lower, upper, centre, half_width;
  double width       = 0.; ///< largest v.(upper − lower).v / v.upper.v
  bool is_of_drawing = false;
};

struct BracketedCell : meshes::HomogenizedCell
{
  std::optional<BracketOfStiffness> stiffness_bracket, bending_bracket;
};
} // namespace homespun::python
