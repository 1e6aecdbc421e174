// SPDX-License-Identifier: MIT
#include "homogenization/cell/mesh_formats.h"

#include <cmath>

namespace homespun::homogenization
{
const char *const straight_and_flat = "; expected triangles with 3 and quadrilaterals with 4 "
                                      "corners: mesh the surface alone, with elements of first "
                                      "order (Gmsh: -2 -order 1); triangles with 6 nodes, whose "
                                      "sides are curved, are read from .msh alone";

void PointNumbers::add(MeshText &text, RawMesh &mesh, const long number,
                       const Eigen::Vector3d &point)
{
  if (!index_of.emplace(number, static_cast<int>(mesh.points.size())).second)
    text.fail("point " + std::to_string(number) +
              " is given twice; expected each number once: write one part alone");
  mesh.points.push_back(point);
}

int PointNumbers::index(MeshText &text, const long number) const
{
  const auto place = index_of.find(number);
  if (place == index_of.end())
    text.fail("an element names point " + std::to_string(number) +
              ", which the file does not give; expected one of its " +
              std::to_string(index_of.size()) + " points: write the file again");
  return place->second;
}

bool is_group_array(const std::string &name)
{
  const std::string known = lower(name);
  for (const char *its : {"materialid", "material", "material_id", "material_ids", "cellentityids",
                          "gmsh:physical", "medit:ref", "cell_tags", "group", "groups", "phase"})
    if (known == its)
      return true;
  return false;
}

int group_number(const MeshText &text, const double value)
{
  if (!(std::abs(value) <= 1e9) || value != std::round(value) || value < 0.)
    text.fail("found the group " + std::to_string(value) +
              "; expected a whole number from 0 to 1e9");
  return static_cast<int>(value);
}

bool add_vtk_cell(MeshText &text, RawMesh &mesh, const long type, const std::vector<long> &corners)
{
  if (type >= 1 && type <= 4) // vertices and lines
    return false;
  const std::size_t n = type == 5 ? 3 : (type == 9 || type == 8) ? 4 : 0;
  if (n == 0)
    text.fail("holds an element of VTK's type " + std::to_string(type) + straight_and_flat);
  if (corners.size() != n)
    text.fail("an element of VTK's type " + std::to_string(type) + " has " +
              std::to_string(corners.size()) + " corners; expected " + std::to_string(n));
  RawMesh::Cell cell{{0, 0, 0, 0}, static_cast<int>(n)};
  for (std::size_t k = 0; k < n; ++k)
  {
    if (corners[k] < 0 || static_cast<std::size_t>(corners[k]) >= mesh.points.size())
      text.fail("an element names point " + std::to_string(corners[k]) + "; expected 0 to " +
                std::to_string(static_cast<long>(mesh.points.size()) - 1));
    cell.corners[k] = static_cast<int>(corners[k]);
  }
  if (type == 8) // a pixel is numbered row by row
    std::swap(cell.corners[2], cell.corners[3]);
  mesh.cells.push_back(cell);
  return true;
}
} // namespace homespun::homogenization
