// SPDX-License-Identifier: MIT
#include "meshes/files/obj_file.h"

#include "meshes/files/write_whole.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/fault_list.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <set>
#include <string_view>
#include <vector>

namespace homespun::meshes
{
namespace
{
/// A corner of a face, from 0; −1: no vt.
struct Corner
{
  int v, vt;
};

struct ObjContent
{
  std::vector<std::array<double, 3>> v;
  std::vector<std::array<double, 2>> vt;
  std::vector<std::vector<Corner>> faces; ///< three or four corners
};

std::vector<std::string_view> words_of(const std::string_view line)
{
  std::vector<std::string_view> words;
  std::size_t begin = 0;
  while ((begin = line.find_first_not_of(" \t\r", begin)) != std::string_view::npos)
  {
    const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

/// Whether the whole word is a finite number. Not strtod, which asks the locale for the decimal
/// point.
bool read_number(std::string_view word, double &number)
{
  if (!word.empty() && word.front() == '+')
    word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size() && std::isfinite(number);
}

bool read_number(const std::string_view word, long &number)
{
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size();
}

class ObjReader
{
public:
  ObjReader(const std::string &file, const bool needs_vt)
      : file(file)
      , needs_vt(needs_vt)
      , faults(file)
  {
  }

  ObjContent run()
  {
    std::ifstream input(file, std::ios::binary);
    if (!input)
      throw BadInput(file + ": cannot be read; expected a Wavefront OBJ file: is the path right?");
    std::string line, continued;
    while (std::getline(input, line))
    {
      ++number;
      if (!line.empty() && line.back() == '\r')
        line.pop_back();
      if (!line.empty() && line.back() == '\\')
      {
        line.back() = ' ';
        continued += line;
        continue;
      }
      read_line(continued + line);
      continued.clear();
    }
    if (input.bad())
      throw BadInput(file + ": cannot be read to its end");
    if (content.faces.empty() && faults.empty())
      faults.add("empty files",
                 "has no face (`f`); expected a mesh of triangles or quadrilaterals");
    if (auto list = faults.take(); !list.empty())
      throw BadInput(std::move(list));
    return std::move(content);
  }

private:
  std::string here() const
  {
    return "line " + std::to_string(number) + ": ";
  }

  void read_line(const std::string &line)
  {
    const std::vector<std::string_view> words =
      words_of(std::string_view(line).substr(0, line.find('#')));
    if (words.empty())
      return;
    static const std::set<std::string_view> skipped = {"o", "g", "s", "vn", "usemtl", "mtllib"};
    if (words[0] == "v")
      read_coordinates(words, content.v);
    else if (words[0] == "vt")
      read_coordinates(words, content.vt);
    else if (words[0] == "f")
      read_face(words);
    else if (skipped.count(words[0]) == 0)
      faults.add("unknown lines", here() + "found `" + std::string(words[0]) +
                                    "`; expected v, vt or f (o, g, s, vn, usemtl, mtllib and # are "
                                    "skipped): export polygons only, no curves and loose edges");
  }

  template <std::size_t n>
  void read_coordinates(const std::vector<std::string_view> &words,
                        std::vector<std::array<double, n>> &points)
  {
    points.push_back({});
    if (words.size() <= n)
      faults.add("short lines", here() + "`" + std::string(words[0]) + "` has " +
                                  std::to_string(words.size() - 1) + " numbers; expected " +
                                  std::to_string(n));
    for (std::size_t i = 0; i < n && i + 1 < words.size(); ++i)
      if (!read_number(words[i + 1], points.back()[i]))
        faults.add("coordinates that are not finite numbers",
                   here() + "found `" + std::string(words[i + 1]) + "`; expected a finite number");
  }

  /// One index, from 1 or negative, into a list of n; −1 where it is a fault.
  int index_of(const std::string_view word, const std::size_t n, const std::string &what)
  {
    long index           = 0;
    const bool is_number = read_number(word, index);
    if (is_number && index < 0)
      index += static_cast<long>(n) + 1;
    if (is_number && index >= 1 && index <= static_cast<long>(n))
      return static_cast<int>(index - 1);
    faults.add("indices out of range", here() + "the face names " + what + " `" +
                                         std::string(word) + "`; expected 1 to " +
                                         std::to_string(n) + ", or −1 to −" + std::to_string(n) +
                                         ", of the lines above it");
    return -1;
  }

  void read_face(const std::vector<std::string_view> &words)
  {
    const std::size_t n = words.size() - 1;
    if (n != 3 && n != 4)
    {
      faults.add("faces of other sizes", here() + "the face has " + std::to_string(n) +
                                           " corners; expected 3 or 4: triangulate the mesh");
      return;
    }
    std::vector<Corner> face;
    bool is_sound = true;
    for (std::size_t k = 1; k <= n; ++k)
    {
      const std::string_view word   = words[k];
      const std::size_t slash       = word.find('/');
      const std::string_view first  = word.substr(0, slash);
      const std::string_view rest   = slash == std::string_view::npos ? "" : word.substr(slash + 1);
      const std::string_view second = rest.substr(0, rest.find('/'));
      Corner corner                 = {index_of(first, content.v.size(), "v"), -1};
      if (!second.empty())
        corner.vt = index_of(second, content.vt.size(), "vt");
      is_sound = is_sound && corner.v >= 0 && (second.empty() || corner.vt >= 0);
      if (needs_vt && second.empty())
      {
        faults.add("faces without vt", here() + "the face has no vt: cloth without vt: export UV "
                                                "coordinates in metres");
        return;
      }
      face.push_back(corner);
    }
    if (is_sound)
      content.faces.push_back(std::move(face));
  }

  std::string file;
  bool needs_vt;
  FaultList faults;
  ObjContent content;
  int number = 0;
};

/// Cuts faces into triangles of corners.
/// @param prefers_second whether a quadrilateral is cut from its corner 1 to 3, and not from 0 to 2
template <typename Choice>
std::vector<std::array<Corner, 3>> triangles_of(const std::vector<std::vector<Corner>> &faces,
                                                const Choice &prefers_second)
{
  std::vector<std::array<Corner, 3>> triangles;
  for (const std::vector<Corner> &f : faces)
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
  char number[40];
  for (int i = 0; i < n; ++i)
  {
    std::snprintf(number, sizeof(number), " %.17g", numbers[i]);
    text += number;
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
} // namespace

ClothMesh read_cloth(const std::string &file, const double vt_unit)
{
  if (!std::isfinite(vt_unit) || !(vt_unit > 0.))
    throw BadInput(file + ": the unit of vt is " + std::to_string(vt_unit) +
                   " m; expected a positive number of metres");
  const ObjContent content = ObjReader(file, true).run();
  const auto doubled_area  = [&](const Corner &a, const Corner &b, const Corner &c)
  {
    const auto point = [&](const Corner &corner)
    { return content.vt[static_cast<std::size_t>(corner.vt)]; };
    const auto [x0, y0] = point(a);
    const auto [x1, y1] = point(b);
    const auto [x2, y2] = point(c);
    return (x1 - x0) * (y2 - y0) - (y1 - y0) * (x2 - x0);
  };
  const auto triangles =
    triangles_of(content.faces,
                 [&](const std::vector<Corner> &f)
                 {
                   return std::min(doubled_area(f[0], f[1], f[3]), doubled_area(f[1], f[2], f[3])) >
                          std::min(doubled_area(f[0], f[1], f[2]), doubled_area(f[0], f[2], f[3]));
                 });

  std::map<std::array<int, 2>, int> rest_vertex; // of (vt, v)
  for (const auto &triangle : triangles)
    for (const Corner &corner : triangle)
      rest_vertex[{corner.vt, corner.v}] = 0;
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
      const Corner &corner = triangles[t][k];
      const auto row = static_cast<Eigen::Index>(t), column = static_cast<Eigen::Index>(k);
      cloth.triangles(row, column)      = corner.v;
      cloth.rest.triangles(row, column) = rest_vertex.at({corner.vt, corner.v});
    }
  if (auto faults = cloth_faults(cloth, file); !faults.empty())
    throw BadInput(std::move(faults));
  return cloth;
}

Surface read_surface(const std::string &file)
{
  const ObjContent content = ObjReader(file, false).run();
  Surface surface;
  surface.positions   = points_of(content.v);
  const auto distance = [&](const Corner &a, const Corner &b)
  { return (surface.positions.row(a.v) - surface.positions.row(b.v)).squaredNorm(); };
  const auto triangles = triangles_of(content.faces, [&](const std::vector<Corner> &f)
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
