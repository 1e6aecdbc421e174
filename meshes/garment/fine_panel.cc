// SPDX-License-Identifier: MIT
#include "meshes/garment/fine_panel.h"

#include "meshes/garment/filled_holes.h"
#include "meshes/plain/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace homespun::meshes
{
namespace
{
constexpr double sliver = 1e-12; // of the cell's area

[[noreturn]] void refuse_outline(const FinePanel &panel, const Eigen::RowVector2d &x)
{
  std::ostringstream text;
  text << "fine cloth: the outline of panel " << panel.index
       << " is at odds with itself near the rest point (" << panel.base(0) + x(0) << ", "
       << panel.base(1) + x(1)
       << ") m; expected a panel that does not overlap itself at rest, without details below a "
          "millionth of a cell: unwrap it without overlaps";
  throw BadInput(text.str());
}

/// Whether a segment may come into a box: their boxes meet, and the box is not on one side of the
/// line.
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

/// Panels with their triangles and open sides.
std::vector<FinePanel> outlines_of(const ClothMesh &cloth, const Panels &panels)
{
  std::vector<FinePanel> all(at(panels.count));
  for (int t = 0; t < cloth.n_triangles(); ++t)
    all[at(panels.of_triangle(t))].triangles.push_back(t);
  for (const Side &side : open_sides(cloth))
    all[at(panels.of_triangle(side.triangle))].outline.push_back(side);
  return all;
}

/// Lays the sheet of cells over a panel.
void cover(FinePanel &panel, const TriangleMesh &cell_mesh, const Lattice &lattice,
           const ClothMesh &cloth)
{
  const Eigen::Matrix2d rotation = panel.grain.rotation();
  Eigen::RowVector2d low, high;
  low.setConstant(std::numeric_limits<double>::infinity());
  high = -low;
  for (const Side &side : panel.outline)
  {
    const Eigen::RowVector2d point = cloth.rest.vertices.row(rest_ends(cloth, side)[0]);
    const Eigen::RowVector2d f     = lattice.fractional((point - panel.grain.origin) * rotation);
    low                            = low.cwiseMin(f);
    high                           = high.cwiseMax(f);
  }
  if (const double farthest = std::max(-low.minCoeff(), high.maxCoeff()); !(farthest <= 1e9))
  {
    std::ostringstream text;
    text << "fine cloth: a panel lies " << farthest << " cells from the origin of the cells; "
         << "expected at most 1e9, where a place in a cell still has seven digits: take an origin "
            "near the panel";
    throw BadInput(text.str());
  }
  // At least a thousandth of a cell around the panel, so that its outline has triangles on both
  // sides.
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
  panel.base  = panel.grain.origin + first * lattice.vectors * rotation.transpose();
  panel.sheet = tile(cell_mesh, lattice, static_cast<int>(n(0)), static_cast<int>(n(1)));
  panel.sheet.mesh.vertices =
    ((panel.sheet.mesh.vertices.rowwise() - panel.sheet.origin) * rotation.transpose()).eval();
}

/// The outline of a panel, in its frame.
struct Outlined
{
  Outlined(const FinePanel &panel, const ClothMesh &cloth)
  {
    std::map<int, int> point_of; // rest vertex on the outline
    for (const Side &open : panel.outline)
    {
      std::array<int, 2> edge{};
      for (std::size_t end = 0; end < 2; ++end)
      {
        const int v                = rest_ends(cloth, open)[end];
        const auto [place, is_new] = point_of.emplace(v, static_cast<int>(points.size()));
        if (is_new)
          points.push_back(cloth.rest.vertices.row(v) - panel.base);
        edge[end] = place->second;
      }
      edges.push_back(edge);
    }
  }
  std::vector<Eigen::RowVector2d> points;
  std::vector<std::array<int, 2>> edges;
};

/// Edges of the outline that may meet each cell of the sheet.
std::vector<std::vector<int>> edges_of_cells(const FinePanel &panel, const Lattice &lattice,
                                             const Outlined &outline)
{
  const Eigen::Matrix2d rotation = panel.grain.rotation();
  const int n1 = panel.sheet.n1, n2 = panel.sheet.n2;
  std::vector<std::vector<int>> edges_of_cell(at(n1) * at(n2));
  const double margin = 1e-3; // in units of the lattice
  for (std::size_t e = 0; e < outline.edges.size(); ++e)
  {
    const auto [begin, end]       = outline.edges[e];
    const Eigen::RowVector2d from = lattice.fractional(outline.points[at(begin)] * rotation),
                             to   = lattice.fractional(outline.points[at(end)] * rotation);
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
  return edges_of_cell;
}

/// Hands a triangle of the sheet over to be cut. @param near edges that it may meet
void add_to_cut(FinePanel &panel, const int t, std::vector<int> near)
{
  const TriangleMesh &mesh = panel.sheet.mesh;
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

/// Sorts the triangles of the sheet: away from the outline inside or outside, or near it; and cuts
/// the last.
/// @param tolerance of the outline [m]
/// @return how many pieces are slivers
/// @throws CutMesh::Conflict
int clip(FinePanel &panel, const Lattice &lattice, const ClothMesh &cloth, const double tolerance)
{
  const Outlined outline(panel, cloth);
  const auto &points = outline.points;
  const auto &edges  = outline.edges;
  panel.cut          = std::make_unique<CutMesh>(points, edges, tolerance);
  panel.whole.clear();
  panel.sheet_vertex.clear();
  panel.cut_vertex.assign(at(panel.sheet.mesh.n_vertices()), -1);
  const auto edges_of_cell = edges_of_cells(panel, lattice, outline);

  const auto holds = [&](const Eigen::RowVector2d &point) {
    return panel.location->locate(point, {0., 0.}).triangle >= 0;
  };
  const TriangleMesh &mesh = panel.sheet.mesh;
  const int n1 = panel.sheet.n1, n2 = panel.sheet.n2, n_per_cell = mesh.n_triangles() / (n1 * n2);
  const Eigen::RowVector2d room =
    Eigen::RowVector2d::Constant(10. * tolerance); // more than a vertex moves
  for (int cell = 0; cell < n1 * n2; ++cell)
  {
    const std::vector<int> &candidates = edges_of_cell[at(cell)];
    const int i = cell % n1, j = cell / n1;
    const Eigen::RowVector2d middle =
      Eigen::RowVector2d(i + 0.5, j + 0.5) * lattice.vectors * panel.grain.rotation().transpose();
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
      if (!near.empty())
        add_to_cut(panel, t, std::move(near));
      else if (candidates.empty() || holds((x0 + x1 + x2) / 3.))
        panel.whole.push_back(t);
    }
  }
  panel.cut->cut();
  const std::vector<int> sides = panel.cut->sides_of_outline();
  int n_slivers                = 0;
  for (std::size_t t = 0; t < sides.size(); ++t)
    n_slivers +=
      sides[t] == 1 && panel.cut->area(static_cast<int>(t)) < sliver * lattice.area() ? 1 : 0;
  return n_slivers;
}

/// Cuts with a tolerance that suits the panel. Where vertices lie about as far from the outline as
/// the tolerance, slivers arise, and rounding may not tell the order of crossings; with another
/// tolerance they lie clearly on it or off it.
void settle(FinePanel &panel, const Lattice &lattice, const ClothMesh &cloth)
{
  const double unit = outline_tolerance * std::sqrt(lattice.area());
  int fewest        = std::numeric_limits<int>::max();
  double best       = 0.;
  Eigen::RowVector2d conflict_at;
  for (const double factor : {1., 4., 0.25, 16.})
    try
    {
      const int n_slivers = clip(panel, lattice, cloth, factor * unit);
      if (n_slivers == 0)
        return;
      if (n_slivers < fewest)
      {
        fewest = n_slivers;
        best   = factor;
      }
    }
    catch (const CutMesh::Conflict &conflict)
    {
      conflict_at = conflict.x;
    }
  if (best == 0.)
    refuse_outline(panel, conflict_at);
  clip(panel, lattice, cloth, best * unit);
}
} // namespace

int FinePanel::cut_vertex_of(const int corner) const
{
  const int n = sheet.mesh.n_vertices();
  return corner < n ? cut_vertex[at(corner)] : corner - n;
}

std::vector<FinePanel> fine_panels(const TriangleMesh &cell_mesh, const Lattice &lattice,
                                   const ClothMesh &cloth, const Panels &membership,
                                   const std::vector<Grain> &grains)
{
  std::vector<FinePanel> panels = outlines_of(cloth, membership);
  for (std::size_t p = 0; p < panels.size(); ++p)
  {
    FinePanel &panel = panels[p];
    panel.index      = static_cast<int>(p);
    panel.grain      = grains[grains.size() == 1 ? 0 : p];
    cover(panel, cell_mesh, lattice, cloth);
    TriangleMesh local = cloth.rest;
    local.vertices.rowwise() -= panel.base;
    panel.location              = std::make_unique<PointLocation>(local, panel.triangles);
    const Eigen::VectorXd areas = signed_areas(local);
    for (const int t : panel.triangles)
      panel.area += areas(t);
    settle(panel, lattice, cloth);
  }
  return panels;
}

KeptTriangles kept_triangles(const FinePanel &panel, const Outline outline, const double cell_area)
{
  const TriangleMesh &sheet = panel.sheet.mesh;
  const CutMesh &cut        = *panel.cut;
  KeptTriangles result;
  std::vector<KeptTriangle> &kept = result.triangles;
  for (const int t : panel.whole)
    kept.push_back({{sheet.triangles(t, 0), sheet.triangles(t, 1), sheet.triangles(t, 2)}, t});

  std::vector<int> sides;
  try
  {
    sides = cut.sides_of_outline();
  }
  catch (const CutMesh::Conflict &conflict)
  {
    refuse_outline(panel, conflict.x);
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
      sides[t] = panel.location->locate(middle, {0., 0.}).triangle >= 0 ? 1 : 0;
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
      result.n_cut += sheet.material(parent) != hole ? 1 : 0;
    else if (fate.n_inside > 0 && outline == Outline::whole)
      kept.push_back(
        {{sheet.triangles(parent, 0), sheet.triangles(parent, 1), sheet.triangles(parent, 2)},
         parent});
  if (outline == Outline::whole)
    return result;
  for (std::size_t t = 0; t < cut.triangles.size(); ++t)
  {
    if (sides[t] != 1)
      continue;
    const auto [a, b, c] = cut.triangles[t].corners;
    if (cut.area(static_cast<int>(t)) < sliver * cell_area)
      result.n_slivers += sheet.material(cut.triangles[t].parent) != hole ? 1 : 0;
    else
      kept.push_back({{corner_of(a), corner_of(b), corner_of(c)}, cut.triangles[t].parent});
  }
  return result;
}
} // namespace homespun::meshes
