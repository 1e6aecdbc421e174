// SPDX-License-Identifier: MIT
// Whether the phases of a cell go on across its sides: where the border between two phases meets a
// side, the repeated cell must have one at the same place of the opposite side.
#include "homogenization/lint/cell_lint.h"
#include "meshes/plain/index.h"
#include "meshes/plain/vertex_images.h"

#include <algorithm>
#include <map>
#include <sstream>

namespace homespun::homogenization
{
using meshes::at;

namespace
{
constexpr int most_told = 3;

/// The group of the triangle at each directed edge.
std::map<std::pair<int, int>, int> groups_at_edges(const UnitCell &cell)
{
  const std::vector<int> group_of_phase = cell.group_of_phase();
  std::map<std::pair<int, int>, int> groups;
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      groups[{cell.mesh.triangles(t, k), cell.mesh.triangles(t, (k + 1) % 3)}] =
        group_of_phase[static_cast<std::size_t>(cell.mesh.material(t))];
  return groups;
}
} // namespace

std::vector<Finding> lint_continuity(const UnitCell &cell, const double metres_per_unit)
{
  if (cell.lattice.cuts_holes)
    return {}; // a phase may end at a hole there
  const std::vector<int> outer = meshes::outline(cell.mesh);
  const auto groups            = groups_at_edges(cell);
  const std::size_t n          = outer.size();
  std::vector<char> is_border(at(cell.mesh.n_vertices())); // between two phases along the outline
  for (std::size_t k = 0; k < n; ++k)
  {
    const auto before = groups.find({outer[(k + n - 1) % n], outer[k]}),
               after  = groups.find({outer[k], outer[(k + 1) % n]});
    is_border[at(outer[k])] =
      before != groups.end() && after != groups.end() && before->second != after->second;
  }
  // Corners belong to two pairs of sides, each of which may be a border by itself.
  const meshes::ImageClasses classes = meshes::match_images(cell.mesh, outer, cell.lattice);
  std::vector<Finding> findings;
  int n_found = 0;
  for (const int v : outer)
  {
    const int first = classes.representative[at(v)];
    if (first == v || classes.size[at(v)] != 2 || is_border[at(v)] == is_border[at(first)] ||
        ++n_found > most_told)
      continue;
    const int vertex = is_border[at(v)] ? v : first, image = is_border[at(v)] ? first : v;
    const Eigen::RowVector2d x = cell.mesh.vertices.row(vertex) / metres_per_unit,
                             y = cell.mesh.vertices.row(image) / metres_per_unit;
    std::ostringstream what;
    what << "a phase does not continue across the sides: vertex " << vertex << " at (" << x(0)
         << ", " << x(1) << ") lies between two phases, and its image, vertex " << image << " at ("
         << y(0) << ", " << y(1) << "), within one";
    findings.push_back({Severity::warning,
                        "phase ends",
                        what.str(),
                        "expected the border of a phase at both, unless the phase ends there: draw "
                        "both sides alike, or check which group the triangles have",
                        {cell.mesh.vertices.row(vertex), -1, vertex}});
  }
  if (n_found > most_told)
    findings.push_back({Severity::warning,
                        "phase ends",
                        "and " + std::to_string(n_found - most_told) + " more such places",
                        "",
                        {}});
  return findings;
}
} // namespace homespun::homogenization
