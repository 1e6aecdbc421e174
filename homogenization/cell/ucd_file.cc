// SPDX-License-Identifier: MIT
// AVS UCD as text, *.ucd and *.inp: counts, points, elements `number material type points...`.
#include "homogenization/cell/mesh_formats.h"

namespace homespun::homogenization
{
RawMesh read_ucd(MeshText &text)
{
  std::string_view line;
  while (!text.at_end() &&
         (text.peek_line().empty() || text.peek_line()[0] == '#' || text.peek_line() == "\r"))
    text.line(line);
  const long n_points = text.count("points"), n_elements = text.count("elements");
  text.skip(3, "the numbers of data");
  RawMesh mesh;
  PointNumbers numbers;
  for (long k = 0; k < n_points; ++k)
  {
    const long number = text.integer("the number of a point");
    Eigen::Vector3d x;
    for (double &component : x)
      component = text.number("a coordinate");
    numbers.add(text, mesh, number, x);
  }
  for (long k = 0; k < n_elements; ++k)
  {
    text.integer("the number of an element");
    const long material    = text.integer("the material of an element");
    const std::string type = lower(text.word());
    if (type == "pt" || type == "line")
    {
      text.skip(type == "pt" ? 1 : 2, "the points of an element");
      continue;
    }
    if (type != "tri" && type != "quad")
      text.fail("holds an element of type `" + type.substr(0, 40) + "`" + straight_and_flat);
    RawMesh::Cell cell{
      {0, 0, 0, 0}, type == "tri" ? 3 : 4, group_number(text, static_cast<double>(material))};
    for (std::size_t c = 0; c < static_cast<std::size_t>(cell.n_corners); ++c)
      cell.corners[c] = numbers.index(text, text.integer("the number of a point of an element"));
    mesh.cells.push_back(cell);
  }
  return mesh;
}
} // namespace homespun::homogenization
