// SPDX-License-Identifier: MIT
#include "meshes/plain/lattice.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/mesh_fault.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <map>
#include <sstream>
#include <unordered_map>

namespace homespun::meshes
{
double Lattice::area() const
{
  return std::abs(vectors.determinant());
}

Eigen::RowVector2d Lattice::fractional(const Eigen::RowVector2d &point) const
{
  return point * vectors.inverse();
}

Eigen::RowVector2d Lattice::shortest(const Eigen::RowVector2d &difference) const
{
  Eigen::RowVector2d f = fractional(difference);
  f(0) -= std::round(f(0));
  f(1) -= std::round(f(1));
  return f * vectors;
}

ImageClasses match_images(const Points &points, const Lattice &lattice,
                          const double relative_tolerance)
{
  const int n            = static_cast<int>(points.rows());
  const double tolerance = relative_tolerance * std::sqrt(lattice.area());

  // Bins in fractional coordinates, so wide that images lie in the same or in adjacent bins; about
  // one point each, but no fewer than three per direction so that the neighbours differ.
  const Eigen::Matrix2d to_fractional = lattice.vectors.inverse();
  const double widest = tolerance * to_fractional.cwiseAbs().colwise().sum().maxCoeff();
  const double wanted = std::sqrt(static_cast<double>(std::max(n, 9)));
  const auto n_bins   = static_cast<long>(std::max(3., std::min(wanted, std::floor(0.5 / widest))));

  ImageClasses classes;
  classes.representative.resize(static_cast<std::size_t>(n));
  classes.size.assign(static_cast<std::size_t>(n), 0);
  classes.offset.setZero(n, 2);

  std::unordered_map<long, std::vector<int>> representatives_in;
  const Eigen::RowVector2d origin = n > 0 ? points.row(0) : Eigen::RowVector2d(0, 0);
  for (int i = 0; i < n; ++i)
  {
    const Eigen::RowVector2d f = (points.row(i) - origin) * to_fractional;
    const auto bin_of          = [n_bins](const double x)
    {
      return std::min(n_bins - 1,
                      static_cast<long>((x - std::floor(x)) * static_cast<double>(n_bins)));
    };
    const long bin1 = bin_of(f(0)), bin2 = bin_of(f(1));
    int found = -1;
    for (long d1 = -1; d1 <= 1 && found < 0; ++d1)
      for (long d2 = -1; d2 <= 1 && found < 0; ++d2)
      {
        const long key = ((bin1 + d1 + n_bins) % n_bins) * n_bins + (bin2 + d2 + n_bins) % n_bins;
        const auto bin = representatives_in.find(key);
        if (bin == representatives_in.end())
          continue;
        for (const int candidate : bin->second)
          if (lattice.shortest(points.row(i) - points.row(candidate)).norm() <= tolerance)
          {
            found = candidate;
            break;
          }
      }
    const auto index = static_cast<std::size_t>(i);
    if (found < 0)
    {
      representatives_in[bin1 * n_bins + bin2].push_back(i);
      classes.representative[index] = i;
    }
    else
    {
      const Eigen::RowVector2d d    = (points.row(i) - points.row(found)) * to_fractional;
      classes.representative[index] = found;
      classes.offset(i, 0)          = static_cast<int>(std::lround(d(0)));
      classes.offset(i, 1)          = static_cast<int>(std::lround(d(1)));
    }
    ++classes.size[static_cast<std::size_t>(classes.representative[index])];
  }
  for (std::size_t i = 0; i < classes.size.size(); ++i)
    classes.size[i] = classes.size[static_cast<std::size_t>(classes.representative[i])];
  return classes;
}

std::vector<int> outline(const TriangleMesh &mesh)
{
  std::vector<int> outer;
  double largest = -std::numeric_limits<double>::infinity();
  for (std::vector<int> &loop : boundary_loops(mesh))
  {
    double twice_area = 0.;
    for (std::size_t k = 0; k < loop.size(); ++k)
    {
      const auto a = mesh.vertices.row(loop[k]), b = mesh.vertices.row(loop[(k + 1) % loop.size()]);
      twice_area += a(0) * b(1) - a(1) * b(0);
    }
    if (twice_area > largest)
    {
      largest = twice_area;
      outer   = std::move(loop);
    }
  }
  return outer;
}

namespace
{
Points points_at(const TriangleMesh &mesh, const std::vector<int> &vertices)
{
  return mesh.vertices(vertices, Eigen::all);
}
} // namespace

void require_sheets(const Lattice &lattice)
{
  if (lattice.cuts_holes)
    throw BadInput(
      "sheets and garments cannot be cut from this cloth: each straight line along one of its "
      "lattice vectors meets a hole; expected a cell whose sides pass between its holes: draw it "
      "along other `Lattice vectors` of the same cloth, or fill the holes with a soft phase. C^H, "
      "`periodic load` and `periodic stability` need no sheet");
}

Sides sides_of(const TriangleMesh &mesh, const Lattice &lattice)
{
  Sides sides{outline(mesh), {}};
  if (!lattice.cuts_holes)
  {
    for (std::size_t k = 0; k < sides.vertices.size(); ++k)
      sides.edges.push_back({sides.vertices[k], sides.vertices[(k + 1) % sides.vertices.size()]});
    return sides;
  }
  const std::vector<std::array<int, 2>> boundary = boundary_edges(mesh);
  std::vector<int> begins; // each vertex of the boundary once, but where rims touch
  Points middles(static_cast<Eigen::Index>(boundary.size()), 2);
  for (std::size_t e = 0; e < boundary.size(); ++e)
  {
    begins.push_back(boundary[e][0]);
    middles.row(static_cast<Eigen::Index>(e)) =
      0.5 * (mesh.vertices.row(boundary[e][0]) + mesh.vertices.row(boundary[e][1]));
  }
  std::sort(begins.begin(), begins.end());
  begins.erase(std::unique(begins.begin(), begins.end()), begins.end());
  const ImageClasses of_vertices = match_images(points_at(mesh, begins), lattice),
                     of_edges    = match_images(middles, lattice);
  sides.vertices.clear();
  std::vector<char> has_image(static_cast<std::size_t>(mesh.n_vertices()), 0);
  for (std::size_t k = 0; k < begins.size(); ++k)
    if (of_vertices.size[k] > 1)
    {
      sides.vertices.push_back(begins[k]);
      has_image[static_cast<std::size_t>(begins[k])] = 1;
    }
  for (std::size_t e = 0; e < boundary.size(); ++e)
    if (of_edges.size[e] > 1 && has_image[static_cast<std::size_t>(boundary[e][0])] &&
        has_image[static_cast<std::size_t>(boundary[e][1])])
      sides.edges.push_back(boundary[e]);
  return sides;
}

namespace
{
/// Two vertices within the tolerance of periodic images, anywhere in the mesh: whoever matches
/// images would take them for one.
std::vector<MeshFault> coincidence_faults(const TriangleMesh &mesh, const Lattice &lattice,
                                          const std::string &name, const double relative_tolerance)
{
  const ImageClasses classes = match_images(mesh.vertices, lattice, relative_tolerance);
  std::map<std::array<int, 3>, int> vertex_at;
  for (int v = 0; v < mesh.n_vertices(); ++v)
  {
    const auto [other, is_new] =
      vertex_at.insert({{classes.representative[static_cast<std::size_t>(v)], classes.offset(v, 0),
                         classes.offset(v, 1)},
                        v});
    if (is_new)
      continue;
    std::ostringstream text;
    text.precision(10);
    text << name << ": vertices " << other->second << " at (" << mesh.vertices.row(other->second)
         << ") m and " << v << " at (" << mesh.vertices.row(v)
         << ") m count as one; expected more than "
         << relative_tolerance * std::sqrt(lattice.area())
         << " m between them, the tolerance of periodic images: merge them, or move them apart";
    return {{text.str(), {mesh.vertices.row(v), -1, v}}};
  }
  return {};
}
} // namespace

std::vector<std::string> periodicity_faults(const TriangleMesh &mesh, const Lattice &lattice,
                                            const std::string &name,
                                            const double relative_tolerance)
{
  return messages_of(placed_periodicity_faults(mesh, lattice, name, relative_tolerance));
}

namespace
{
/// Outlines that enclose another area than the lattice, and triangles that cover more than it.
void add_area_faults(const TriangleMesh &mesh, const Lattice &lattice, const std::string &name,
                     const std::vector<int> &loop, std::vector<MeshFault> &faults)
{
  double enclosed = 0.;
  for (std::size_t k = 0; k < loop.size(); ++k)
  {
    // From a corner of the cell, that a cell far from the origin loses no digits.
    const Eigen::RowVector2d corner = mesh.vertices.row(loop[0]),
                             a      = mesh.vertices.row(loop[k]) - corner,
                             b      = mesh.vertices.row(loop[(k + 1) % loop.size()]) - corner;
    enclosed += 0.5 * (a(0) * b(1) - a(1) * b(0));
  }
  if (std::abs(enclosed - lattice.area()) > 1e-6 * lattice.area())
  {
    std::ostringstream text;
    text << std::setprecision(10) << name << ": the outline of the mesh encloses " << enclosed
         << " m^2, but the lattice vectors (" << lattice.vectors.row(0) << ") and ("
         << lattice.vectors.row(1) << ") m span " << lattice.area()
         << " m^2; expected equal areas: mend `Lattice vectors`, or mesh exactly one cell; where "
            "holes cut the outline, mesh what is left of opposite sides alike";
    faults.push_back({text.str(), Place()});
  }
  const double covered = signed_areas(mesh).cwiseAbs().sum();
  if (covered > enclosed * (1. + 1e-9))
  {
    std::ostringstream text;
    text << std::setprecision(10) << name << ": the triangles cover " << covered
         << " m^2 inside an outline of " << enclosed
         << " m^2; expected at most that: some triangles overlap, remove one of two coinciding "
            "parts";
    faults.push_back({text.str(), Place()});
  }
}

} // namespace

std::string text_of_unmatched(const std::vector<int> &loop, const Points &points,
                              const Lattice &lattice, const Eigen::Index i,
                              const double relative_tolerance)
{
  const double cell_size = std::sqrt(lattice.area());
  Eigen::Index nearest   = -1;
  double gap             = std::numeric_limits<double>::infinity();
  for (Eigen::Index k = 0; k < points.rows(); ++k)
  {
    const Eigen::RowVector2d difference = points.row(k) - points.row(i);
    const Eigen::RowVector2d shortest   = lattice.shortest(difference);
    // Neighbours on the same side are no candidates: an image lies a lattice vector away.
    if (k != i && (difference - shortest).norm() > 0.5 * cell_size && shortest.norm() < gap)
    {
      gap     = shortest.norm();
      nearest = k;
    }
  }
  std::ostringstream text;
  text.precision(10);
  text << "vertex " << loop[static_cast<std::size_t>(i)] << " at (" << points.row(i)
       << ") m on the outline has no periodic image";
  if (nearest >= 0)
    text << "; the nearest candidate is vertex " << loop[static_cast<std::size_t>(nearest)]
         << " at (" << points.row(nearest) << ") m, off by " << gap << " m";
  text << "; expected one within " << relative_tolerance * cell_size
       << " m: mesh opposite sides alike (Gmsh: Periodic Curve {right} = {left} Translate {dx, dy, "
          "0};) or mend `Lattice vectors`";
  return text.str();
}

std::vector<MeshFault> placed_periodicity_faults(const TriangleMesh &mesh, const Lattice &lattice,
                                                 const std::string &name,
                                                 const double relative_tolerance)
{
  std::vector<MeshFault> faults;
  if (!lattice.vectors.allFinite() ||
      !(lattice.area() > 1e-6 * lattice.vectors.rowwise().norm().prod()))
  {
    std::ostringstream text;
    text << name << ": the lattice vectors (" << lattice.vectors.row(0) << ") and ("
         << lattice.vectors.row(1) << ") m are parallel or zero; expected two independent vectors";
    return {{text.str(), Place()}};
  }

  const std::vector<int> loop = outline(mesh);
  const Points points         = points_at(mesh, loop);
  add_area_faults(mesh, lattice, name, loop, faults);
  for (const MeshFault &fault : coincidence_faults(mesh, lattice, name, relative_tolerance))
    faults.push_back(fault);
  const ImageClasses classes = match_images(points, lattice, relative_tolerance);
  int unmatched              = 0;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
  {
    if (classes.size[static_cast<std::size_t>(i)] > 1)
      continue;
    if (++unmatched > 3)
      continue;
    const int vertex = loop[static_cast<std::size_t>(i)];
    faults.push_back({name + ": " + text_of_unmatched(loop, points, lattice, i, relative_tolerance),
                      Place{mesh.vertices.row(vertex), -1, vertex}});
  }
  if (unmatched > 3)
    faults.push_back({name + ": and " + std::to_string(unmatched - 3) +
                        " more vertices of the outline without a periodic image",
                      Place()});
  return faults;
}

int anchor_vertex(const TriangleMesh &mesh, const Lattice &lattice)
{
  const std::vector<int> loop = sides_of(mesh, lattice).vertices;
  const Points points         = points_at(mesh, loop);
  const ImageClasses classes  = match_images(points, lattice);
  const double slack          = image_tolerance * std::sqrt(lattice.area());

  // The corner where both lattice vectors begin, if the outline is their parallelogram.
  Points fraction(points.rows(), 2);
  for (Eigen::Index k = 0; k < points.rows(); ++k)
    fraction.row(k) = lattice.fractional(points.row(k));
  const Eigen::RowVector2d least = fraction.colwise().minCoeff();
  const auto begins_there        = [&](const std::size_t k) {
    return (fraction.row(static_cast<Eigen::Index>(k)) - least).maxCoeff() <= 2. * image_tolerance;
  };
  std::size_t best = 0;
  for (std::size_t k = 1; k < loop.size(); ++k)
  {
    const auto here = static_cast<Eigen::Index>(k), there = static_cast<Eigen::Index>(best);
    const double dy = points(here, 1) - points(there, 1), dx = points(here, 0) - points(there, 0);
    const bool lower_left = dy < -slack || (dy < slack && dx < -slack);
    if (classes.size[k] != classes.size[best]   ? classes.size[k] > classes.size[best]
        : begins_there(k) != begins_there(best) ? begins_there(k)
                                                : lower_left)
      best = k;
  }
  return loop[best];
}

Eigen::RowVector2d corner_of_parallelogram(const TriangleMesh &mesh, const Lattice &lattice)
{
  require_sheets(lattice);
  const Eigen::RowVector2d corner = mesh.vertices.row(anchor_vertex(mesh, lattice));
  constexpr double slack          = 2. * image_tolerance;
  for (int v = 0; v < mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d f = lattice.fractional(mesh.vertices.row(v) - corner);
    if (f.minCoeff() >= -slack && f.maxCoeff() <= 1. + slack)
      continue;
    std::ostringstream text;
    text << "vertex " << v << " at (" << mesh.vertices.row(v)
         << ") m lies outside the parallelogram of the lattice vectors at (" << corner
         << ") m; expected all inside: the edges of this cell are no lattice lines, so that no "
            "sheet with straight edges can be cut from its cloth, and it has no edge terms";
    throw BadInput(text.str());
  }
  return corner;
}
} // namespace homespun::meshes
