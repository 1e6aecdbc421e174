// SPDX-License-Identifier: MIT
// Abaqus' input deck, as far as it is a mesh: *NODE, *ELEMENT, *ELSET. All else is passed over.
#include "homogenization/mesh_formats.h"
#include "homogenization/parameter_text.h"

namespace homespun::homogenization
{
namespace
{
/// `*KEYWORD, NAME=value, FLAG` as keyword and parameters, in lower case but for the values.
struct Keyword
{
  explicit Keyword(const std::string_view line)
  {
    for (const std::string &part : split(std::string(line.substr(1)), ','))
    {
      const std::size_t equal = part.find('=');
      const std::string key   = lower(trimmed(part.substr(0, equal)));
      if (name.empty())
        name = key;
      else
        parameters[key] = equal == std::string::npos ? "" : trimmed(part.substr(equal + 1));
    }
  }

  std::string value(const std::string &key) const
  {
    const auto place = parameters.find(key);
    return place == parameters.end() ? "" : place->second;
  }

  std::string name;
  std::map<std::string, std::string> parameters;
};

/// Corners of an element type, 0 for lines and points.
int corners_of(const MeshText &text, const std::string &type)
{
  const std::string known = lower(type);
  const auto begins_with  = [&](const char *start) { return known.rfind(start, 0) == 0; };
  for (const char *start : {"t2d2", "t3d2", "b2", "b3", "mass", "spring", "dashpot", "conn"})
    if (begins_with(start))
      return 0;
  for (const char *start : {"cps", "cpe", "m3d", "stri", "ds", "s", "r3d", "dc2d"})
    if (begins_with(start))
    {
      const std::size_t digit = std::string(start).size();
      const bool ends =
        digit + 1 >= known.size() || !std::isdigit(static_cast<unsigned char>(known[digit + 1]));
      if (digit < known.size() && ends && (known[digit] == '3' || known[digit] == '4'))
        return known[digit] - '0';
    }
  text.fail("holds elements of Abaqus' type `" + type + "`" + straight_and_flat);
}

class AbaqusReader
{
public:
  explicit AbaqusReader(MeshText &text)
      : text(text)
  {
  }

  RawMesh read()
  {
    std::string_view line;
    while (text.line(line))
    {
      if (line.size() < 2 || line[0] != '*' || line[1] == '*')
        continue;
      const Keyword keyword(line);
      if (keyword.name == "node")
        nodes();
      else if (keyword.name == "element")
        elements(keyword);
      else if (keyword.name == "elset")
        element_set(keyword);
      else if (keyword.name == "include")
        text.fail("found *INCLUDE; expected one whole file: insert the other one");
    }
    assign_groups();
    return std::move(mesh);
  }

private:
  /// Hands on the numbers of each data line until the next keyword.
  template <typename Action>
  void for_each_data_line(const Action &action)
  {
    std::string_view line;
    while (!text.at_end() && (text.peek_line().empty() || text.peek_line()[0] != '*' ||
                              text.peek_line().substr(0, 2) == "**"))
    {
      text.line(line);
      if (trimmed(std::string(line)).empty() || line.substr(0, 2) == "**")
        continue;
      action(split(std::string(line), ','));
    }
  }

  long integer(const std::vector<std::string> &values, const std::size_t k) const
  {
    long value = 0;
    if (k >= values.size() || !to_integer(values[k], value))
      text.fail("found `" + (k < values.size() ? values[k].substr(0, 40) : std::string()) +
                "`; expected a whole number");
    return value;
  }

  void nodes()
  {
    for_each_data_line(
      [&](const std::vector<std::string> &values)
      {
        Eigen::Vector3d x(0., 0., 0.);
        for (std::size_t k = 1; k < 4; ++k)
          if (!(k < values.size() && to_number(values[k], x(static_cast<Eigen::Index>(k) - 1))) &&
              !(k == 3 && (values.size() == 3 || values[3].empty())))
            text.fail("found a point without its coordinates; expected `number, x, y, z`");
        numbers.add(text, mesh, integer(values, 0), x);
      });
  }

  void elements(const Keyword &keyword)
  {
    const int n           = corners_of(text, keyword.value("type"));
    const std::string set = keyword.value("elset");
    for_each_data_line(
      [&](const std::vector<std::string> &values)
      {
        if (n == 0)
          return;
        RawMesh::Cell cell{{0, 0, 0, 0}, n};
        for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k)
          cell.corners[k] = numbers.index(text, integer(values, k + 1));
        if (!index_of.emplace(integer(values, 0), mesh.cells.size()).second)
          text.fail("element " + values[0] +
                    " is given twice; expected each number once: write one part alone");
        mesh.cells.push_back(cell);
        own_set.push_back(set);
      });
  }

  void element_set(const Keyword &keyword)
  {
    const std::string name = keyword.value("elset");
    const bool generates   = keyword.parameters.count("generate") != 0;
    for_each_data_line(
      [&](const std::vector<std::string> &values)
      {
        if (generates)
        {
          const long first = integer(values, 0), last = integer(values, 1);
          const long step = values.size() > 2 && !values[2].empty() ? integer(values, 2) : 1;
          if (step < 1 || (last - first) / step > static_cast<long>(text.content.size()))
            text.fail("found a range of elements without end; expected `first, last, step`");
          for (long number = first; number <= last; number += step)
            put(number, name);
          return;
        }
        long number = 0;
        for (const std::string &value : values)
          if (to_integer(value, number))
            put(number, name);
      });
  }

  /// A set may hold lines as well, which cells have no use for.
  void put(const long number, const std::string &name)
  {
    const auto cell = index_of.find(number);
    if (cell == index_of.end())
      return;
    const auto [place, is_new] = named_set.emplace(cell->second, name);
    if (!is_new && place->second != name)
      text.fail("element " + std::to_string(number) + " is in the sets `" + place->second +
                "` and `" + name +
                "`; expected one set per element, that of its material: remove the other *ELSET");
  }

  void assign_groups()
  {
    const auto number_of = [&](const std::string &name)
    {
      return mesh.number_of_name.emplace(name, static_cast<int>(mesh.number_of_name.size()) + 1)
        .first->second;
    };
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    {
      const auto named       = named_set.find(c);
      const std::string &set = named != named_set.end() ? named->second : own_set[c];
      mesh.cells[c].group    = set.empty() ? 0 : number_of(set);
    }
  }

  MeshText &text;
  RawMesh mesh;
  PointNumbers numbers;
  std::unordered_map<long, std::size_t> index_of;
  std::vector<std::string> own_set; ///< of *ELEMENT, per cell
  std::unordered_map<std::size_t, std::string> named_set;
};
} // namespace

RawMesh read_abaqus(MeshText &text)
{
  return AbaqusReader(text).read();
}
} // namespace homespun::homogenization
