// SPDX-License-Identifier: MIT
// A closed triangle mesh that answers two questions: how far is a point, on which side (signed
// distance with its gradient), and where does a segment first enter. The sign comes from the
// pseudo-normal of the nearest face, edge or vertex, angle-weighted at vertices: Bærentzen and
// Aanæs, "Signed distance computation using the angle weighted pseudonormal" (IEEE TVCG 2005). A
// tree of boxes aligned with the axes finds the nearest triangle. Every finite point has an answer,
// also on an edge or a vertex.
#pragma once

#include "meshes/cloth/cloth_mesh.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace homespun::shell
{
/// What a point sees of a surface; the nearest point on it is point − distance × normal.
struct SurfacePoint
{
  double distance = 0.;   ///< signed, negative inside [m]
  Eigen::Vector3d normal; ///< its gradient, unit length, outwards
};

/// Where a segment enters.
struct SurfaceEntry
{
  Eigen::Vector3d point;  ///< [m]
  Eigen::Vector3d normal; ///< of the face, outwards
  double part = 0.;       ///< of the segment that lies before it, 0 to 1
};

class ClosedSurface
{
public:
  /// @param vertices (n,3) [m]
  /// @param triangles (m,3) counter-clockwise seen from outside
  /// @param name put before each message, usually the file
  /// @throws BadInput with all faults: coordinates, indices, triangles without area, edges that do
  ///   not have two triangles traversing them in opposite ways, normals that point inwards
  ClosedSurface(const meshes::SpacePoints &vertices, const meshes::Triangles &triangles,
                const std::string &name);

  /// Signed distance and its gradient; none where the distance is larger than `within`.
  std::optional<SurfacePoint>
  nearest(const Eigen::Vector3d &point,
          double within = std::numeric_limits<double>::infinity()) const;

  /// First point where the segment goes through a face against its normal; edges belong to both
  /// faces.
  std::optional<SurfaceEntry> first_entry(const Eigen::Vector3d &from,
                                          const Eigen::Vector3d &to) const;

  std::size_t bytes() const;

private:
  struct TreeNode
  {
    Eigen::AlignedBox3d box;
    int first = 0, n = 0; ///< a leaf: its part of `order`
    int right = -1;       ///< else the left child follows, and this is the right one
  };
  int build(int begin, int end);
  Eigen::Vector3d corner(int triangle, int k) const
  {
    return x.row(t(triangle, k % 3)).transpose();
  }

  meshes::SpacePoints x;
  meshes::Triangles t;
  meshes::SpacePoints face_normals;   ///< (m,3) unit
  meshes::SpacePoints edge_normals;   ///< (3 m,3) unit, of the edge opposite to corner k
  meshes::SpacePoints vertex_normals; ///< (n,3) unit
  std::vector<int> order;             ///< triangles, leaf by leaf
  std::vector<TreeNode> nodes;
};
} // namespace homespun::shell
