// SPDX-License-Identifier: MIT
// I-DEAS universal files: datasets between lines of -1; points 2411, elements 2412, groups 2467 or
// 2477.
#include "homogenization/cell/mesh_formats.h"
#include "homogenization/cell/parameter_text.h"

namespace homespun::homogenization
{
namespace
{
class UnvReader
{
public:
  explicit UnvReader(MeshText &text)
      : text(text)
  {
  }

  RawMesh read()
  {
    std::string_view line;
    while (text.line(line))
    {
      if (trimmed(std::string(line)) != "-1")
        continue;
      const long dataset = text.integer("the number of a dataset");
      text.line(line);
      if (dataset == 2411 || dataset == 781)
        points();
      else if (dataset == 2412)
        elements();
      else if (dataset == 2452 || dataset == 2467 || dataset == 2477)
        groups();
      else
        pass_over();
    }
    for (const Member &member : members)
      assign(member);
    // Properties count only where a file has no groups of elements.
    if (!group_of.empty())
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
        if (group_of.count(cell) == 0)
          mesh.cells[cell].group = 0;
    return std::move(mesh);
  }

private:
  /// Whether the dataset ends here; its last line is then read.
  bool ends()
  {
    if (text.at_end())
      text.fail(
        "found the end of the file inside a dataset; expected -1: it is cut off, write it again");
    if (trimmed(std::string(text.peek_line())) != "-1")
      return false;
    std::string_view line;
    text.line(line);
    return true;
  }

  void pass_over()
  {
    std::string_view line;
    while (!ends())
      text.line(line);
  }

  void finish_line()
  {
    std::string_view line;
    text.line(line);
  }

  void points()
  {
    while (!ends())
    {
      const long number = text.integer("the number of a point");
      finish_line();
      Eigen::Vector3d x;
      for (double &component : x)
        component = text.number("a coordinate");
      finish_line();
      numbers.add(text, mesh, number, x);
    }
  }

  void elements()
  {
    while (!ends())
    {
      const long number   = text.integer("the number of an element");
      const long type     = text.integer("the type of an element");
      const long property = text.integer("the physical property of an element");
      text.skip(2, "material and colour of an element");
      const long n = text.count("points of an element");
      finish_line();
      if (type < 40 || type >= 120) // rods and beams; springs and masses
      {
        if (type == 11 || (type >= 21 && type <= 24))
          finish_line();
        text.skip(n, "the points of an element");
        finish_line();
        continue;
      }
      if (type > 99 || (n != 3 && n != 4))
        text.fail("holds an element of type " + std::to_string(type) + " with " +
                  std::to_string(n) + " points" + straight_and_flat);
      RawMesh::Cell cell{
        {0, 0, 0, 0}, static_cast<int>(n), group_number(text, static_cast<double>(property))};
      for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k)
        cell.corners[k] = numbers.index(text, text.integer("the number of a point of an element"));
      finish_line();
      if (!index_of.emplace(number, mesh.cells.size()).second)
        text.fail("element " + std::to_string(number) +
                  " is given twice; expected each number once");
      mesh.cells.push_back(cell);
    }
  }

  /// A group: eight numbers, the last of which counts its members; a name; members of four numbers,
  /// type 8 elements.
  void groups()
  {
    while (!ends())
    {
      const long group = text.integer("the number of a group");
      text.skip(6, "the head of a group");
      const long n = text.count("members of a group");
      finish_line();
      std::string_view line;
      text.line(line);
      const std::string name = trimmed(std::string(line));
      for (long k = 0; k < n; ++k)
      {
        const long kind   = text.integer("the kind of a member"),
                   number = text.integer("the number of a member");
        text.skip(2, "the rest of a member");
        if (kind == 8)
          members.push_back({number, group_number(text, static_cast<double>(group)), name});
      }
      if (n > 0)
        finish_line();
    }
  }

  struct Member
  {
    long element;
    int group;
    std::string name;
  };

  /// Only at the end: groups may stand before the elements.
  void assign(const Member &member)
  {
    const auto cell = index_of.find(member.element);
    if (cell == index_of.end())
      return;
    mesh.cells[cell->second].group = member.group;
    const auto [place, is_new]     = group_of.emplace(cell->second, member.name);
    if (!is_new && place->second != member.name)
      text.fail("element " + std::to_string(member.element) + " is in the groups `" +
                place->second + "` and `" + member.name +
                "`; expected one group per element, that of its material: remove the other one");
    if (!member.name.empty())
      mesh.number_of_name[member.name] = member.group;
  }

  MeshText &text;
  RawMesh mesh;
  PointNumbers numbers;
  std::unordered_map<long, std::size_t> index_of;
  std::vector<Member> members;
  std::unordered_map<std::size_t, std::string> group_of;
};
} // namespace

RawMesh read_unv(MeshText &text)
{
  return UnvReader(text).read();
}
} // namespace homespun::homogenization
