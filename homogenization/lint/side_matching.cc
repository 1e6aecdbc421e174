// SPDX-License-Identifier: MIT
#include "homogenization/lint/side_matching.h"

#include "homogenization/cell/lattice_triangles.h"
#include "homogenization/lint/conformity.h"
#include "meshes/plain/index.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace homespun::homogenization
{
using meshes::at;
using meshes::MeshFault;

namespace
{
/// The tolerance of images where nothing else is known, and the greatest that rounded coordinates
/// ask for, in units of the shorter lattice vector.
constexpr double least_tolerance = meshes::image_tolerance, most_tolerance = 1e-4;

/// Images that agree so well, in parts of the cell, were made alike in double precision: their
/// coordinates stay as they are, to the last bit.
constexpr double round_off = 1e-10;

/// A hole is at least so wide, in units of its mean edge, and opens by at least this angle where it
/// passes to the opposite side: a point that is off its place by a part p of its edges makes a gap
/// of width p/2 with an angle p.
constexpr double least_width = 0.5, least_opening = M_PI / 6.;

std::vector<int> boundary_vertices(const meshes::TriangleMesh &mesh)
{
  std::set<int> vertices;
  for (const std::array<int, 2> &edge : meshes::boundary_edges(mesh))
    vertices.insert(edge.begin(), edge.end());
  return {vertices.begin(), vertices.end()};
}

meshes::Points points_of(const meshes::TriangleMesh &mesh, const std::vector<int> &vertices)
{
  meshes::Points points(static_cast<Eigen::Index>(vertices.size()), 2);
  for (std::size_t k = 0; k < vertices.size(); ++k)
    points.row(static_cast<Eigen::Index>(k)) = mesh.vertices.row(vertices[k]);
  return points;
}

/// The lattice for which the images lie nearest to the means of their classes: least squares,
/// x_i - mean = (n_i - mean of n) A.
meshes::Lattice fitted(const meshes::Lattice &given, const meshes::Points &points,
                       const meshes::ImageClasses &classes)
{
  const Eigen::Index n  = points.rows();
  meshes::Points mean_x = meshes::Points::Zero(n, 2), mean_n = meshes::Points::Zero(n, 2);
  for (Eigen::Index i = 0; i < n; ++i)
  {
    const Eigen::Index first = classes.representative[at(static_cast<int>(i))];
    const double part        = 1. / classes.size[at(static_cast<int>(i))];
    mean_x.row(first) += part * points.row(i);
    mean_n.row(first) += part * classes.offset.row(i).cast<double>();
  }
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero(), right = Eigen::Matrix2d::Zero();
  for (Eigen::Index i = 0; i < n; ++i)
  {
    const Eigen::Index first   = classes.representative[at(static_cast<int>(i))];
    const Eigen::RowVector2d m = classes.offset.row(i).cast<double>() - mean_n.row(first);
    normal += m.transpose() * m;
    right += m.transpose() * (points.row(i) - mean_x.row(first));
  }
  if (!(normal.determinant() > 1e-9 * normal.squaredNorm()))
    return given;
  return {normal.inverse() * right};
}

/// Moves images to the mean of their class, exactly a lattice vector apart.
void snap(MatchedCell &cell, const std::vector<int> &boundary, const meshes::Points &points,
          const meshes::ImageClasses &classes)
{
  cell.lattice         = fitted(cell.lattice, points, classes);
  const Eigen::Index n = points.rows();
  meshes::Points mean  = meshes::Points::Zero(n, 2);
  for (Eigen::Index i = 0; i < n; ++i)
    mean.row(classes.representative[at(static_cast<int>(i))]) +=
      (points.row(i) - classes.offset.row(i).cast<double>() * cell.lattice.vectors) /
      classes.size[at(static_cast<int>(i))];
  for (Eigen::Index i = 0; i < n; ++i)
  {
    const int first = classes.representative[at(static_cast<int>(i))],
              v     = boundary[at(static_cast<int>(i))];
    if (classes.size[at(static_cast<int>(i))] == 1)
      continue;
    const Eigen::RowVector2d to =
      mean.row(first) + classes.offset.row(i).cast<double>() * cell.lattice.vectors;
    const double move = (to - points.row(i)).norm();
    if (move > cell.largest_move)
    {
      cell.largest_move = move;
      cell.moved_vertex = v;
    }
    cell.mesh.vertices.row(v) = to;
  }
}

/// Gives matched sides of six-node triangles the mean of their curves, where they differ by no more
/// than images may.
void match_curves(MatchedCell &cell, const std::vector<int> &boundary,
                  const meshes::ImageClasses &classes, const double gap)
{
  std::map<int, LatticeCorner> corner_of;
  for (std::size_t i = 0; i < boundary.size(); ++i)
    corner_of[boundary[i]] = {classes.representative[i],
                              classes.offset.row(static_cast<Eigen::Index>(i))};
  std::map<LatticeEdge, std::vector<std::size_t>> sides_at;
  for (std::size_t s = 0; s < cell.curved_sides.size(); ++s)
  {
    const auto a = corner_of.find(cell.curved_sides[s].a),
               b = corner_of.find(cell.curved_sides[s].b);
    if (a != corner_of.end() && b != corner_of.end())
      sides_at[edge_between(a->second, b->second)].push_back(s);
  }
  for (const auto &[edge, sides] : sides_at)
    if (sides.size() == 2)
    {
      Eigen::Vector2d &one = cell.curved_sides[sides[0]].sagitta,
                      &two = cell.curved_sides[sides[1]].sagitta;
      const double apart   = (one - two).norm();
      if (apart <= gap && apart > round_off * std::sqrt(cell.lattice.area()))
        one = two = 0.5 * (one + two).eval();
    }
}

/// A rim of a mesh whose vertices are matched.
struct DrawnRim
{
  const Rim &rim;
  const meshes::TriangleMesh &mesh;
  const meshes::Lattice &lattice;

  std::size_t n() const
  {
    return rim.points.size();
  }
  /// The vertex of the drawing at which edge k begins, and at which it ends.
  int begin(const std::size_t k) const
  {
    return mesh.triangles(rim.sides[k][0], rim.sides[k][1]);
  }
  int end(const std::size_t k) const
  {
    return mesh.triangles(rim.sides[k][0], (rim.sides[k][1] + 1) % 3);
  }
  /// Whether the rim passes to another side at the point where edge k begins.
  bool passes_at(const std::size_t k) const
  {
    return end((k + n() - 1) % n()) != begin(k);
  }
  bool crosses_sides() const
  {
    for (std::size_t k = 0; k < n(); ++k)
      if (passes_at(k))
        return true;
    return false;
  }
  double length() const
  {
    double length = 0.;
    for (std::size_t k = 0; k < n(); ++k)
      length += ((rim.end_of(k) - rim.points[k]) * lattice.vectors).norm();
    return length;
  }
  /// Its area over half of its length [m]; negative where triangles overlap.
  double mean_width() const
  {
    return -2. * rim.area * lattice.area() / length();
  }
  bool is_gap() const // and no overlap
  {
    return mean_width() > -2e-9 * length();
  }
  bool is_thin() const
  {
    return mean_width() < least_width * length() / static_cast<double>(n()) * (1. - 1e-9);
  }
};

std::string place_text(const meshes::TriangleMesh &mesh, const int vertex)
{
  std::ostringstream text;
  text.precision(10);
  text << "vertex " << vertex << " at (" << mesh.vertices.row(vertex) << ") m";
  return text.str();
}

/// The fault of sides that were not meshed alike along a rim: the vertex without an image, and what
/// comes nearest to one; where all have images, the two ends of the gap.
MeshFault unlike_sides(const DrawnRim &its, const std::size_t where, const double gap,
                       const std::string &name)
{
  std::vector<int> loop;
  for (std::size_t k = 0; k < its.n(); ++k)
  {
    loop.push_back(its.begin(k));
    if (its.end(k) != its.begin((k + 1) % its.n()))
      loop.push_back(its.end(k));
  }
  const meshes::Points points        = points_of(its.mesh, loop);
  const meshes::ImageClasses classes = meshes::match_images(points, its.lattice);
  std::ostringstream remedy;
  if (its.is_gap())
    remedy << ", or set `Slits = real` where the gap is meant, which is "
           << std::max(0., its.mean_width()) << " m wide on average";
  if (its.is_gap() && its.rim.void_angles[where] >= least_opening)
    remedy << ": meshed with edges no longer than " << its.mean_width() / least_width
           << " m it is a hole";
  // From the place on, whichever comes first.
  for (std::size_t step = 0; step < loop.size(); ++step)
  {
    const auto i = (std::find(loop.begin(), loop.end(), its.begin(where)) - loop.begin() +
                    static_cast<std::ptrdiff_t>(step)) %
                   static_cast<std::ptrdiff_t>(loop.size());
    if (classes.size[static_cast<std::size_t>(i)] > 1)
      continue;
    const int vertex = loop[static_cast<std::size_t>(i)];
    return {name + ": opposite sides are not meshed alike: " +
              meshes::text_of_unmatched(loop, points, its.lattice, i,
                                        gap / std::sqrt(its.lattice.area())) +
              remedy.str(),
            {its.mesh.vertices.row(vertex), -1, vertex}};
  }
  const std::size_t before = (where + its.n() - 1) % its.n();
  return {name + ": opposite sides are not meshed alike: between " +
            place_text(its.mesh, its.begin(where)) + " and " +
            place_text(its.mesh, its.end(before)) +
            ", its image, a gap opens that is narrower than half of the edges beside it; expected "
            "edges that are images: a triangle may be missing there, or mend `Lattice vectors`" +
            remedy.str(),
          {its.mesh.vertices.row(its.begin(where)), -1, its.begin(where)}};
}

/// Offsets between the edges of the outline that are images of each other.
std::vector<Eigen::RowVector2i> offsets_of_matched_edges(const LatticeTriangles &glued,
                                                         const meshes::TriangleMesh &mesh)
{
  struct Side
  {
    int vertex; ///< of the drawing, at the lower end of the edge of the torus
  };
  std::map<LatticeEdge, Side> first;
  std::set<std::array<int, 2>> offsets;
  for (std::size_t t = 0; t < glued.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
    {
      const LatticeCorner &from = glued.triangles[t].corners[k],
                          &to   = glued.triangles[t].corners[(k + 1) % 3];
      const LatticeEdge edge    = edge_between(from, to);
      const bool is_forwards =
        edge[0] == from.vertex &&
        (edge[0] != edge[1] || Eigen::RowVector2i(edge[2], edge[3]) == to.offset - from.offset);
      const std::size_t lower = is_forwards ? k : (k + 1) % 3;
      const int vertex =
        mesh.triangles(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(lower));
      const auto [place, is_first] = first.emplace(edge, Side{vertex});
      if (is_first || place->second.vertex == vertex)
        continue;
      const Eigen::RowVector2d offset = glued.lattice.fractional(
        mesh.vertices.row(vertex) - mesh.vertices.row(place->second.vertex));
      offsets.insert(
        {static_cast<int>(std::lround(offset(0))), static_cast<int>(std::lround(offset(1)))});
    }
  std::vector<Eigen::RowVector2i> list;
  for (const std::array<int, 2> &offset : offsets)
    list.emplace_back(offset[0], offset[1]);
  return list;
}

/// What is left without an image: rims of holes, or sides that are not alike.
void look_at_rims(MatchedCell &cell, const SideRules &rules, const double gap,
                  const std::string &name)
{
  const auto glued =
    glued_with_rims(cell.mesh, cell.lattice, Eigen::VectorXi::Zero(cell.mesh.n_triangles()), {},
                    std::min(gap / std::sqrt(cell.lattice.area()), meshes::image_tolerance));
  if (!glued)
  {
    cell.faults = meshes::placed_periodicity_faults(cell.mesh, cell.lattice, name);
    if (cell.faults.empty())
      cell.faults.push_back({name + ": triangles overlap their images under the lattice; expected "
                                    "them side by side: mend `Lattice vectors`",
                             {}});
    return;
  }
  cell.matched_offsets        = offsets_of_matched_edges(*glued, cell.mesh);
  const std::vector<Rim> rims = rims_of(*glued);
  double filled               = meshes::signed_areas(cell.mesh).sum() / cell.lattice.area();
  bool is_closed              = true;
  for (const Rim &rim : rims)
  {
    filled -= rim.area;
    is_closed = is_closed && rim.period.isZero();
  }
  for (const Rim &rim : rims)
  {
    const DrawnRim its{rim, cell.mesh, cell.lattice};
    if (!rim.period.isZero() || !its.crosses_sides())
      continue;
    cell.cuts_holes = true;
    if (rules.slits == Slits::real && its.is_gap())
      continue;
    std::optional<std::size_t> where;
    for (std::size_t k = 0; k < its.n(); ++k)
      if (its.passes_at(k) && (rim.void_angles[k] < least_opening || (!where && its.is_thin())))
      {
        where = k;
        if (rim.void_angles[k] < least_opening)
          break;
      }
    if (where)
      cell.faults.push_back(unlike_sides(its, *where, gap, name));
  }
  if (cell.faults.empty() && cell.cuts_holes)
    cell.faults =
      conformity_faults_across(*glued, cell.mesh, name, rules.slits, rules.metres_per_unit);
  const bool is_whole = !cell.cuts_holes && is_closed;
  if (cell.faults.empty() && (is_whole || !is_closed || std::abs(filled - 1.) > 1e-6))
    cell.faults = meshes::placed_periodicity_faults(cell.mesh, cell.lattice, name);
  if (cell.faults.size() > 3)
  {
    const std::string more = std::to_string(cell.faults.size() - 3);
    cell.faults.resize(3);
    cell.faults.push_back({name + ": and " + more + " more places where sides are not alike", {}});
  }
}
} // namespace

double image_gap(const SideRules &rules, const meshes::Lattice &lattice)
{
  const double shorter = lattice.vectors.rowwise().norm().minCoeff();
  if (rules.tolerance)
    return *rules.tolerance * shorter;
  return std::clamp(4. * rules.rounding, least_tolerance * shorter, most_tolerance * shorter);
}

MatchedCell match_sides(const meshes::TriangleMesh &mesh,
                        const std::vector<CurvedSide> &curved_sides, const meshes::Lattice &lattice,
                        const SideRules &rules, const std::string &name)
{
  MatchedCell cell{lattice, mesh, curved_sides, 0., -1, false, {}, {}, {}};
  if (!lattice.vectors.allFinite() ||
      !(lattice.area() > 1e-6 * lattice.vectors.rowwise().norm().prod()))
  {
    cell.faults = meshes::placed_periodicity_faults(mesh, lattice, name);
    return cell;
  }
  // Decimal numbers differ by whole units of their last digit: exactly the tolerance is too far.
  const double gap                   = image_gap(rules, lattice) * (1. - 1e-9);
  const std::vector<int> boundary    = boundary_vertices(mesh);
  const meshes::Points points        = points_of(mesh, boundary);
  const double size                  = std::sqrt(lattice.area());
  const meshes::ImageClasses classes = meshes::match_images(points, lattice, gap / size);
  double widest                      = 0.;
  std::map<std::array<int, 3>, int> vertex_at;
  for (std::size_t i = 0; i < boundary.size(); ++i)
  {
    const auto row  = static_cast<Eigen::Index>(i);
    const int first = classes.representative[i];
    widest = std::max(widest, lattice.shortest(points.row(row) - points.row(first)).norm());
    const auto [other, is_new] =
      vertex_at.insert({{first, classes.offset(row, 0), classes.offset(row, 1)}, boundary[i]});
    if (!is_new)
    {
      std::ostringstream text;
      text.precision(10);
      text << name << ": " << place_text(mesh, other->second) << " and "
           << place_text(mesh, boundary[i]) << " count as one; expected more than " << gap
           << " m between them, the tolerance of periodic images: merge them, move them apart, or "
              "set a smaller `Matching tolerance`";
      cell.faults.push_back({text.str(), {mesh.vertices.row(boundary[i]), -1, boundary[i]}});
      return cell;
    }
  }
  if (widest > round_off * size)
  {
    snap(cell, boundary, points, classes);
    for (const MeshFault &fault : meshes::placed_faults_of(cell.mesh, name))
      cell.faults.push_back(
        {fault.message + " (after its points were moved onto their periodic images)", fault.place});
    if (!cell.faults.empty())
      return cell;
  }
  match_curves(cell, boundary, classes, gap);
  look_at_rims(cell, rules, gap, name);
  return cell;
}
} // namespace homespun::homogenization
