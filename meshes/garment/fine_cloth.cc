// SPDX-License-Identifier: MIT
#include "meshes/garment/fine_cloth.h"

#include "meshes/cloth/cloth_faults.h"
#include "meshes/garment/filled_holes.h"
#include "meshes/garment/fine_panel.h"
#include "meshes/garment/seam_distance.h"
#include "meshes/plain/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

namespace homespun::meshes
{
namespace
{
/// Gives both sides of every seam the same points: those of either side, at the same part of the
/// coarse edge. Points nearer than the tolerance become one.
void match_seams(const std::vector<FinePanel> &panels, const std::vector<SeamEdge> &seams,
                 const ClothMesh &cloth, const Panels &membership, const double tolerance)
{
  std::map<std::array<int, 2>, int> edge_of_side; // of the panel's outline
  for (const FinePanel &panel : panels)
    for (std::size_t e = 0; e < panel.outline.size(); ++e)
      edge_of_side[{panel.outline[e].triangle, panel.outline[e].side}] = static_cast<int>(e);
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
      const auto &rest = cloth.rest.vertices;
      length           = std::min(length, (rest.row(ends[1]) - rest.row(ends[0])).norm());
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

/// Where the vertices of a panel come from, and where they go.
struct Collection
{
  const FinePanel &panel;
  const TriangleMesh &cell_mesh;
  const SeamDistance &seam_distance;
  const Eigen::RowVector2d &towards; ///< to which points on coarse edges belong
  Collected &fine;

  /// Where a corner of a kept triangle lies, in the frame of the panel.
  Eigen::RowVector2d place_of(const int corner) const
  {
    const int v = panel.cut_vertex_of(corner);
    return v >= 0 ? panel.cut->vertices[at(v)].x
                  : Eigen::RowVector2d(panel.sheet.mesh.vertices.row(corner));
  }

  /// A fine vertex at a corner of a kept triangle, which was cut from this one of the sheet.
  /// @return its index
  int add_vertex(const int corner, const int triangle)
  {
    const CutMesh &cut        = *panel.cut;
    const TriangleMesh &sheet = panel.sheet.mesh;
    const int v = panel.cut_vertex_of(corner), n_sheet = sheet.n_vertices();
    const Eigen::RowVector2d x = place_of(corner);
    fine.x.push_back(x + panel.base);
    fine.panel.push_back(panel.index);
    fine.seam_distance.push_back(seam_distance(x));
    fine.cell_vertex.push_back(corner < n_sheet ? panel.sheet.cell_vertex(corner) : -1);
    fine.cell_triangle.push_back(-1);
    fine.cell_weights.push_back({0., 0., 0.});
    if (corner >= n_sheet)
    {
      const int made_in           = cut.vertices[at(v)].parent;
      const int parent            = sheet.material(made_in) != hole ? made_in : triangle;
      const Eigen::RowVector2d x0 = sheet.vertices.row(sheet.triangles(parent, 0)),
                               e1 = sheet.vertices.row(sheet.triangles(parent, 1)) - x0,
                               e2 = sheet.vertices.row(sheet.triangles(parent, 2)) - x0;
      const double b1 = cross(x - x0, e2) / cross(e1, e2), b2 = cross(e1, x - x0) / cross(e1, e2);
      fine.cell_triangle.back() = parent % cell_mesh.n_triangles();
      fine.cell_weights.back() << 1. - b1 - b2, b1, b2;
    }
    fine.coarse_triangle.push_back(-1);
    fine.coarse_weights.push_back({0., 0., 0.});
    if (v < 0 || cut.vertices[at(v)].outline.empty())
    {
      const Location found        = panel.location->locate(x, towards);
      fine.coarse_triangle.back() = found.triangle;
      fine.coarse_weights.back()  = found.weights.transpose();
      if (found.triangle < 0)
        throw std::logic_error("fine cloth: a vertex inside a panel lies in no coarse triangle");
    }
    return static_cast<int>(fine.x.size()) - 1;
  }

  /// Where a triangle has a side on the outline, that tells which coarse triangle its vertices
  /// belong to.
  void put_on_outline(const KeptTriangle &triangle, const std::array<int, 3> &corners)
  {
    const CutMesh &cut = *panel.cut;
    const auto put     = [&](const std::size_t k, const int edge)
    {
      const Side &side  = panel.outline[at(edge)];
      const double part = cut.part_of(panel.cut_vertex_of(triangle.corners[k]), edge);
      fine.coarse_triangle[at(corners[k])] = side.triangle;
      fine.coarse_weights[at(corners[k])].setZero();
      fine.coarse_weights[at(corners[k])](side.side)           = 1. - part;
      fine.coarse_weights[at(corners[k])]((side.side + 1) % 3) = part;
      return part;
    };
    for (std::size_t k = 0; k < 3; ++k)
    {
      const int a = panel.cut_vertex_of(triangle.corners[k]),
                b = panel.cut_vertex_of(triangle.corners[(k + 1) % 3]);
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
};

/// Takes over what is kept of a panel but for its holes.
/// @return their area [m^2]
double collect(const std::vector<KeptTriangle> &kept, Collection into)
{
  double in_holes                            = 0.;
  const FinePanel &panel                     = into.panel;
  const std::vector<std::array<int, 3>> fans = fans_of(panel, kept);
  std::vector<int> first_copy(at(panel.sheet.mesh.n_vertices()) + panel.cut->vertices.size(),
                              -1);                // fine vertex of fan 0
  std::map<std::array<int, 2>, int> other_copies; // of fans 1, 2, ...
  for (std::size_t t = 0; t < kept.size(); ++t)
  {
    const int material = panel.sheet.mesh.material(kept[t].parent);
    if (material == hole)
    {
      const auto [a, b, c] = kept[t].corners;
      in_holes +=
        0.5 * cross(into.place_of(b) - into.place_of(a), into.place_of(c) - into.place_of(a));
      continue;
    }
    std::array<int, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      const int corner = kept[t].corners[k], fan = fans[t][k];
      int &vertex = fan == 0
                      ? first_copy[at(corner)]
                      : other_copies.emplace(std::array<int, 2>{corner, fan}, -1).first->second;
      if (vertex < 0)
        vertex = into.add_vertex(corner, kept[t].parent);
      corners[k] = vertex;
    }
    into.fine.triangles.push_back(corners);
    into.fine.material.push_back(material);
    into.put_on_outline(kept[t], corners);
  }
  return in_holes;
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

/// What of the seams runs along a panel, in its frame.
std::vector<std::array<Eigen::RowVector2d, 2>> seams_along(const FinePanel &panel,
                                                           const ClothMesh &cloth,
                                                           const Panels &membership,
                                                           const std::vector<SeamEdge> &seams)
{
  std::vector<std::array<Eigen::RowVector2d, 2>> segments;
  for (const SeamEdge &seam : seams)
    for (const Side &sewn_side : seam.sides)
      if (membership.of_triangle(sewn_side.triangle) == panel.index)
      {
        const auto ends = rest_ends(cloth, sewn_side);
        segments.push_back({cloth.rest.vertices.row(ends[0]) - panel.base,
                            cloth.rest.vertices.row(ends[1]) - panel.base});
      }
  return segments;
}

/// The area of the fine triangles of a panel, those from `first` on, with that of the holes.
/// @throws BadInput where it is not that of the panel
double covered_area(const FinePanel &panel, const Collected &collected, const std::size_t first,
                    const double in_holes, const Outline outline)
{
  double covered = in_holes;
  for (std::size_t t = first; t < collected.triangles.size(); ++t)
  {
    const auto [a, b, c] = collected.triangles[t];
    covered +=
      0.5 * cross(collected.x[at(b)] - collected.x[at(a)], collected.x[at(c)] - collected.x[at(a)]);
  }
  // A cover that misses or repeats a millionth means an outline that crosses itself.
  if (covered > (1. + 1e-6) * panel.area ||
      (outline == Outline::clipped && covered < (1. - 1e-6) * panel.area))
  {
    std::ostringstream text;
    text
      << "fine cloth: panel " << panel.index << " has an area of " << panel.area
      << " m^2 and its fine triangles with the holes between them one of " << covered
      << " m^2; expected the same: the panel overlaps itself at rest: unwrap it without overlaps";
    throw BadInput(text.str());
  }
  return covered;
}

/// Takes over what was collected of all panels.
void take(const Collected &collected, FineCloth &fine)
{
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
}
} // namespace

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
  for (std::size_t p = 0; p < options.grains.size(); ++p)
    if (!options.grains[p].origin.allFinite() || !std::isfinite(options.grains[p].angle))
      throw BadInput("fine cloth: grain " + std::to_string(p) +
                     " has an origin or an angle that is not a finite number");

  require_sheets(lattice);
  const TriangleMesh filled = filled_holes(cell_mesh);
  const std::vector<FinePanel> panels =
    fine_panels(filled, lattice, cloth, membership, options.grains);
  const std::vector<SeamEdge> seams = seam_edges(cloth);
  const double cell_area = lattice.area(), side = std::sqrt(cell_area);
  FineCloth fine;
  fine.lattice = lattice;
  fine.outline = options.outline;
  if (options.outline == Outline::clipped)
    match_seams(panels, seams, cloth, membership, outline_tolerance * side);

  Collected collected;
  for (const FinePanel &panel : panels)
  {
    fine.grains.push_back(panel.grain);
    const KeptTriangles kept = kept_triangles(panel, options.outline, cell_area);
    const std::size_t before = collected.triangles.size();
    fine.n_cut += kept.n_cut;
    fine.n_slivers += kept.n_slivers;
    // Points on a coarse edge belong to the triangle at their upper right, as in the Upsampler.
    const Eigen::RowVector2d towards = 1e-5 * Eigen::RowVector2d(2. / 3., 1. / 3.) *
                                       lattice.vectors * panel.grain.rotation().transpose();
    const SeamDistance seam_distance(seams_along(panel, cloth, membership, seams),
                                     seam_reach * side);
    const double in_holes =
      collect(kept.triangles, {panel, filled, seam_distance, towards, collected});
    fine.area_lost +=
      panel.area - covered_area(panel, collected, before, in_holes, options.outline);
  }
  if (collected.triangles.empty())
    throw BadInput(
      "fine cloth: no triangle of the cell lies wholly inside a panel; expected panels larger "
      "than the cell's triangles: is vt in metres? or clip the outline");
  take(collected, fine);
  fine.same_in_space = sewn(collected, seams);
  return fine;
}
} // namespace homespun::meshes
