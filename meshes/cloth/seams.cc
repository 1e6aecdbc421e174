// SPDX-License-Identifier: MIT
#include "meshes/cloth/seams.h"

#include "meshes/plain/cross.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <unordered_map>

namespace homespun::meshes
{
Panels panels_of(const ClothMesh &cloth)
{
  std::vector<int> parent(static_cast<std::size_t>(cloth.rest.n_vertices()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v)
  {
    while (parent[static_cast<std::size_t>(v)] != v)
    {
      int &up = parent[static_cast<std::size_t>(v)];
      up      = parent[static_cast<std::size_t>(up)];
      v       = up;
    }
    return v;
  };
  for (int t = 0; t < cloth.rest.n_triangles(); ++t)
    for (int k = 1; k < 3; ++k)
      parent[static_cast<std::size_t>(root(cloth.rest.triangles(t, k)))] =
        root(cloth.rest.triangles(t, 0));

  Panels panels;
  panels.of_vertex.setConstant(cloth.rest.n_vertices(), -1);
  panels.of_triangle.resize(cloth.rest.n_triangles());
  for (int t = 0; t < cloth.rest.n_triangles(); ++t)
  {
    int &panel = panels.of_vertex(root(cloth.rest.triangles(t, 0)));
    if (panel < 0)
      panel = panels.count++;
    panels.of_triangle(t) = panel;
  }
  for (int t = 0; t < cloth.rest.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      panels.of_vertex(cloth.rest.triangles(t, k)) = panels.of_triangle(t);
  return panels;
}

std::array<int, 2> rest_ends(const ClothMesh &cloth, const Side &side)
{
  return {cloth.rest.triangles(side.triangle, side.side),
          cloth.rest.triangles(side.triangle, (side.side + 1) % 3)};
}

std::array<int, 2> space_ends(const ClothMesh &cloth, const Side &side)
{
  return {cloth.triangles(side.triangle, side.side),
          cloth.triangles(side.triangle, (side.side + 1) % 3)};
}

std::vector<Side> open_sides(const ClothMesh &cloth)
{
  std::map<std::array<int, 2>, int> owners;
  const auto owners_of = [&](const Side &side) -> int &
  {
    auto ends = rest_ends(cloth, side);
    std::sort(ends.begin(), ends.end());
    return owners[ends];
  };
  for (int t = 0; t < cloth.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      ++owners_of({t, k});
  std::vector<Side> open;
  for (int t = 0; t < cloth.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      if (owners_of({t, k}) == 1)
        open.push_back({t, k});
  return open;
}

std::vector<SeamEdge> seam_edges(const ClothMesh &cloth)
{
  const auto key = [](const std::array<int, 2> &ends)
  {
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(ends[0])) << 32) |
           static_cast<std::uint32_t>(ends[1]);
  };
  std::unordered_map<std::uint64_t, Side> side_of;
  side_of.reserve(3 * static_cast<std::size_t>(cloth.n_triangles()));
  for (int t = 0; t < cloth.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      side_of.emplace(key(space_ends(cloth, {t, k})), Side{t, k});
  std::vector<SeamEdge> seams;
  for (int t = 0; t < cloth.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const Side side                = {t, k};
      const std::array<int, 2> space = space_ends(cloth, side);
      const auto other               = side_of.find(key({space[1], space[0]}));
      if (other == side_of.end() || other->second.triangle <= t)
        continue;
      const std::array<int, 2> here  = rest_ends(cloth, side),
                               there = rest_ends(cloth, other->second);
      if (here[0] != there[1] || here[1] != there[0])
        seams.push_back({{side, other->second}});
    }
  return seams;
}

Eigen::VectorXi space_of_rest(const ClothMesh &cloth)
{
  Eigen::VectorXi space = Eigen::VectorXi::Constant(cloth.rest.n_vertices(), -1);
  for (int t = 0; t < cloth.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      space(cloth.rest.triangles(t, k)) = cloth.triangles(t, k);
  return space;
}

Eigen::VectorXd sewn_angles(const ClothMesh &cloth)
{
  const auto n_vertices  = static_cast<Eigen::Index>(cloth.positions.rows());
  Eigen::VectorXd angles = Eigen::VectorXd::Zero(n_vertices);
  Eigen::VectorXi n_rest = Eigen::VectorXi::Zero(n_vertices);
  for (const int v : space_of_rest(cloth))
    if (v >= 0)
      ++n_rest(v);
  for (int t = 0; t < cloth.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const auto corner = [&](const int l) -> Eigen::RowVector2d
      { return cloth.rest.vertices.row(cloth.rest.triangles(t, (k + l) % 3)); };
      const Eigen::RowVector2d one = corner(1) - corner(0), other = corner(2) - corner(0);
      if (const int v = cloth.triangles(t, k); n_rest(v) > 1)
        angles(v) += std::atan2(std::abs(cross(one, other)), one.dot(other));
    }
  return angles;
}
} // namespace homespun::meshes
