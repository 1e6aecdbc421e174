// SPDX-License-Identifier: MIT
// A bracket on a mesh that is not refined any more.
#pragma once

#include "homogenization/bracket/holes.h"
#include "homogenization/cell/torus_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::homogenization
{
struct Bracket;

/// bracket() without its gaps and indicators, which stay empty: they say where to refine.
Bracket bracket_sides(const TorusMesh &given,
                      const std::vector<Eigen::Matrix3d> &stiffness_of_material, unsigned order,
                      Holes holes = Holes::empty);
} // namespace homespun::homogenization
