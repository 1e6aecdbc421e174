// SPDX-License-Identifier: MIT
#include "homogenization/cell/cell_mesh_file.h"

#include "homogenization/mesh_files/converted_mesh.h"
#include "homogenization/mesh_files/mesh_formats.h"
#include "meshes/files/obj_reader.h"
#include "meshes/plain/errors.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace homespun::homogenization
{
namespace
{
/// Coordinates with more digits than this have all that the drawing had.
constexpr int most_rounded_digits = 11;

/// Whether a file holds numbers as bytes: a zero among its first ones.
bool is_binary(const std::string &file)
{
  std::ifstream stream(file, std::ios::binary);
  std::string begin(1 << 16, ' ');
  stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(stream.gcount()));
  return begin.find('\0') != std::string::npos;
}

/// The digits of coordinates whose text is not at hand: those of the shortest text that gives the
/// same number.
DecimalDigits digits_of(const RawMesh &raw)
{
  DecimalDigits digits;
  std::array<char, 40> text;
  for (const Eigen::Vector3d &point : raw.points)
    for (const double component : point)
    {
      const auto end = std::to_chars(text.data(), text.data() + text.size(), component).ptr;
      digits.add({text.data(), static_cast<std::size_t>(end - text.data())});
    }
  return digits;
}

RawMesh read_obj_cell(const std::string &file)
{
  const meshes::ObjContent obj = meshes::read_obj(file, meshes::NeedsVt::no);
  RawMesh raw;
  for (const auto &[x, y, z] : obj.v)
    raw.points.emplace_back(x, y, z);
  for (std::size_t k = 0; k < obj.faces.size(); ++k)
  {
    const std::vector<meshes::ObjCorner> &face = obj.faces[k];
    raw.cells.push_back({{face[0].v, face[1].v, face[2].v, face.back().v},
                         static_cast<int>(face.size()),
                         obj.group_of_face[k]});
  }
  raw.number_of_name = obj.number_of_group;
  raw.digits         = digits_of(raw);
  return raw;
}

RawMesh read_any(const std::string &file, const MPI_Comm communicator)
{
  const std::string ending = lower(std::filesystem::path(file).extension().string());
  if (ending == ".obj")
    return read_obj_cell(file);
  if (ending == ".msh")
  {
    MeshText text(file);
    return read_msh(text);
  }
  MeshText text(file + ", converted to .msh", converted_to_msh(file, communicator));
  RawMesh raw = read_msh(text);
  raw.digits  = is_binary(file) ? DecimalDigits() : digits_of(raw);
  return raw;
}

void require_flat(const std::string &file, const RawMesh &raw)
{
  // Of points that elements use: construction points may lie anywhere.
  Eigen::Vector3d low  = raw.points[static_cast<std::size_t>(raw.cells[0].corners[0])];
  Eigen::Vector3d high = low;
  for (const RawMesh::Cell &cell : raw.cells)
  {
    const auto hold = [&](const int point)
    {
      const Eigen::Vector3d &x = raw.points[static_cast<std::size_t>(point)];
      low                      = low.cwiseMin(x);
      high                     = high.cwiseMax(x);
    };
    for (int k = 0; k < cell.n_corners; ++k)
      hold(cell.corners[static_cast<std::size_t>(k)]);
    for (const int middle : cell.middles)
      if (middle >= 0)
        hold(middle);
  }
  // Rounded to eight digits, as old tools write.
  if (high(2) - low(2) > 1e-7 * (high - low).norm())
  {
    std::ostringstream text;
    text << file << ": the mesh is not flat: z reaches from " << low(2) << " to " << high(2)
         << " mesh units; expected a cell in the plane of x and y: turn it into that plane, or "
            "project it";
    throw meshes::BadInput(text.str());
  }
}

double area(const RawMesh &raw, const int a, const int b, const int c)
{
  const auto at = [&](const int k) { return raw.points[static_cast<std::size_t>(k)].head<2>(); };
  const Eigen::Vector2d u = at(b) - at(a), v = at(c) - at(a);
  return 0.5 * (u(0) * v(1) - u(1) * v(0));
}

/// The middles of the sides of a triangle with these corners, which are those of the element in
/// either order; those of the chords where the element has none.
MiddleNodes middles_of(const RawMesh &raw, const RawMesh::Cell &cell,
                       const std::array<int, 3> &corners)
{
  const auto at = [&](const int k) -> Eigen::Vector2d
  { return raw.points[static_cast<std::size_t>(k)].head<2>(); };
  // Turned around, (a, b, c) is (a, c, b): side 0 was side 2, and so on.
  const bool is_turned = corners[1] != cell.corners[1];
  MiddleNodes middles;
  for (std::size_t k = 0; k < 3; ++k)
    middles[k] = cell.middles[k] < 0
                   ? Eigen::Vector2d(0.5 * (at(corners[k]) + at(corners[(k + 1) % 3])))
                   : at(cell.middles[is_turned ? 2 - k : k]);
  return middles;
}

/// The triangles of an element, counter-clockwise.
std::vector<std::array<int, 3>> triangles_of(const RawMesh &raw, const RawMesh::Cell &cell)
{
  auto [a, b, c, d] = cell.corners;
  if (cell.n_corners == 3)
    return area(raw, a, b, c) < 0. ? std::vector<std::array<int, 3>>{{a, c, b}}
                                   : std::vector<std::array<int, 3>>{{a, b, c}};
  if (area(raw, a, b, c) + area(raw, a, c, d) < 0.)
    std::swap(b, d);
  const auto smaller = [&](const std::array<int, 3> &one, const std::array<int, 3> &two)
  { return std::min(area(raw, one[0], one[1], one[2]), area(raw, two[0], two[1], two[2])); };
  const auto length = [&](const int from, const int to)
  {
    return (raw.points[static_cast<std::size_t>(from)] - raw.points[static_cast<std::size_t>(to)])
      .norm();
  };
  const std::vector<std::array<int, 3>> by_ac = {{a, b, c}, {a, c, d}},
                                        by_bd = {{a, b, d}, {b, c, d}};
  const bool ac_inside                        = smaller(by_ac[0], by_ac[1]) > 0.,
             bd_inside                        = smaller(by_bd[0], by_bd[1]) > 0.;
  if (ac_inside != bd_inside)
    return ac_inside ? by_ac : by_bd;
  // Equal but for round-off, as in rectangles, is equal.
  return length(a, c) <= length(b, d) * (1. + 1e-9) ? by_ac : by_bd;
}
} // namespace

CellMeshFile read_cell_mesh(const std::string &file, const MPI_Comm communicator)
{
  if (!std::filesystem::is_regular_file(file))
    throw meshes::BadInput(file +
                           ": no such file; expected a mesh: mend the key `Mesh`, whose path is "
                           "relative to the .prm file");
  const RawMesh raw = read_any(file, communicator);
  if (raw.cells.empty())
    throw meshes::BadInput(
      file + ": holds no triangles or quadrilaterals; expected the cell's mesh: in Gmsh, "
             "add a Physical Surface and mesh with -2");
  require_flat(file, raw);

  CellMeshFile result;
  result.number_of_name      = raw.number_of_name;
  result.rounding            = raw.digits.unit(most_rounded_digits);
  result.other_data          = raw.other_data;
  meshes::TriangleMesh &mesh = result.mesh;
  std::vector<int> new_index(raw.points.size(), -1);
  for (const RawMesh::Cell &cell : raw.cells)
    for (int k = 0; k < cell.n_corners; ++k)
      new_index[static_cast<std::size_t>(cell.corners[static_cast<std::size_t>(k)])] = 0;
  int n_vertices = 0;
  for (int &index : new_index)
    index = index < 0 ? -1 : n_vertices++;
  mesh.vertices.resize(n_vertices, 2);
  for (std::size_t p = 0; p < raw.points.size(); ++p)
    if (new_index[p] >= 0)
      mesh.vertices.row(new_index[p]) = raw.points[p].head<2>().transpose();

  Eigen::Index n_triangles = 0;
  for (const RawMesh::Cell &cell : raw.cells)
    n_triangles += cell.n_corners - 2;
  mesh.triangles.resize(n_triangles, 3);
  mesh.material.resize(n_triangles);
  result.angle.resize(raw.angles.empty() ? 0 : n_triangles);
  const bool has_middles =
    std::any_of(raw.cells.begin(), raw.cells.end(),
                [](const RawMesh::Cell &cell) { return cell.middles[0] >= 0; });
  std::vector<MiddleNodes> middles;
  Eigen::Index t = 0;
  for (std::size_t e = 0; e < raw.cells.size(); ++e)
    for (const std::array<int, 3> &corners : triangles_of(raw, raw.cells[e]))
    {
      for (int k = 0; k < 3; ++k)
        mesh.triangles(t, k) =
          new_index[static_cast<std::size_t>(corners[static_cast<std::size_t>(k)])];
      mesh.material(t) = raw.cells[e].group;
      if (!raw.angles.empty())
        result.angle(t) = raw.angles[e];
      if (has_middles)
        middles.push_back(middles_of(raw, raw.cells[e], corners));
      ++t;
    }
  if (has_middles)
    result.curved_sides = curved_sides_of(mesh, middles, file);
  return result;
}
} // namespace homespun::homogenization
