// SPDX-License-Identifier: MIT
// Triangles with numbered sides: of a sheet, or of a cell whose opposite sides are glued.
#pragma once

#include "homogenization/cell/torus_mesh.h"
#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace homespun::homogenization
{
/// A triangle of a plate, counter-clockwise; side k joins the corners k and k + 1.
struct PlateTriangle
{
  std::array<int, 3> vertices, sides;
  std::array<Eigen::Vector2d, 3> corners; ///< [m]
  int material;
};

/// A side of a triangle that no other triangle has.
struct RimSide
{
  int triangle, side;
};

/// The mesh of a plate; plain data.
struct PlateMesh
{
  explicit PlateMesh(const meshes::TriangleMesh &mesh);
  explicit PlateMesh(const TorusMesh &mesh);

  std::vector<RimSide> rim() const;

  int n_vertices = 0;
  std::vector<PlateTriangle> triangles;
  std::vector<Eigen::Vector2d> normals; ///< of each side, of length 1, for both of its triangles
};
} // namespace homespun::homogenization
