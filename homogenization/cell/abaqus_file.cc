// SPDX-License-Identifier: MIT
// Abaqus' input deck, as far as it is a mesh: *NODE, *ELEMENT, *ELSET. What would make or move
// points and elements is refused, all else passed over.
#include "homogenization/cell/mesh_formats.h"
#include "homogenization/cell/parameter_text.h"

#include <limits>
#include <set>

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

/// Keywords that make or move points and elements by rules.
bool is_generator(const std::string &keyword)
{
  for (const char *name :
       {"system", "ngen", "ncopy", "nfill", "nmap", "elgen", "elcopy", "element generation"})
    if (keyword == name)
      return true;
  return false;
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
      std::string whole(line);
      while (!trimmed(whole).empty() && trimmed(whole).back() == ',' && text.line(line))
        whole += line;
      const Keyword keyword(whole);
      const bool is_mesh =
        keyword.name == "node" || keyword.name == "element" || keyword.name == "elset";
      if (keyword.name == "include" || (is_mesh && keyword.parameters.count("input") > 0))
        text.fail("found data in another file; expected one whole file: insert the other one");
      if (is_generator(keyword.name))
        text.fail("found *" + keyword.name +
                  ", which makes or moves points or elements; expected all of them in *NODE and "
                  "*ELEMENT: let the program that wrote the file write the mesh itself");
      if (keyword.name == "node")
        nodes(keyword);
      else if (keyword.name == "element")
        elements(keyword);
      else if (keyword.name == "elset")
        element_set(keyword);
      else if (keyword.name == "instance")
        instance();
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

  /// An instance may stand anywhere but where its part was drawn.
  void instance()
  {
    for_each_data_line(
      [&](const std::vector<std::string> &)
      {
        text.fail("found an *INSTANCE that moves or turns its part; expected a part where it was "
                  "drawn: leave out the lines after *INSTANCE");
      });
  }

  void nodes(const Keyword &keyword)
  {
    const std::string system = lower(keyword.value("system"));
    if (!system.empty() && system != "r")
      text.fail(
        "found points in cylindrical or spherical coordinates; expected x, y and z: leave out "
        "SYSTEM");
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
        number_of_cell.push_back(integer(values, 0));
      });
  }

  /// Members of a set: the elements first, first + step, ..., last, or those of another set.
  struct Members
  {
    long first = 0, last = 0, step = 1;
    std::string set;
  };

  void element_set(const Keyword &keyword)
  {
    std::vector<Members> &members = sets[keyword.value("elset")];
    const bool generates          = keyword.parameters.count("generate") != 0;
    for_each_data_line(
      [&](const std::vector<std::string> &values)
      {
        if (generates)
        {
          const bool has_step = values.size() > 2 && !values[2].empty();
          const Members range{integer(values, 0), integer(values, 1),
                              has_step ? integer(values, 2) : 1, ""};
          if (range.step < 1 || range.first < 1 || range.last < range.first ||
              range.last > std::numeric_limits<int>::max())
            text.fail("found the range `" + values[0] + ", " + values[1] +
                      "` of elements; expected `first, last, step`, positive and rising");
          members.push_back(range);
          return;
        }
        for (const std::string &value : values)
        {
          long number = 0;
          if (to_integer(value, number) && number > 0 && number <= std::numeric_limits<int>::max())
            members.push_back({number, number, 1, ""});
          else if (!value.empty())
            members.push_back({0, 0, 1, value});
        }
      });
  }

  /// The elements of a set and of the sets in it become those of the set `name`. Lines, which cells
  /// have no use for, are passed over.
  void put(const std::string &set, const std::string &name, std::set<std::string> &done)
  {
    if (!done.insert(set).second)
      return;
    bool is_known = false;
    for (std::size_t cell = 0; cell < own_set.size(); ++cell)
      if (own_set[cell] == set)
      {
        is_known = true;
        put(cell, name);
      }
    const auto found = sets.find(set);
    if (found == sets.end())
    {
      if (!is_known)
        text.fail("*ELSET `" + name + "` holds `" + set +
                  "`, which is neither a number nor a set; expected elements or sets of them");
      return;
    }
    for (const Members &members : found->second)
      if (!members.set.empty())
        put(members.set, name, done);
      else
        for (const auto &[number, cell] : within(members))
          put(cell, name);
  }

  /// Those elements of a range that there are, however long it is.
  std::vector<std::pair<long, std::size_t>> within(const Members &range) const
  {
    std::vector<std::pair<long, std::size_t>> found;
    if ((range.last - range.first) / range.step < static_cast<long>(index_of.size()))
    {
      for (long number = range.first; number <= range.last; number += range.step)
        if (const auto cell = index_of.find(number); cell != index_of.end())
          found.push_back(*cell);
      return found;
    }
    for (const auto &element : index_of)
      if (element.first >= range.first && element.first <= range.last &&
          (element.first - range.first) % range.step == 0)
        found.push_back(element);
    return found;
  }

  void put(const std::size_t cell, const std::string &name)
  {
    const auto [place, is_new] = named_set.emplace(cell, name);
    if (!is_new && place->second != name)
      text.fail("element " + std::to_string(number_of_cell[cell]) + " is in the sets `" +
                place->second + "` and `" + name +
                "`; expected one set per element, that of its material: remove the other *ELSET");
  }

  /// Only at the end: sets may stand before their elements. A set that others hold stands for them
  /// alone.
  void assign_groups()
  {
    std::set<std::string> is_held;
    for (const auto &[name, members] : sets)
      for (const Members &its : members)
        is_held.insert(its.set);
    for (const auto &[name, members] : sets)
      if (is_held.count(name) == 0)
      {
        std::set<std::string> done;
        put(name, name, done);
      }
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
  std::vector<long> number_of_cell;
  std::map<std::string, std::vector<Members>> sets; ///< of *ELSET
  std::unordered_map<std::size_t, std::string> named_set;
};
} // namespace

RawMesh read_abaqus(MeshText &text)
{
  return AbaqusReader(text).read();
}
} // namespace homespun::homogenization
