// SPDX-License-Identifier: MIT
#include "homogenization/fem/mesh_parts.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace homespun::homogenization
{
namespace
{
using Order = std::vector<unsigned int>::iterator;

/// Gives the triangles of an interval the parts from the first on.
void cut(const Eigen::MatrixX2d &centres, const Order begin, const Order end,
         const unsigned int first_part, const unsigned int n_parts, std::vector<unsigned int> &part)
{
  if (n_parts == 1)
  {
    for (Order t = begin; t != end; ++t)
      part[*t] = first_part;
    return;
  }
  if (begin == end)
    return;
  Eigen::RowVector2d lowest  = centres.row(*begin);
  Eigen::RowVector2d highest = lowest;
  for (Order t = begin; t != end; ++t)
  {
    lowest  = lowest.cwiseMin(centres.row(*t));
    highest = highest.cwiseMax(centres.row(*t));
  }
  Eigen::Index axis = 0;
  (highest - lowest).maxCoeff(&axis);
  const unsigned int n_left = n_parts / 2;
  const Order middle        = begin + (end - begin) * n_left / n_parts;
  std::nth_element(begin, middle, end,
                   [&](const unsigned int one, const unsigned int other) {
                     return std::make_pair(centres(one, axis), one) <
                            std::make_pair(centres(other, axis), other);
                   });
  cut(centres, begin, middle, first_part, n_left, part);
  cut(centres, middle, end, first_part + n_left, n_parts - n_left, part);
}
} // namespace

std::vector<unsigned int> parts_of(const meshes::TriangleMesh &mesh, const unsigned int n_parts)
{
  const auto n = static_cast<std::size_t>(mesh.n_triangles());
  Eigen::MatrixX2d centres(mesh.n_triangles(), 2);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    centres.row(t) =
      (mesh.vertices.row(mesh.triangles(t, 0)) + mesh.vertices.row(mesh.triangles(t, 1)) +
       mesh.vertices.row(mesh.triangles(t, 2))) /
      3.;
  std::vector<unsigned int> order(n), part(n);
  std::iota(order.begin(), order.end(), 0u);
  cut(centres, order.begin(), order.end(), 0, n_parts, part);
  return part;
}

NodeNumbers::NodeNumbers(const meshes::TriangleMesh &mesh, const meshes::TriangleSides &sides,
                         const unsigned int order, const std::vector<unsigned int> &parts,
                         const unsigned int n_parts)
{
  // The triangles of each part in their order: of one part all of them.
  std::vector<unsigned int> place(n_parts + 1, 0), by_part(parts.size());
  for (const unsigned int part : parts)
    ++place[part + 1];
  std::partial_sum(place.begin(), place.end(), place.begin());
  const std::vector<unsigned int> begin = place;
  for (std::size_t t = 0; t < parts.size(); ++t)
    by_part[place[parts[t]]++] = static_cast<unsigned int>(t);

  constexpr unsigned int unknown = std::numeric_limits<unsigned int>::max();
  of_vertex.assign(static_cast<std::size_t>(mesh.n_vertices()), unknown);
  of_side.assign(order == 2 ? static_cast<std::size_t>(sides.n()) : 0, unknown);
  unsigned int next = 0;
  const auto number = [&](unsigned int &node)
  {
    if (node == unknown)
      node = next++;
  };
  for (unsigned int part = 0; part < n_parts; ++part)
  {
    begin_of_part.push_back(next);
    for (unsigned int k = begin[part]; k < begin[part + 1]; ++k)
    {
      for (const int vertex : mesh.triangles.row(by_part[k]))
        number(of_vertex[static_cast<std::size_t>(vertex)]);
      if (order == 2)
        for (const int side : sides.of_triangle.row(by_part[k]))
          number(of_side[static_cast<std::size_t>(side)]);
    }
  }
  begin_of_part.push_back(next);
}
} // namespace homespun::homogenization
