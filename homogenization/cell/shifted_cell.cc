// SPDX-License-Identifier: MIT
#include "homogenization/cell/shifted_cell.h"

#include "homogenization/cell/lattice_triangles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

namespace homespun::homogenization
{
namespace
{
/// Levels that are tried: of lines of the mesh, and evenly between the holes.
constexpr std::size_t most_mesh_lines = 8;
constexpr double even_levels          = 24.;

/// Lines that meet no hole, with this distance from it, in parts of a lattice vector.
constexpr double clearance = 1e-6;

struct Interval
{
  double begin, end;
};

/// How far a rim reaches along an axis.
Interval extent(const Rim &rim, const int axis)
{
  Interval its{rim.reach[0](axis), rim.reach[0](axis)};
  for (const Eigen::RowVector2d &point : rim.reach)
    its = {std::min(its.begin, point(axis)), std::max(its.end, point(axis))};
  return its;
}

/// Where lines meet no rim, one period of it.
std::vector<Interval> free_intervals(const std::vector<Rim> &rims, const int axis)
{
  std::vector<Interval> taken;
  double reach = -1.; // of what is taken, from the period before
  for (const Rim &rim : rims)
  {
    Interval its        = extent(rim, axis);
    const double period = std::floor(its.begin);
    its                 = {its.begin - period - clearance, its.end - period + clearance};
    taken.push_back(its);
    reach = std::max(reach, its.end - 1.);
  }
  std::sort(taken.begin(), taken.end(),
            [](const Interval &a, const Interval &b) { return a.begin < b.begin; });
  std::vector<Interval> free;
  for (const Interval &its : taken)
  {
    if (its.begin > reach)
      free.push_back({reach, its.begin});
    reach = std::max(reach, its.end);
  }
  return free;
}

/// Levels to try, that of the given cell first, then lines of the mesh.
std::vector<double> levels_in(const LatticeTriangles &mesh, const std::vector<Interval> &free,
                              const int axis, const double given)
{
  const auto is_free = [&](const double level)
  {
    return std::any_of(free.begin(), free.end(),
                       [&](const Interval &its)
                       {
                         const double c = level - std::floor(level - its.begin);
                         return c < its.end;
                       });
  };
  std::vector<double> levels;
  if (is_free(given))
    levels.push_back(given);
  struct MeshLine
  {
    int n        = 0; // corners of triangles on it
    double level = 0.;
  };
  std::map<long, MeshLine> line_at; // in boxes of ten tolerances
  const double box = 10. * meshes::image_tolerance;
  for (const LatticeTriangle &triangle : mesh.triangles)
    for (const LatticeCorner &corner : triangle.corners)
    {
      const double c = mesh.places[static_cast<std::size_t>(corner.vertex)](axis);
      MeshLine &line = line_at[std::lround((c - std::floor(c)) / box)];
      if (line.n++ == 0)
        line.level = c;
    }
  std::vector<std::pair<int, double>> lines;
  for (const auto &[place, line] : line_at)
    if (is_free(line.level))
      lines.emplace_back(-line.n, line.level);
  std::stable_sort(lines.begin(), lines.end(),
                   [](const auto &a, const auto &b) { return a.first < b.first; });
  for (std::size_t k = 0; k < std::min(lines.size(), most_mesh_lines); ++k)
    levels.push_back(lines[k].second);
  double width = 0.;
  for (const Interval &its : free)
    width += its.end - its.begin;
  for (const Interval &its : free)
  {
    const double n = std::max(3., std::round(even_levels * (its.end - its.begin) / width));
    for (double k = 0.5; k < n; ++k)
      levels.push_back(its.begin + k / n * (its.end - its.begin));
  }
  return levels;
}

/// Which holes stand in the way of lines at a constant coordinate `axis`.
std::string obstacle_of(const std::vector<Rim> &rims, const int axis,
                        const meshes::Lattice &lattice)
{
  std::vector<std::pair<double, Eigen::RowVector2d>> holes; // width, centre
  for (const Rim &rim : rims)
  {
    Eigen::RowVector2d centre(0., 0.);
    for (const Eigen::RowVector2d &point : rim.points)
      centre += point / static_cast<double>(rim.points.size());
    const Interval its = extent(rim, axis);
    holes.emplace_back(its.end - its.begin, centre * lattice.vectors);
  }
  std::stable_sort(holes.begin(), holes.end(),
                   [](const auto &a, const auto &b) { return a.first > b.first; });
  const bool is_one      = holes[0].first >= 1. - 2. * clearance;
  const std::string mine = axis == 0 ? "a1" : "a2", other = axis == 0 ? "a2" : "a1";
  std::ostringstream text;
  text.precision(3);
  text << "every straight line along " << other << " meets a hole: ";
  for (std::size_t k = 0; k < (is_one ? 1 : std::min<std::size_t>(holes.size(), 3)); ++k)
    text << (k == 0 ? "the one around (" : ", that around (") << holes[k].second(0) << ", "
         << holes[k].second(1) << ") m reaches over " << holes[k].first << " of " << mine;
  if (!is_one && holes.size() > 3)
    text << ", and " << holes.size() - 3 << " more";
  return text.str();
}

/// Cuts along both axes, or says what is in the way.
CellCutAnew cut(LatticeTriangles cloth, const std::vector<Rim> &rims,
                const Eigen::RowVector2d &drawn)
{
  CellCutAnew result;
  Eigen::RowVector2d corner;
  std::string in_the_way;
  for (int axis = 0; axis < 2; ++axis)
  {
    const std::vector<Interval> free = free_intervals(rims, axis);
    if (free.empty())
    {
      in_the_way += (in_the_way.empty() ? "" : "; ") + obstacle_of(rims, axis, cloth.lattice);
      continue;
    }
    auto line = cut_along(cloth, axis, levels_in(cloth, free, axis, drawn(axis)));
    if (!line)
      in_the_way += std::string(in_the_way.empty() ? "" : "; ") +
                    "curved sides of triangles touch every line along " +
                    (axis == 0 ? "a2" : "a1") + " that was tried";
    else
    {
      cloth        = std::move(line->mesh);
      corner(axis) = line->level;
    }
  }
  if (!in_the_way.empty())
  {
    result.obstacle =
      "the outline cuts holes, and the cell cannot be cut from the cloth at another "
      "place: " +
      in_the_way +
      ". No sheet can be cut either; C^H and `periodic` are of the cloth as it is drawn"
      "; expected a straight line along each lattice vector that meets no hole: "
      "draw the cell along other `Lattice vectors` of the same cloth between whose "
      "lines the holes lie, or fill the holes with a soft phase";
    return result;
  }
  result.mesh = unfolded_at(cloth, corner, result.curved_sides);
  CellShift shift;
  for (int axis = 0; axis < 2; ++axis)
  {
    const double part = corner(axis) - drawn(axis);
    shift.parts(axis) = part - std::floor(part + meshes::image_tolerance);
  }
  shift.metres = shift.parts * cloth.lattice.vectors;
  result.shift = shift;
  return result;
}
} // namespace

std::string sentence_of(const CellShift &shift)
{
  std::ostringstream text;
  text.precision(4);
  text
    << "the outline of the mesh cuts holes: the cell is cut from the cloth " << shift.parts(0)
    << " a1 + " << shift.parts(1) << " a2 = (" << shift.metres(0) << ", " << shift.metres(1)
    << ") m away from where it is drawn, where its holes lie inside; all results are of the cell "
       "there";
  return text.str();
}

CellCutAnew cut_anew(const meshes::TriangleMesh &mesh, const Eigen::VectorXi &group,
                     const std::vector<CurvedSide> &curved_sides, const meshes::Lattice &lattice)
{
  auto cloth = glued_with_rims(mesh, lattice, group, curved_sides);
  if (!cloth)
    throw std::logic_error("cut_anew() of a mesh whose triangles do not lie side by side");
  const std::vector<Rim> rims = rims_of(*cloth);
  Eigen::RowVector2d drawn    = lattice.fractional(mesh.vertices.row(0));
  for (int v = 0; v < mesh.n_vertices(); ++v)
    drawn = drawn.cwiseMin(lattice.fractional(mesh.vertices.row(v)));
  return cut(std::move(*cloth), rims, drawn);
}
} // namespace homespun::homogenization
