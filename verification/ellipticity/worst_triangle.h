// SPDX-License-Identifier: MIT
// The triangle of a mesh that is farthest from elliptic, and what pulls or presses it there.
#pragma once

#include "meshes/plain/triangle_mesh.h"
#include "verification/law/laws.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace homespun::verification
{
struct WorstTriangle
{
  int triangle = -1;    ///< −1: of a mesh without triangles
  double least = 1.;    ///< its least wave as a part of that at rest
  bool is_lost = false; ///< not elliptic
  Eigen::Vector2d stress =
    Eigen::Vector2d::Zero(); ///< principal second Piola stresses, the smaller
                             ///< first: negative where it is pressed [N/m]
};

/// The triangle whose least wave is the smallest part of that of its phase at rest.
/// @param rest rest.material being the phase of each triangle
/// @param stiffness_of_phase (3,3) [N/m]
/// @param law not `linear`, whose stress is no second Piola stress
/// @param positions (n,2) [m]
WorstTriangle worst_triangle(const meshes::TriangleMesh &rest,
                             const std::vector<Eigen::Matrix3d> &stiffness_of_phase, Law law,
                             const meshes::Points &positions);

/// Its words: "is pulled", "is pressed", or "is pulled and pressed", and how much. Yarns give way
/// to a small pressure beside a large pull: only what is below a millionth of the other is none.
std::string stress_text(const WorstTriangle &worst);
} // namespace homespun::verification
