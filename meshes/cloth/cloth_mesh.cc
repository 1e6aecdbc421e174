// SPDX-License-Identifier: MIT
#include "meshes/cloth/cloth_mesh.h"

namespace homespun::meshes
{
ClothMesh placed_sheet(const TriangleMesh &rest, const Eigen::Matrix<double, 3, 2> &placement,
                       const Eigen::RowVector3d &origin)
{
  ClothMesh cloth;
  cloth.rest      = rest;
  cloth.positions = (rest.vertices * placement.transpose()).rowwise() + origin;
  cloth.triangles = rest.triangles;
  return cloth;
}
} // namespace homespun::meshes
