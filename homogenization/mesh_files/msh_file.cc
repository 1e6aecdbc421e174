// SPDX-License-Identifier: MIT
// Gmsh's .msh as text: https://gmsh.info/doc/texinfo/gmsh.html#File-formats, and its legacy formats
// 1 and 2. Triangles may have six nodes: corners, then the middles of the sides.
#include "homogenization/mesh_files/mesh_formats.h"

#include <cmath>
#include <set>

namespace homespun::homogenization
{
namespace
{
/// Nodes of Gmsh's element types from 1 on; 0 where cells have no use for them.
constexpr std::array<int, 21> nodes_of_type = {2,  3,  4,  4, 8, 6,  5,  3,  6, 9, 10,
                                               27, 18, 14, 1, 8, 20, 15, 13, 9, 10};

/// Numbers of the points of elements, from 1 to 6 of them; more are refused before.
using Nodes = std::array<long, 6>;

/// Gmsh's types of the elements that cells are made of.
constexpr long triangle = 2, quadrilateral = 3, six_node_triangle = 9;

class MshReader
{
public:
  explicit MshReader(MeshText &text)
      : text(text)
  {
  }

  RawMesh read()
  {
    bool has_elements = false;
    for (std::string_view word = text.word(); !word.empty(); word = text.word())
      if (word == "$MeshFormat")
        format();
      else if (word == "$PhysicalNames")
        names();
      else if (word == "$Entities")
        entities("$EndEntities", false);
      else if (word == "$PartitionedEntities")
        entities("$EndPartitionedEntities", true);
      else if (word == "$Nodes" || word == "$NOD")
      {
        version = word == "$NOD" ? 1. : version;
        need_version();
        version < 4. ? nodes() : node_blocks();
      }
      else if (word == "$Elements" || word == "$ELM")
      {
        need_version();
        version < 4. ? elements() : element_blocks();
        has_elements = true;
      }
      else if (word == "$ElementData")
        element_data();
      else if (word[0] == '$')
        pass_over(std::string(word.substr(1)));
      else
        text.fail("found `" + std::string(word.substr(0, 40)) +
                  "`; expected a section like $Nodes: write the file again");
    if (!has_elements)
      text.fail(
        "found the end of the file; expected the section $Elements: it is cut off, write it again");
    if (!angle_of_element.empty())
      assign_angles();
    return std::move(mesh);
  }

private:
  void format()
  {
    version           = text.number("the version of the format");
    const long binary = text.integer("0 for text");
    text.integer("the size of a number");
    if (binary != 0)
      text.fail("is a binary .msh; expected text: save it as ASCII (Gmsh: Mesh.Binary = 0, or gmsh "
                "-2 without -bin)");
    const bool known = (version >= 2. && version < 3.) || std::abs(version - 4.) < 1e-9 ||
                       std::abs(version - 4.1) < 1e-9;
    if (!known)
      text.fail("found version " + std::to_string(version) +
                "; expected 2, 4.0 or 4.1: gmsh -2 -format msh41");
    close("$EndMeshFormat");
  }

  void need_version() const
  {
    if (version == 0.)
      text.fail("the section $MeshFormat is missing; expected it first: write the file again");
  }

  void close(const char *end)
  {
    const std::string_view found = text.word();
    if (found != end)
      text.fail("found " +
                (found.empty() ? std::string("the end of the file")
                               : "`" + std::string(found.substr(0, 40)) + "`") +
                "; expected " + end +
                ": the file is cut off or its counts are wrong, write it again");
  }

  void pass_over(const std::string &section)
  {
    const std::string end = "$End" + section;
    std::string_view line;
    while (text.line(line))
      if (line.substr(0, end.size()) == end)
        return;
    text.fail("found the end of the file; expected " + end);
  }

  void names()
  {
    const long n = text.count("names of physical groups");
    for (long k = 0; k < n; ++k)
    {
      const long dimension = text.integer("the dimension of a physical group");
      const long number    = text.integer("the number of a physical group");
      std::string_view rest;
      text.line(rest);
      const std::size_t first = rest.find('"'), last = rest.rfind('"');
      if (first == std::string_view::npos || last <= first)
        text.fail("found a physical group without a name in quotes; expected \"name\"");
      if (dimension == 2)
        mesh.number_of_name[std::string(rest.substr(first + 1, last - first - 1))] =
          group_number(text, static_cast<double>(number));
    }
    close("$EndPhysicalNames");
  }

  /// @param are_partitioned whether the mesh was cut into partitions: each surface is made of
  ///   entities, which have its groups and say before them of what they are parts
  void entities(const char *end, const bool are_partitioned)
  {
    need_version();
    if (are_partitioned)
    {
      text.integer("the number of partitions");
      text.skip(2 * text.count("ghost entities"), "a ghost entity");
    }
    std::array<long, 4> n{};
    for (long &its : n)
      its = text.count("entities");
    for (std::size_t dimension = 0; dimension < 4; ++dimension)
      for (long k = 0; k < n[dimension]; ++k)
      {
        const long tag = text.integer("the number of an entity");
        if (are_partitioned)
        {
          text.skip(2, "the entity that an entity is a part of");
          text.skip(text.count("partitions of an entity"), "a partition");
        }
        text.skip(dimension == 0 && version > 4.05 ? 3 : 6, "the box of an entity");
        const long n_groups = text.count("physical groups of an entity");
        for (long g = 0; g < n_groups; ++g)
        {
          // Negative numbers mean a reversed surface.
          const long group = std::abs(text.integer("the number of a physical group"));
          if (dimension == 2)
            groups_of_surface[tag].insert(group_number(text, static_cast<double>(group)));
        }
        if (dimension > 0)
          text.skip(text.count("entities that bound another"), "the number of an entity");
      }
    close(end);
  }

  Eigen::Vector3d point()
  {
    Eigen::Vector3d x;
    for (double &component : x)
      component = text.number("a coordinate", mesh.digits);
    return x;
  }

  void nodes()
  {
    const long n = text.count("points");
    mesh.points.reserve(static_cast<std::size_t>(n));
    for (long k = 0; k < n; ++k)
    {
      const long number = text.integer("the number of a point");
      numbers.add(text, mesh, number, point());
    }
    close(version < 2. ? "$ENDNOD" : "$EndNodes");
  }

  struct Block
  {
    long entity, dimension, property, n;
  };

  /// The number of blocks of points or elements of a file of version 4.
  /// @param range what is passed over
  long blocks(const char *items, const char *range)
  {
    const long n = text.count("blocks");
    text.count(items);
    if (version > 4.05)
      text.skip(2, range);
    return n;
  }

  /// The first line of a block; 4.0 and 4.1 have entity and dimension in another order.
  Block block(const char *property, const char *items)
  {
    Block its{};
    its.entity    = text.integer("the entity of a block");
    its.dimension = text.integer("the entity of a block");
    if (version > 4.05)
      std::swap(its.entity, its.dimension);
    its.property = text.integer(property);
    its.n        = text.count(items);
    return its;
  }

  void node_blocks()
  {
    const bool is_new = version > 4.05;
    for (long rest = blocks("points", "the range of the numbers of points"); rest > 0; --rest)
    {
      const auto [entity, dimension, parametric, n] =
        block("whether points are parametric", "points");
      const long extra = parametric != 0 ? std::clamp(dimension, 0L, 3L) : 0;
      std::vector<long> tags;
      if (is_new)
        for (long k = 0; k < n; ++k)
          tags.push_back(text.integer("the number of a point"));
      for (long k = 0; k < n; ++k)
      {
        const long tag =
          is_new ? tags[static_cast<std::size_t>(k)] : text.integer("the number of a point");
        const Eigen::Vector3d x = point();
        text.skip(extra, "a parametric coordinate");
        numbers.add(text, mesh, tag, x);
      }
    }
    close("$EndNodes");
  }

  int nodes_of(const long type) const
  {
    if (type < 1 || type > static_cast<long>(nodes_of_type.size()))
      text.fail("holds an element of Gmsh's type " + std::to_string(type) + straight_and_flat);
    const bool is_needless = type == 1 || type == 15 || type == 8;
    if (!is_needless && type != triangle && type != quadrilateral && type != six_node_triangle)
      text.fail("holds an element of Gmsh's type " + std::to_string(type) + straight_and_flat);
    return nodes_of_type[static_cast<std::size_t>(type - 1)];
  }

  void add(const long element, const long type, const long group)
  {
    const int n = nodes_of(type);
    Nodes nodes{};
    for (int k = 0; k < n; ++k)
      nodes[static_cast<std::size_t>(k)] = text.integer("the number of a point of an element");
    if (type != triangle && type != quadrilateral && type != six_node_triangle)
      return;
    const int n_corners = type == quadrilateral ? 4 : 3;
    RawMesh::Cell cell{{0, 0, 0, 0}, n_corners, group_number(text, static_cast<double>(group))};
    for (std::size_t k = 0; k < static_cast<std::size_t>(n_corners); ++k)
      cell.corners[k] = numbers.index(text, nodes[k]);
    for (std::size_t k = 0; type == six_node_triangle && k < 3; ++k)
      cell.middles[k] = numbers.index(text, nodes[k + 3]);
    mesh.cells.push_back(cell);
    element_of_cell.push_back(element);
  }

  void elements()
  {
    const long n = text.count("elements");
    for (long k = 0; k < n; ++k)
    {
      const long element = text.integer("the number of an element");
      const long type    = text.integer("the type of an element");
      long group         = 0;
      if (version < 2.)
      {
        group = text.integer("the physical number of an element");
        text.skip(2, "the entity and the number of points of an element");
      }
      else
      {
        const long n_tags = text.count("tags of an element");
        for (long tag = 0; tag < n_tags; ++tag)
        {
          const long value = text.integer("a tag of an element");
          group            = tag == 0 ? value : group;
        }
      }
      add(element, type, std::abs(group));
    }
    close(version < 2. ? "$ENDELM" : "$EndElements");
  }

  /// The physical group of a surface, 0 where it has none.
  int group_of_surface(const long surface) const
  {
    const auto groups = groups_of_surface.find(surface);
    if (groups == groups_of_surface.end() || groups->second.size() == 1)
      return groups == groups_of_surface.end() ? 0 : *groups->second.begin();
    std::string names;
    for (const int number : groups->second)
    {
      std::string name = std::to_string(number);
      for (const auto &[its_name, its_number] : mesh.number_of_name)
        name = its_number == number ? its_name : name;
      names += (names.empty() ? "`" : " and `") + name + "`";
    }
    text.fail("surface " + std::to_string(surface) + " is in the groups " + names +
              "; expected one group for each surface: take it out of the others "
              "(`Physical Surface`)");
  }

  void element_blocks()
  {
    for (long rest = blocks("elements", "the range of the numbers of elements"); rest > 0; --rest)
    {
      const auto [entity, dimension, type, n] = block("the type of elements", "elements");
      const int group                         = dimension == 2 ? group_of_surface(entity) : 0;
      for (long k = 0; k < n; ++k)
      {
        const long element = text.integer("the number of an element");
        add(element, type, group);
      }
    }
    close("$EndElements");
  }

  /// Data of elements: names, real numbers (the time), whole numbers (the step, the components, the
  /// number of elements), then a line per element. Those called `angle` are kept.
  void element_data()
  {
    const long n_names = text.count("names of data");
    std::string_view line, name;
    text.line(line);
    for (long k = 0; k < n_names && text.line(line); ++k)
      name = k == 0 ? line : name;
    const std::size_t first = name.find('"'), last = name.rfind('"');
    if (first == last || lower(name.substr(first + 1, last - first - 1)) != "angle")
    {
      if (first != last)
        mesh.other_data.emplace_back(name.substr(first + 1, last - first - 1));
      return pass_over("ElementData");
    }
    text.skip(text.count("real numbers of data"), "the time of data");
    const long n_integers = text.count("whole numbers of data");
    if (n_integers < 3)
      text.fail("found " + std::to_string(n_integers) +
                " whole numbers of `angle`; expected 3: step, components and number of elements");
    text.skip(1, "the step of data");
    const long components = text.integer("the components of data");
    if (components != 1)
      text.fail("found `angle` with " + std::to_string(components) +
                " components; expected one number [deg] per element");
    const long n = text.count("elements with data");
    text.skip(n_integers - 3, "a partition");
    for (long k = 0; k < n; ++k)
    {
      const long element = text.integer("the number of an element");
      if (!angle_of_element.emplace(element, text.number("an angle")).second)
        text.fail("element " + std::to_string(element) +
                  " has two values of `angle`; expected one: leave other time steps out");
    }
    close("$EndElementData");
  }

  /// Only at the end: data may stand before their elements.
  void assign_angles()
  {
    for (const long element : element_of_cell)
    {
      const auto angle = angle_of_element.find(element);
      if (angle == angle_of_element.end())
        text.fail("element " + std::to_string(element) +
                  " has no value in $ElementData `angle`; expected one for every triangle and "
                  "quadrilateral: 0 where a group has no direction");
      mesh.angles.push_back(angle->second);
    }
  }

  MeshText &text;
  double version = 0.;
  RawMesh mesh;
  PointNumbers numbers;
  std::unordered_map<long, std::set<int>> groups_of_surface;
  std::vector<long> element_of_cell;
  std::unordered_map<long, double> angle_of_element; ///< [deg]
};
} // namespace

RawMesh read_msh(MeshText &text)
{
  return MshReader(text).read();
}
} // namespace homespun::homogenization
