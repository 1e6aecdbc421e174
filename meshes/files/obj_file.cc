// SPDX-License-Identifier: MIT
#include "meshes/files/obj_file.h"

#include "meshes/files/obj_reader.h"
#include "meshes/files/write_whole.h"
#include "meshes/plain/errors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

namespace homespun::meshes
{
namespace
{
/// Cuts faces into triangles of corners.
/// @param prefers_second whether a quadrilateral is cut from its corner 1 to 3, and not from 0 to 2
template <typename Choice>
std::vector<std::array<ObjCorner, 3>> triangles_of(const std::vector<std::vector<ObjCorner>> &faces,
                                                   const Choice &prefers_second)
{
  std::vector<std::array<ObjCorner, 3>> triangles;
  for (const std::vector<ObjCorner> &f : faces)
    if (f.size() == 3)
      triangles.push_back({f[0], f[1], f[2]});
    else if (prefers_second(f))
    {
      triangles.push_back({f[0], f[1], f[3]});
      triangles.push_back({f[1], f[2], f[3]});
    }
    else
    {
      triangles.push_back({f[0], f[1], f[2]});
      triangles.push_back({f[0], f[2], f[3]});
    }
  return triangles;
}

SpacePoints points_of(const std::vector<std::array<double, 3>> &v)
{
  SpacePoints points(static_cast<Eigen::Index>(v.size()), 3);
  for (std::size_t k = 0; k < v.size(); ++k)
    points.row(static_cast<Eigen::Index>(k)) << v[k][0], v[k][1], v[k][2];
  return points;
}

void append(std::string &text, const char *const keyword, const double *const numbers, const int n)
{
  text += keyword;
  char digits[40];
  for (int i = 0; i < n; ++i)
  {
    text += ' ';
    text.append(digits, std::to_chars(digits, digits + sizeof(digits), numbers[i]).ptr);
  }
  text += '\n';
}

template <typename Positions>
void require_finite(const std::string &file, const Positions &positions)
{
  for (Eigen::Index v = 0; v < positions.rows(); ++v)
    if (!positions.row(v).allFinite())
      throw BadInput(file + ": not written: vertex " + std::to_string(v) +
                     " has a position that is not finite");
}

/// Twice the area of a face, along its normal.
Eigen::RowVector3d doubled_area(const Polygons &mesh, const Polygon &face)
{
  const auto x = [&](const std::size_t k) -> Eigen::RowVector3d
  { return mesh.positions.row(face[k]) - mesh.positions.row(face[0]); };
  Eigen::RowVector3d twice = x(1).cross(x(2));
  if (face[3] >= 0)
    twice += x(2).cross(x(3));
  return twice;
}

/// The plane of a mesh at rest.
struct RestPlane
{
  std::array<Eigen::RowVector3d, 2> axes; ///< of the rest coordinates
  std::string seen_from;                  ///< where they are a right-handed system
};

/// Distance of all points from the plane through the first one across a unit vector [m].
Eigen::VectorXd distances(const Polygons &mesh, const Eigen::RowVector3d &normal)
{
  const Eigen::RowVector3d first = mesh.positions.row(0);
  return ((mesh.positions.rowwise() - first) * normal.transpose()).cwiseAbs();
}

/// The unit normal of the faces, upwards, of an upright plane towards +y; zero where they have no
/// area.
Eigen::RowVector3d normal_of(const Polygons &mesh)
{
  Eigen::RowVector3d normal = Eigen::RowVector3d::Zero();
  for (const Polygon &face : mesh.faces)
  {
    const Eigen::RowVector3d its = doubled_area(mesh, face);
    normal += its.dot(normal) < 0. ? -its : its;
  }
  normal.normalize();
  const bool is_upright = std::abs(normal(2)) <= 1e-6;
  return (is_upright ? normal(1) : normal(2)) < 0. ? -normal : normal;
}

/// @return nothing where the mesh is not flat
std::optional<RestPlane> plane_of(const Polygons &mesh)
{
  // What single precision leaves of a plane.
  const double tolerance = 1e-6 * mesh.positions.cwiseAbs().maxCoeff();
  const auto lies_across = [&](const Eigen::RowVector3d &normal)
  { return distances(mesh, normal).maxCoeff() <= tolerance; };
  const Eigen::RowVector3d x = Eigen::RowVector3d::UnitX(), y = Eigen::RowVector3d::UnitY(),
                           z = Eigen::RowVector3d::UnitZ();
  if (lies_across(z))
    return RestPlane{{x, y}, "+z"};
  if (lies_across(y))
    return RestPlane{{x, -z}, "+y"};
  if (lies_across(x))
    return RestPlane{{y, z}, "+x"};
  const Eigen::RowVector3d normal = normal_of(mesh);
  if (normal.isZero() || !lies_across(normal))
    return {};
  const Eigen::RowVector3d along = (x - normal(0) * normal).normalized();
  return RestPlane{{along, normal.cross(along)}, "above"};
}

/// Some programs write a vt for each corner of a face. Where two faces share an edge, and both of
/// its ends at the same place, their corners are one.
class JoinedCorners
{
public:
  JoinedCorners(const ObjContent &content, const std::vector<std::array<ObjCorner, 3>> &triangles)
  {
    using End      = std::tuple<int, double, double>; // v and place
    const auto end = [&](const ObjCorner &corner)
    {
      const auto [x, y] = content.vt[static_cast<std::size_t>(corner.vt)];
      return End(corner.v, x, y);
    };
    std::map<std::pair<End, End>, std::array<ObjCorner, 2>> edges;
    for (const auto &triangle : triangles)
      for (std::size_t k = 0; k < 3; ++k)
      {
        const ObjCorner &from = triangle[k], &to = triangle[(k + 1) % 3];
        edges.emplace(std::pair(end(from), end(to)), std::array{from, to});
        if (const auto other = edges.find({end(to), end(from)}); other != edges.end())
        {
          join(from, other->second[1]);
          join(to, other->second[0]);
        }
      }
  }

  /// (vt, v), the same of corners that are one.
  std::array<int, 2> of(const ObjCorner &corner) const
  {
    std::array<int, 2> here = {corner.vt, corner.v};
    for (auto next = first.find(here); next != first.end(); next = first.find(here))
      here = next->second;
    return here;
  }

private:
  void join(const ObjCorner &one, const ObjCorner &other)
  {
    const std::array<int, 2> a = of(one), b = of(other);
    if (a != b)
      first[std::max(a, b)] = std::min(a, b);
  }

  std::map<std::array<int, 2>, std::array<int, 2>> first; ///< a smaller one that is the same
};

/// The cloth of faces all of whose corners have vt.
/// @throws BadInput with the faults of the cloth
ClothMesh cloth_of(const ObjContent &content, const double vt_unit, const std::string &file)
{
  const auto doubled_area = [&](const ObjCorner &a, const ObjCorner &b, const ObjCorner &c)
  {
    const auto point = [&](const ObjCorner &corner)
    { return content.vt[static_cast<std::size_t>(corner.vt)]; };
    const auto [x0, y0] = point(a);
    const auto [x1, y1] = point(b);
    const auto [x2, y2] = point(c);
    return (x1 - x0) * (y2 - y0) - (y1 - y0) * (x2 - x0);
  };
  const auto triangles =
    triangles_of(content.faces,
                 [&](const std::vector<ObjCorner> &f)
                 {
                   return std::min(doubled_area(f[0], f[1], f[3]), doubled_area(f[1], f[2], f[3])) >
                          std::min(doubled_area(f[0], f[1], f[2]), doubled_area(f[0], f[2], f[3]));
                 });

  const JoinedCorners joined(content, triangles);
  std::map<std::array<int, 2>, int> rest_vertex; // of (vt, v)
  for (const auto &triangle : triangles)
    for (const ObjCorner &corner : triangle)
      rest_vertex[joined.of(corner)] = 0;
  ClothMesh cloth;
  cloth.positions = points_of(content.v);
  cloth.rest.vertices.resize(static_cast<Eigen::Index>(rest_vertex.size()), 2);
  int n_rest = 0;
  for (auto &[pair, index] : rest_vertex)
  {
    const std::array<double, 2> &vt = content.vt[static_cast<std::size_t>(pair[0])];
    cloth.rest.vertices.row(n_rest) << vt_unit * vt[0], vt_unit * vt[1];
    index = n_rest++;
  }
  cloth.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  cloth.rest.triangles.resize(cloth.triangles.rows(), 3);
  cloth.rest.material.setZero(cloth.triangles.rows());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
    {
      const ObjCorner &corner = triangles[t][k];
      const auto row = static_cast<Eigen::Index>(t), column = static_cast<Eigen::Index>(k);
      cloth.triangles(row, column)      = corner.v;
      cloth.rest.triangles(row, column) = rest_vertex.at(joined.of(corner));
    }
  if (auto faults = cloth_faults(cloth, file); !faults.empty())
    throw BadInput(std::move(faults));
  return cloth;
}

} // namespace

ClothMesh read_cloth(const std::string &file, const double vt_unit)
{
  if (!std::isfinite(vt_unit) || !(vt_unit > 0.))
    throw BadInput(file + ": the unit of vt is " + std::to_string(vt_unit) +
                   " m; expected a positive number of metres");
  return cloth_of(read_obj(file, NeedsVt::yes), vt_unit, file);
}

bool is_flat(const Polygons &mesh)
{
  return plane_of(mesh).has_value();
}

ClothMesh flat_cloth(const Polygons &mesh, const std::string &name)
{
  const auto plane = plane_of(mesh);
  if (!plane)
  {
    Eigen::Index farthest = 0;
    const double distance = distances(mesh, normal_of(mesh)).maxCoeff(&farthest);
    throw BadInput(name + ": is not flat: vertex " + std::to_string(farthest) + " lies " +
                   std::to_string(distance) +
                   " m off the plane of its faces through vertex 0; expected the rest state as vt "
                   "of an OBJ file, or as a mesh in a plane");
  }
  ObjContent content;
  for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
  {
    const Eigen::RowVector3d x = mesh.positions.row(v);
    content.v.push_back({x(0), x(1), x(2)});
    content.vt.push_back({x.dot(plane->axes[0]), x.dot(plane->axes[1])});
  }
  std::size_t n_clockwise = 0, first = 0;
  for (const Polygon &face : mesh.faces)
  {
    content.faces.emplace_back();
    for (const int v : face)
      if (v >= 0)
        content.faces.back().push_back({v, v});
    if (doubled_area(mesh, face).dot(plane->axes[0].cross(plane->axes[1])) < 0. &&
        n_clockwise++ == 0)
      first = content.faces.size() - 1;
  }
  if (n_clockwise == mesh.faces.size())
    throw BadInput(name + ": all faces run clockwise seen from " + plane->seen_from +
                   "; expected counter-clockwise: flip them, or turn the mesh over");
  if (n_clockwise > 0)
    throw BadInput(name + ": " + std::to_string(n_clockwise) + " of " +
                   std::to_string(mesh.faces.size()) + " faces run clockwise seen from " +
                   plane->seen_from + ", face " + std::to_string(first) +
                   " is the first; expected counter-clockwise: flip them, and unfold what lies "
                   "upside down");
  return cloth_of(content, 1., name);
}

Surface read_surface(const std::string &file)
{
  const ObjContent content = read_obj(file, NeedsVt::no);
  Surface surface;
  surface.positions   = points_of(content.v);
  const auto distance = [&](const ObjCorner &a, const ObjCorner &b)
  { return (surface.positions.row(a.v) - surface.positions.row(b.v)).squaredNorm(); };
  const auto triangles = triangles_of(content.faces, [&](const std::vector<ObjCorner> &f)
                                      { return distance(f[1], f[3]) < distance(f[0], f[2]); });
  surface.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    surface.triangles.row(static_cast<Eigen::Index>(t)) << triangles[t][0].v, triangles[t][1].v,
      triangles[t][2].v;
  if (auto faults = surface_faults(surface, file); !faults.empty())
    throw BadInput(std::move(faults));
  return surface;
}

void write_obj(const std::string &file, const SpacePoints &positions, const Triangles &triangles)
{
  require_finite(file, positions);
  std::string text = "# positions v [m]\n";
  for (Eigen::Index v = 0; v < positions.rows(); ++v)
    append(text, "v", positions.data() + 3 * v, 3);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
  {
    text += 'f';
    for (int k = 0; k < 3; ++k)
      text += ' ' + std::to_string(triangles(t, k) + 1);
    text += '\n';
  }
  write_whole(file, text);
}

void write_obj(const std::string &file, const ClothMesh &cloth)
{
  require_finite(file, cloth.positions);
  require_finite(file, cloth.rest.vertices);
  std::string text = "# positions v [m], panels at rest vt [m]\n";
  for (Eigen::Index v = 0; v < cloth.positions.rows(); ++v)
    append(text, "v", cloth.positions.data() + 3 * v, 3);
  for (Eigen::Index v = 0; v < cloth.rest.vertices.rows(); ++v)
    append(text, "vt", cloth.rest.vertices.data() + 2 * v, 2);
  for (int t = 0; t < cloth.n_triangles(); ++t)
  {
    text += 'f';
    for (int k = 0; k < 3; ++k)
      text += ' ' + std::to_string(cloth.triangles(t, k) + 1) + '/' +
              std::to_string(cloth.rest.triangles(t, k) + 1);
    text += '\n';
  }
  write_whole(file, text);
}
} // namespace homespun::meshes
