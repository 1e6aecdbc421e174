// SPDX-License-Identifier: MIT
#include "meshes/files/polygons.h"

#include "meshes/files/obj_reader.h"
#include "meshes/plain/errors.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace homespun::meshes
{
namespace
{
Polygons read_obj_polygons(const std::string &file)
{
  const ObjContent content = read_obj(file, NeedsVt::no);
  Polygons mesh;
  mesh.positions.resize(static_cast<Eigen::Index>(content.v.size()), 3);
  for (std::size_t v = 0; v < content.v.size(); ++v)
    mesh.positions.row(static_cast<Eigen::Index>(v)) << content.v[v][0], content.v[v][1],
      content.v[v][2];
  mesh.passed_over = content.passed_over;
  mesh.faces.reserve(content.faces.size());
  for (const std::vector<ObjCorner> &face : content.faces)
  {
    mesh.faces.push_back({face[0].v, face[1].v, face[2].v, face.size() == 4 ? face[3].v : -1});
    for (const ObjCorner &corner : face)
      mesh.has_vt = mesh.has_vt || corner.vt >= 0;
  }
  return mesh;
}
} // namespace

Polygons read_polygons(const std::string &file)
{
  std::string ending = std::filesystem::path(file).extension();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](const unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".obj")
    return read_obj_polygons(file);
  if (ending == ".ply")
    return read_ply(file);
  throw BadInput(file + ": found the ending `" + ending +
                 "`; expected .obj or .ply: export the mesh as one of these");
}
} // namespace homespun::meshes
