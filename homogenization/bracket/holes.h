// SPDX-License-Identifier: MIT
// The holes of a glued mesh: which vertices and edges lie on the rim of which, and where.
#pragma once

#include "homogenization/cell/torus_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::homogenization
{
/// What is in the holes of a membrane: nothing, or what never deforms. A hole in a plate is a rigid
/// part of its analogous membrane (bending_bracket.h).
enum class Holes
{
  empty,
  rigid
};

/// A point on the rim of a hole.
struct RimPoint
{
  int hole                 = -1;                      ///< -1: on no rim
  Eigen::Vector2d position = Eigen::Vector2d::Zero(); ///< from the first vertex of the rim [m]
};

/// Holes that touch in a vertex are one.
struct Rims
{
  std::vector<RimPoint> of_vertex, of_edge; ///< of an edge: its middle
  int n_holes = 0;
};

/// @throws BadInput where a hole meets an image of itself
Rims rims_of(const TorusMesh &mesh);
} // namespace homespun::homogenization
