// SPDX-License-Identifier: MIT
// The sides of six-node triangles: parabolas, which a drawing has where a mesh of straight
// triangles has chords. Everything but brackets works with the chords.
#pragma once

#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace homespun::homogenization
{
/// A curved side between the vertices a and b of a mesh,
///   x(t) = (1 − t) x_a + t x_b + 4 t (1 − t) sagitta,   0 <= t <= 1,
/// the same from either end.
struct CurvedSide
{
  int a, b;
  Eigen::Vector2d sagitta; ///< from the middle of the chord to the middle node [m]
};

/// The middle nodes of a triangle, node k between the corners k and k + 1.
using MiddleNodes = std::array<Eigen::Vector2d, 3>;

/// A middle node within this part of the side's length from the chord makes a straight side.
constexpr double straightness = 1e-9;

/// The sides that are curved, each once. A side is straight where its middle node lies on the
/// chord.
/// @param middles of each triangle of the mesh
/// @param file put before each message
/// @throws BadInput, naming triangles, where a middle node lies so far from the middle that the
///   side runs back, where the curved sides invert a triangle (the Jacobian of its quadratic map is
///   not positive everywhere), and where neighbours curve their common side differently
std::vector<CurvedSide> curved_sides_of(const meshes::TriangleMesh &mesh,
                                        const std::vector<MiddleNodes> &middles,
                                        const std::string &file);

/// The areas of triangles between their curved sides: of the straight one 2/3 chord x sagitta less
/// for each side, counter-clockwise (m) [m^2].
Eigen::VectorXd drawn_areas(const meshes::TriangleMesh &mesh,
                            const std::vector<CurvedSide> &curved_sides);
} // namespace homespun::homogenization
