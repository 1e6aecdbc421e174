// SPDX-License-Identifier: MIT
#include "homogenization/mesh_files/mesh_formats.h"

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

int group_number(const MeshText &text, const double value)
{
  if (!(std::abs(value) <= 1e9) || value != std::round(value) || value < 0.)
    text.fail("found the group " + std::to_string(value) +
              "; expected a whole number from 0 to 1e9");
  return static_cast<int>(value);
}
} // namespace homespun::homogenization
