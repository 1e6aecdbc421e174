// SPDX-License-Identifier: MIT
#include "meshes/fine_cloth.h"

#include "meshes/cloth_faults.h"
#include "meshes/cut_mesh.h"
#include "meshes/errors.h"
#include "meshes/point_location.h"
#include "meshes/seams.h"
#include "meshes/sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <sstream>
#include <unordered_map>

namespace homespun::meshes
{
namespace
{
constexpr double sliver = 1e-12; // of the cell's area

double cross(const Eigen::RowVector2d &a, const Eigen::RowVector2d &b)
{
  return a(0) * b(1) - a(1) * b(0);
}

/// What a conflict of the outline means to whoever drew the panel.
[[noreturn]] void refuse_outline(const std::size_t panel, const Eigen::RowVector2d &x)
{
  std::ostringstream text;
  text << "fine cloth: the outline of panel " << panel
       << " is at odds with itself near the rest point (" << x(0) << ", " << x(1)
       << ") m; expected a panel that does not overlap itself at rest, without details below a "
          "millionth of a cell: unwrap it without overlaps";
  throw BadInput(text.str());
}

std::size_t at(const Eigen::Index index)
{
  return static_cast<std::size_t>(index);
}

/// A panel: its outline, and the sheet of cells that covers it. Coordinates are local: they count from a
/// lattice point next to the panel, so that no digits are lost where the rest coordinates are large.
struct Panel
{
  Eigen::RowVector2d base;       ///< local zero in rest coordinates [m]
  std::vector<int> triangles;    ///< of the coarse cloth
  std::vector<Side> outline;     ///< open sides at rest
  std::map<int, int> point_of;   ///< rest vertex on the outline to point of `cut`
  double area = 0.;              ///< [m^2]
  Sheet sheet;                   ///< vertices in local coordinates
  std::vector<int> whole;        ///< triangles of the sheet far from the outline, inside
  std::vector<int> cut_vertex;   ///< of each vertex of the sheet, −1: not near the outline
  std::vector<int> sheet_vertex; ///< of the first vertices of `cut`
  std::unique_ptr<CutMesh> cut;
};

/// A triangle that stays: corners in the numbering of a panel, vertices of the sheet first, then those of
/// the cut mesh that it has not got from there.
struct Kept
{
  std::array<int, 3> corners;
  int parent; ///< triangle of the sheet
};

/// Whether a segment may come into a box: their boxes meet, and the box is not on one side of the line.
bool may_meet(const Eigen::RowVector2d &from, const Eigen::RowVector2d &to,
              const Eigen::RowVector2d &low, const Eigen::RowVector2d &high)
{
  if ((from.cwiseMax(to).array() < low.array()).any() ||
      (from.cwiseMin(to).array() > high.array()).any())
    return false;
  const Eigen::RowVector2d span = to - from;
  int n_left                    = 0;
  for (const double x : {low(0), high(0)})
    for (const double y : {low(1), high(1)})
      n_left += cross(span, Eigen::RowVector2d(x, y) - from) > 0. ? 1 : 0;
  return n_left != 0 && n_left != 4;
}

/// The outlines and the local coordinates; no fine mesh yet.
std::vector<Panel> outlines_of(const ClothMesh &cloth, const Panels &panels)
{
  std::vector<Panel> all(at(panels.count));
  std::map<std::array<int, 2>, int> owners;
  for (int t = 0; t < cloth.n_triangles(); ++t)
  {
    all[at(panels.of_triangle(t))].triangles.push_back(t);
    for (int k = 0; k < 3; ++k)
    {
      auto ends = rest_ends(cloth, {t, k});
      std::sort(ends.begin(), ends.end());
      ++owners[ends];
    }
  }
  for (int t = 0; t < cloth.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      auto ends = rest_ends(cloth, {t, k});
      std::sort(ends.begin(), ends.end());
      if (owners[ends] == 1)
        all[at(panels.of_triangle(t))].outline.push_back({t, k});
    }
  return all;
}

/// Lays the sheet of cells over a panel.
void cover(Panel &panel, const TriangleMesh &cell_mesh, const Lattice &lattice,
           const ClothMesh &cloth, const Grain &grain)
{
  const Eigen::Matrix2d rotation = grain.rotation();
  Eigen::RowVector2d low, high;
  low.setConstant(std::numeric_limits<double>::infinity());
  high = -low;
  for (const Side &side : panel.outline)
  {
    const Eigen::RowVector2d point = cloth.rest.vertices.row(rest_ends(cloth, side)[0]);
    const Eigen::RowVector2d f     = lattice.fractional((point - grain.origin) * rotation);
    low                            = low.cwiseMin(f);
    high                           = high.cwiseMax(f);
  }
  // At least a thousandth of a cell around the panel, so that its outline has triangles on both sides.
  const Eigen::RowVector2d first = (low.array() - 1e-3).floor(),
                           last  = (high.array() + 1e-3).ceil();
  const Eigen::RowVector2d n     = last - first;
  if (n(0) * n(1) * cell_mesh.n_triangles() > 5e8)
  {
    std::ostringstream text;
    text
      << "fine cloth: a panel spans " << n(0) << " x " << n(1) << " cells of "
      << cell_mesh.n_triangles()
      << " triangles; expected at most 5e8 triangles: is vt in metres? else take fewer cells or a "
         "coarser cell";
    throw BadInput(text.str());
  }
  panel.base  = grain.origin + first * lattice.vectors * rotation.transpose();
  panel.sheet = tile(cell_mesh, lattice, static_cast<int>(n(0)), static_cast<int>(n(1)));
  panel.sheet.mesh.vertices =
    ((panel.sheet.mesh.vertices.rowwise() - panel.sheet.origin) * rotation.transpose()).eval();
}

/// Sorts the triangles of the sheet: far inside, far outside, near the outline; and cuts the last.
void clip(Panel &panel, const Lattice &lattice, const ClothMesh &cloth, const Grain &grain,
          const PointLocation &location)
{
  const double side              = std::sqrt(lattice.area());
  const Eigen::Matrix2d rotation = grain.rotation();
  std::vector<Eigen::RowVector2d> points;
  std::vector<std::array<int, 2>> edges;
  for (const Side &open : panel.outline)
  {
    std::array<int, 2> edge{};
    for (std::size_t end = 0; end < 2; ++end)
    {
      const int v                = rest_ends(cloth, open)[end];
      const auto [place, is_new] = panel.point_of.emplace(v, static_cast<int>(points.size()));
      if (is_new)
        points.push_back(cloth.rest.vertices.row(v) - panel.base);
      edge[end] = place->second;
    }
    edges.push_back(edge);
  }
  panel.cut = std::make_unique<CutMesh>(points, edges, outline_tolerance * side);
  panel.cut_vertex.assign(at(panel.sheet.mesh.n_vertices()), -1);

  // Edges of the outline by cells, in units of the lattice.
  const int n1 = panel.sheet.n1, n2 = panel.sheet.n2;
  std::vector<std::vector<int>> edges_of_cell(at(n1) * at(n2));
  const double margin = 1e-3;
  for (std::size_t e = 0; e < edges.size(); ++e)
  {
    const Eigen::RowVector2d from = lattice.fractional(points[at(edges[e][0])] * rotation),
                             to   = lattice.fractional(points[at(edges[e][1])] * rotation);
    const Eigen::RowVector2d low  = (from.cwiseMin(to).array() - margin).floor(),
                             high = (from.cwiseMax(to).array() + margin).floor();
    for (int j = std::max(0, static_cast<int>(low(1)));
         j <= std::min(n2 - 1, static_cast<int>(high(1))); ++j)
      for (int i = std::max(0, static_cast<int>(low(0)));
           i <= std::min(n1 - 1, static_cast<int>(high(0))); ++i)
        if (may_meet(from, to, Eigen::RowVector2d(i - margin, j - margin),
                     Eigen::RowVector2d(i + 1 + margin, j + 1 + margin)))
          edges_of_cell[at(j) * at(n1) + at(i)].push_back(static_cast<int>(e));
  }

  const auto holds = [&](const Eigen::RowVector2d &point) {
    return location.locate(point, {0., 0.}).triangle >= 0;
  };
  const TriangleMesh &mesh = panel.sheet.mesh;
  const int n_per_cell     = mesh.n_triangles() / (n1 * n2);
  const Eigen::RowVector2d room =
    Eigen::RowVector2d::Constant(10. * outline_tolerance * side); // more than a vertex moves
  for (int cell = 0; cell < n1 * n2; ++cell)
  {
    const std::vector<int> &candidates = edges_of_cell[at(cell)];
    const Eigen::RowVector2d middle =
      Eigen::RowVector2d(cell % n1 + 0.5, cell / n1 + 0.5) * lattice.vectors * rotation.transpose();
    if (candidates.empty() && !holds(middle))
      continue;
    for (int t = cell * n_per_cell; t < (cell + 1) * n_per_cell; ++t)
    {
      const Eigen::RowVector2d x0 = mesh.vertices.row(mesh.triangles(t, 0)),
                               x1 = mesh.vertices.row(mesh.triangles(t, 1)),
                               x2 = mesh.vertices.row(mesh.triangles(t, 2));
      std::vector<int> near;
      for (const int e : candidates)
        if (may_meet(points[at(edges[at(e)][0])], points[at(edges[at(e)][1])],
                     x0.cwiseMin(x1).cwiseMin(x2) - room, x0.cwiseMax(x1).cwiseMax(x2) + room))
          near.push_back(e);
      if (near.empty())
      {
        if (candidates.empty() || holds((x0 + x1 + x2) / 3.))
          panel.whole.push_back(t);
        continue;
      }
      std::array<int, 3> corners{};
      for (int k = 0; k < 3; ++k)
      {
        const int v = mesh.triangles(t, k);
        int &index  = panel.cut_vertex[at(v)];
        if (index < 0)
        {
          index = panel.cut->add_vertex(mesh.vertices.row(v));
          panel.sheet_vertex.push_back(v);
        }
        corners[at(k)] = index;
      }
      panel.cut->add_triangle(corners, t, std::move(near));
    }
  }
  panel.cut->cut();
}

/// Gives both sides of every seam the same points: those of either side, at the same part of the coarse
/// edge. Points nearer than the tolerance become one.
void match_seams(std::vector<Panel> &panels, const std::vector<SeamEdge> &seams,
                 const ClothMesh &cloth, const Panels &membership,
                 const std::map<std::array<int, 2>, int> &edge_of_side, const double tolerance)
{
  for (const SeamEdge &seam : seams)
  {
    std::array<CutMesh *, 2> mesh{};
    std::array<int, 2> edge{};
    std::array<std::vector<int>, 2> chain;
    double length = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 2; ++i)
    {
      const Side &side = seam.sides[i];
      const auto ends  = rest_ends(cloth, side);
      mesh[i]          = panels[at(membership.of_triangle(side.triangle))].cut.get();
      edge[i]          = edge_of_side.at({side.triangle, side.side});
      chain[i]         = mesh[i]->along(edge[i]);
      length           = std::min(
                  length, (cloth.rest.vertices.row(ends[1]) - cloth.rest.vertices.row(ends[0])).norm());
    }
    std::reverse(chain[1].begin(), chain[1].end());
    const auto part = [&](const std::size_t i, const std::size_t k)
    {
      const double own = mesh[i]->part_of(chain[i][k], edge[i]);
      return i == 0 ? own : 1. - own;
    };
    const auto split = [&](const std::size_t i, const std::size_t after, const double where)
    {
      const int v =
        i == 0 ? mesh[0]->split_outline(edge[0], chain[0][after - 1], chain[0][after], where)
               : mesh[1]->split_outline(edge[1], chain[1][after - 1], chain[1][after], 1. - where);
      chain[i].insert(chain[i].begin() + static_cast<long>(after), v);
    };
    // Both chains begin and end with the coarse vertices, which are the same in space.
    std::size_t k = 1;
    while (k + 1 < std::max(chain[0].size(), chain[1].size()))
    {
      const bool first_is_done  = k + 1 >= chain[0].size(),
                 second_is_done = k + 1 >= chain[1].size();
      const double first        = first_is_done ? 1. : part(0, k),
                   second       = second_is_done ? 1. : part(1, k);
      if (!first_is_done && !second_is_done && std::abs(first - second) * length <= tolerance)
        mesh[1]->slide(chain[1][k], edge[1], 1. - first);
      else if (second_is_done || (!first_is_done && first < second))
        split(1, k, first);
      else
        split(0, k, second);
      ++k;
    }
  }
}

/// The triangles of a panel that stay, and what was lost.
std::vector<Kept> kept_triangles(const Panel &panel, const std::size_t index,
                                 const double cell_area, const PointLocation &location,
                                 FineCloth &fine)
{
  const TriangleMesh &sheet = panel.sheet.mesh;
  const CutMesh &cut        = *panel.cut;
  std::vector<Kept> kept;
  for (const int t : panel.whole)
    kept.push_back({{sheet.triangles(t, 0), sheet.triangles(t, 1), sheet.triangles(t, 2)}, t});

  std::vector<int> sides;
  try
  {
    sides = cut.sides_of_outline();
  }
  catch (const CutMesh::Conflict &conflict)
  {
    refuse_outline(index, conflict.x + panel.base);
  }
  struct Fate
  {
    int n_inside = 0, n_outside = 0;
    bool is_slit = false;
  };
  std::map<int, Fate> fates; // of triangles of the sheet
  for (std::size_t t = 0; t < cut.triangles.size(); ++t)
  {
    const CutMesh::Triangle &triangle = cut.triangles[t];
    if (sides[t] < 0)
    {
      Eigen::RowVector2d middle = Eigen::RowVector2d::Zero();
      for (const int v : triangle.corners)
        middle += cut.vertices[at(v)].x / 3.;
      sides[t] = location.locate(middle, {0., 0.}).triangle >= 0 ? 1 : 0;
    }
    Fate &fate = fates[triangle.parent];
    ++(sides[t] == 1 ? fate.n_inside : fate.n_outside);
  }
  for (std::size_t t = 0; t < cut.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto &triangle = cut.triangles[t];
      const int a = triangle.corners[k], b = triangle.corners[(k + 1) % 3],
                other = cut.triangle_left_of(b, a);
      if (other >= 0 && cut.triangles[at(other)].parent == triangle.parent &&
          !cut.common_edges(a, b).empty())
        fates[triangle.parent].is_slit = true;
    }
  const auto corner_of = [&](const int v) {
    return at(v) < panel.sheet_vertex.size() ? panel.sheet_vertex[at(v)] : sheet.n_vertices() + v;
  };
  for (auto &[parent, fate] : fates)
    if (fate.n_inside > 0 && (fate.n_outside > 0 || fate.is_slit))
      ++fine.n_cut;
    else if (fate.n_inside > 0 && fine.outline == Outline::whole)
      kept.push_back(
        {{sheet.triangles(parent, 0), sheet.triangles(parent, 1), sheet.triangles(parent, 2)},
         parent});
  if (fine.outline == Outline::whole)
    return kept;
  for (std::size_t t = 0; t < cut.triangles.size(); ++t)
  {
    if (sides[t] != 1)
      continue;
    const auto [a, b, c] = cut.triangles[t].corners;
    const double area    = 0.5 * cross(cut.vertices[at(b)].x - cut.vertices[at(a)].x,
                                       cut.vertices[at(c)].x - cut.vertices[at(a)].x);
    if (area < sliver * cell_area)
      ++fine.n_slivers;
    else
      kept.push_back({{corner_of(a), corner_of(b), corner_of(c)}, cut.triangles[t].parent});
  }
  return kept;
}

/// What is collected of the fine vertices, panel by panel.
struct Collected
{
  std::vector<Eigen::RowVector2d> x; ///< rest coordinates
  std::vector<int> panel, cell_vertex, cell_triangle, coarse_triangle, material;
  std::vector<Eigen::RowVector3d> cell_weights, coarse_weights;
  std::vector<double> seam_distance;
  std::vector<std::array<int, 3>> triangles;
  /// Fine vertices along an open side, by their part.
  std::map<std::array<int, 2>, std::vector<std::pair<double, int>>> along_side;
};

/// Distances to the seams of one panel, by buckets of the size of the reach.
class SeamDistance
{
public:
  SeamDistance(std::vector<std::array<Eigen::RowVector2d, 2>> segments, const double reach)
      : segments(std::move(segments))
      , reach(reach)
  {
    for (std::size_t s = 0; s < this->segments.size(); ++s)
    {
      const auto &[from, to] = this->segments[s];
      const int n            = 1 + static_cast<int>((to - from).norm() / (0.5 * reach));
      for (int k = 0; k <= n; ++k)
      {
        const auto [i, j] = bucket(from + k / static_cast<double>(n) * (to - from));
        for (int dj = -2; dj <= 2; ++dj)
          for (int di = -2; di <= 2; ++di)
          {
            std::vector<int> &members = buckets[{i + di, j + dj}];
            if (members.empty() || members.back() != static_cast<int>(s))
              members.push_back(static_cast<int>(s));
          }
      }
    }
  }

  double operator()(const Eigen::RowVector2d &x) const
  {
    double nearest   = std::numeric_limits<double>::infinity();
    const auto found = buckets.find(bucket(x));
    if (found == buckets.end())
      return nearest;
    for (const int s : found->second)
    {
      const auto &[from, to] = segments[at(s)];
      const double part = std::clamp((x - from).dot(to - from) / (to - from).squaredNorm(), 0., 1.);
      nearest           = std::min(nearest, (x - from - part * (to - from)).norm());
    }
    return nearest <= reach ? nearest : std::numeric_limits<double>::infinity();
  }

private:
  std::array<int, 2> bucket(const Eigen::RowVector2d &x) const
  {
    return {static_cast<int>(std::floor(x(0) / reach)), static_cast<int>(std::floor(x(1) / reach))};
  }

  std::vector<std::array<Eigen::RowVector2d, 2>> segments;
  double reach;
  std::map<std::array<int, 2>, std::vector<int>> buckets;
};

/// The vertices of a cut mesh that lie on the outline, split into fans: triangles around a vertex that
/// reach each other without crossing the outline share a vertex, others do not.
/// @param fans_of_corner for each kept triangle and corner: number of its fan, 0 for the first
void fans_of(const Panel &panel, const std::vector<Kept> &kept,
             std::vector<std::array<int, 3>> &fans_of_corner)
{
  const CutMesh &cut = *panel.cut;
  const int n_sheet  = panel.sheet.mesh.n_vertices();
  const auto cut_of  = [&](const int corner)
  { return corner < n_sheet ? panel.cut_vertex[at(corner)] : corner - n_sheet; };
  fans_of_corner.assign(kept.size(), {0, 0, 0});
  std::map<int, std::vector<std::pair<std::size_t, std::size_t>>> around; // by vertex of `cut`
  for (std::size_t t = 0; t < kept.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (const int v = cut_of(kept[t].corners[k]); v >= 0 && !cut.vertices[at(v)].outline.empty())
        around[v].emplace_back(t, k);
  for (const auto &[v, corners] : around)
  {
    std::vector<std::size_t> fan(corners.size());
    std::iota(fan.begin(), fan.end(), 0u);
    // A handful of triangles: merge until nothing changes.
    for (bool changed = true; changed;)
    {
      changed = false;
      for (std::size_t p = 0; p < corners.size(); ++p)
        for (std::size_t q = 0; q < p; ++q)
        {
          if (fan[p] == fan[q])
            continue;
          const auto &[t, k] = corners[p];
          const auto &[s, l] = corners[q];
          // Around a vertex, neighbours share the corner after it in one and before it in the other.
          for (const auto &[here, there] :
               {std::pair<int, int>{kept[t].corners[(k + 1) % 3], kept[s].corners[(l + 2) % 3]},
                std::pair<int, int>{kept[t].corners[(k + 2) % 3], kept[s].corners[(l + 1) % 3]}})
          {
            const int w = cut_of(here);
            if (here == there && (w < 0 || cut.common_edges(v, w).empty()))
            {
              fan[p] = fan[q] = std::min(fan[p], fan[q]);
              changed         = true;
            }
          }
        }
    }
    std::map<std::size_t, int> number;
    for (std::size_t p = 0; p < corners.size(); ++p)
      fans_of_corner[corners[p].first][corners[p].second] =
        number.emplace(fan[p], static_cast<int>(number.size())).first->second;
  }
}

void collect(const Panel &panel, const int index, const std::vector<Kept> &kept,
             const TriangleMesh &cell_mesh, const PointLocation &location,
             const SeamDistance &seam_distance, const Eigen::RowVector2d &towards, Collected &fine)
{
  const CutMesh &cut        = *panel.cut;
  const TriangleMesh &sheet = panel.sheet.mesh;
  const int n_sheet         = sheet.n_vertices();
  const auto cut_of         = [&](const int corner)
  { return corner < n_sheet ? panel.cut_vertex[at(corner)] : corner - n_sheet; };
  std::vector<std::array<int, 3>> fans;
  fans_of(panel, kept, fans);

  std::vector<int> first_copy(at(n_sheet) + cut.vertices.size(), -1); // fine vertex of fan 0
  std::map<std::array<int, 2>, int> other_copies;                     // of fans 1, 2, ...
  for (std::size_t t = 0; t < kept.size(); ++t)
  {
    std::array<int, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      const int corner = kept[t].corners[k], v = cut_of(corner), fan = fans[t][k];
      int &vertex = fan == 0
                      ? first_copy[at(corner)]
                      : other_copies.emplace(std::array<int, 2>{corner, fan}, -1).first->second;
      if (vertex < 0)
      {
        vertex = static_cast<int>(fine.x.size());
        const Eigen::RowVector2d x =
          v >= 0 ? cut.vertices[at(v)].x : Eigen::RowVector2d(sheet.vertices.row(corner));
        fine.x.push_back(x + panel.base);
        fine.panel.push_back(index);
        fine.seam_distance.push_back(seam_distance(x));
        fine.cell_vertex.push_back(corner < n_sheet ? panel.sheet.cell_vertex(corner) : -1);
        fine.cell_triangle.push_back(-1);
        fine.cell_weights.push_back({0., 0., 0.});
        if (corner >= n_sheet)
        {
          const int parent            = cut.vertices[at(v)].parent;
          const Eigen::RowVector2d x0 = sheet.vertices.row(sheet.triangles(parent, 0)),
                                   e1 = sheet.vertices.row(sheet.triangles(parent, 1)) - x0,
                                   e2 = sheet.vertices.row(sheet.triangles(parent, 2)) - x0;
          const double b1             = cross(x - x0, e2) / cross(e1, e2),
                       b2             = cross(e1, x - x0) / cross(e1, e2);
          fine.cell_triangle.back()   = parent % cell_mesh.n_triangles();
          fine.cell_weights.back() << 1. - b1 - b2, b1, b2;
        }
        fine.coarse_triangle.push_back(-1);
        fine.coarse_weights.push_back({0., 0., 0.});
        if (v < 0 || cut.vertices[at(v)].outline.empty())
        {
          const Location found        = location.locate(x, towards);
          fine.coarse_triangle.back() = found.triangle;
          fine.coarse_weights.back()  = found.weights.transpose();
          if (found.triangle < 0)
            throw std::logic_error(
              "fine cloth: a vertex inside a panel lies in no coarse triangle");
        }
      }
      corners[k] = vertex;
    }
    fine.triangles.push_back(corners);
    fine.material.push_back(sheet.material(kept[t].parent));

    // Where the triangle has a side on the outline, that tells which coarse triangle its vertices belong to.
    const auto put = [&](const std::size_t k, const int edge)
    {
      const Side &side                     = panel.outline[at(edge)];
      const double part                    = cut.part_of(cut_of(kept[t].corners[k]), edge);
      fine.coarse_triangle[at(corners[k])] = side.triangle;
      fine.coarse_weights[at(corners[k])].setZero();
      fine.coarse_weights[at(corners[k])](side.side)           = 1. - part;
      fine.coarse_weights[at(corners[k])]((side.side + 1) % 3) = part;
      return part;
    };
    for (std::size_t k = 0; k < 3; ++k)
    {
      const int a = cut_of(kept[t].corners[k]), b = cut_of(kept[t].corners[(k + 1) % 3]);
      if (a < 0)
        continue;
      if (fine.coarse_triangle[at(corners[k])] < 0)
        put(k, cut.vertices[at(a)].outline.front().edge);
      if (b < 0)
        continue;
      for (const int edge : cut.common_edges(a, b))
        if (cut.part_of(a, edge) < cut.part_of(b, edge))
        {
          const Side &side = panel.outline[at(edge)];
          auto &chain      = fine.along_side[{side.triangle, side.side}];
          chain.emplace_back(put(k, edge), corners[k]);
          chain.emplace_back(put((k + 1) % 3, edge), corners[(k + 1) % 3]);
        }
    }
  }
}

/// The first of all vertices that a seam sews together.
Eigen::VectorXi sewn(Collected &fine, const std::vector<SeamEdge> &seams)
{
  Eigen::VectorXi first = Eigen::VectorXi::LinSpaced(static_cast<Eigen::Index>(fine.x.size()), 0,
                                                     static_cast<int>(fine.x.size()) - 1);
  const auto root       = [&](int v)
  {
    while (first(v) != v)
      v = first(v) = first(first(v));
    return v;
  };
  for (auto &[side, chain] : fine.along_side)
  {
    std::sort(chain.begin(), chain.end());
    chain.erase(std::unique(chain.begin(), chain.end()), chain.end());
  }
  for (const SeamEdge &seam : seams)
  {
    const auto here  = fine.along_side.find({seam.sides[0].triangle, seam.sides[0].side});
    const auto there = fine.along_side.find({seam.sides[1].triangle, seam.sides[1].side});
    if (here == fine.along_side.end() || there == fine.along_side.end())
      continue;
    auto partner = there->second.rbegin();
    for (const auto &[part, v] : here->second)
    {
      while (partner != there->second.rend() && 1. - partner->first < part - 1e-12)
        ++partner;
      if (partner == there->second.rend() || std::abs(1. - partner->first - part) > 1e-12)
        continue;
      const int a = root(v), b = root(partner->second);
      first(std::max(a, b)) = std::min(a, b);
    }
  }
  for (int v = 0; v < first.size(); ++v)
    first(v) = root(v);
  return first;
}

template <int columns, typename Row>
Eigen::Matrix<double, Eigen::Dynamic, columns, Eigen::RowMajor>
stacked(const std::vector<Row> &rows)
{
  Eigen::Matrix<double, Eigen::Dynamic, columns, Eigen::RowMajor> matrix(
    static_cast<Eigen::Index>(rows.size()), columns);
  for (std::size_t k = 0; k < rows.size(); ++k)
    matrix.row(static_cast<Eigen::Index>(k)) = rows[k];
  return matrix;
}

Eigen::VectorXi vector_of(const std::vector<int> &numbers)
{
  return Eigen::Map<const Eigen::VectorXi>(numbers.data(),
                                           static_cast<Eigen::Index>(numbers.size()));
}
} // namespace

Eigen::Matrix2d Grain::rotation() const
{
  Eigen::Matrix2d matrix;
  matrix << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return matrix;
}

Triangles FineCloth::sewn_triangles() const
{
  return rest.triangles.unaryExpr([&](const int v) { return same_in_space(v); });
}

FineCloth fine_cloth(const TriangleMesh &cell_mesh, const Lattice &lattice, const ClothMesh &cloth,
                     const FineClothOptions &options)
{
  if (auto faults = cloth_faults(cloth, "fine cloth"); !faults.empty())
    throw BadInput(std::move(faults));
  const Panels membership = panels_of(cloth);
  if (options.grains.size() != 1 && options.grains.size() != at(membership.count))
    throw BadInput("fine cloth: found " + std::to_string(options.grains.size()) +
                   " grains; expected 1, or " + std::to_string(membership.count) +
                   ", one per panel");
  const auto grain_of = [&](const std::size_t p)
  { return options.grains[options.grains.size() == 1 ? 0 : p]; };
  for (std::size_t p = 0; p < options.grains.size(); ++p)
    if (!options.grains[p].origin.allFinite() || !std::isfinite(options.grains[p].angle))
      throw BadInput("fine cloth: grain " + std::to_string(p) +
                     " has an origin or an angle that is not a finite number");

  std::vector<Panel> panels         = outlines_of(cloth, membership);
  const std::vector<SeamEdge> seams = seam_edges(cloth);
  const double cell_area = lattice.area(), side = std::sqrt(cell_area);
  std::map<std::array<int, 2>, int> edge_of_side;
  std::vector<PointLocation> locations;
  for (std::size_t p = 0; p < panels.size(); ++p)
  {
    Panel &panel = panels[p];
    cover(panel, cell_mesh, lattice, cloth, grain_of(p));
    // The panel's triangles in its local coordinates.
    TriangleMesh local = cloth.rest;
    local.vertices.rowwise() -= panel.base;
    const Eigen::VectorXd areas = signed_areas(local);
    for (const int t : panel.triangles)
      panel.area += areas(t);
    locations.emplace_back(local, panel.triangles);
    try
    {
      clip(panel, lattice, cloth, grain_of(p), locations.back());
    }
    catch (const CutMesh::Conflict &conflict)
    {
      refuse_outline(p, conflict.x + panel.base);
    }
    for (std::size_t e = 0; e < panel.outline.size(); ++e)
      edge_of_side[{panel.outline[e].triangle, panel.outline[e].side}] = static_cast<int>(e);
  }
  FineCloth fine;
  fine.lattice = lattice;
  fine.outline = options.outline;
  if (options.outline == Outline::clipped)
    match_seams(panels, seams, cloth, membership, edge_of_side, outline_tolerance * side);

  Collected collected;
  for (std::size_t p = 0; p < panels.size(); ++p)
  {
    const Panel &panel = panels[p];
    fine.grains.push_back(grain_of(p));
    std::vector<std::array<Eigen::RowVector2d, 2>> segments;
    for (const SeamEdge &seam : seams)
      for (const Side &sewn_side : seam.sides)
        if (membership.of_triangle(sewn_side.triangle) == static_cast<int>(p))
        {
          const auto ends = rest_ends(cloth, sewn_side);
          segments.push_back({cloth.rest.vertices.row(ends[0]) - panel.base,
                              cloth.rest.vertices.row(ends[1]) - panel.base});
        }
    const std::vector<Kept> kept = kept_triangles(panel, p, cell_area, locations[p], fine);
    const std::size_t before     = collected.triangles.size();
    // Points on a coarse edge belong to the triangle at their upper right, as in the Upsampler.
    const Eigen::RowVector2d towards = 1e-5 * Eigen::RowVector2d(2. / 3., 1. / 3.) *
                                       lattice.vectors * grain_of(p).rotation().transpose();
    collect(panel, static_cast<int>(p), kept, cell_mesh, locations[p],
            SeamDistance(std::move(segments), seam_reach * side), towards, collected);
    double covered = 0.;
    for (std::size_t t = before; t < collected.triangles.size(); ++t)
    {
      const auto [a, b, c] = collected.triangles[t];
      covered += 0.5 * cross(collected.x[at(b)] - collected.x[at(a)],
                             collected.x[at(c)] - collected.x[at(a)]);
    }
    // A cover that misses or repeats a millionth means an outline that crosses itself.
    if (covered > (1. + 1e-6) * panel.area ||
        (options.outline == Outline::clipped && covered < (1. - 1e-6) * panel.area))
    {
      std::ostringstream text;
      text
        << "fine cloth: panel " << p << " has an area of " << panel.area
        << " m^2 and its fine triangles one of " << covered
        << " m^2; expected the same: the panel overlaps itself at rest: unwrap it without overlaps";
      throw BadInput(text.str());
    }
    fine.area_lost += panel.area - covered;
  }
  if (collected.triangles.empty())
    throw BadInput(
      "fine cloth: no triangle of the cell lies wholly inside a panel; expected panels "
      "larger than the cell's triangles: is vt in metres? or clip the outline");
  fine.rest.vertices = stacked<2>(collected.x);
  fine.rest.triangles.resize(static_cast<Eigen::Index>(collected.triangles.size()), 3);
  for (std::size_t t = 0; t < collected.triangles.size(); ++t)
    fine.rest.triangles.row(static_cast<Eigen::Index>(t)) << collected.triangles[t][0],
      collected.triangles[t][1], collected.triangles[t][2];
  fine.rest.material   = vector_of(collected.material);
  fine.panel           = vector_of(collected.panel);
  fine.cell_vertex     = vector_of(collected.cell_vertex);
  fine.cell_triangle   = vector_of(collected.cell_triangle);
  fine.cell_weights    = stacked<3>(collected.cell_weights);
  fine.coarse_triangle = vector_of(collected.coarse_triangle);
  fine.coarse_weights  = stacked<3>(collected.coarse_weights);
  fine.seam_distance   = Eigen::Map<const Eigen::VectorXd>(
    collected.seam_distance.data(), static_cast<Eigen::Index>(collected.seam_distance.size()));
  fine.same_in_space = sewn(collected, seams);
  return fine;
}
} // namespace homespun::meshes
