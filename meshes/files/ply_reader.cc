// SPDX-License-Identifier: MIT
// PLY as its authors describe it (Turk, The PLY Polygon File Format, 1994), text or binary
// little-endian.
#include "meshes/files/polygons.h"
#include "meshes/files/words.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/fault_list.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

namespace homespun::meshes
{
namespace
{
enum class Type
{
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  float32,
  float64
};

std::optional<Type> type_of(const std::string_view name)
{
  static constexpr std::pair<std::string_view, Type> names[] = {
    {"char", Type::int8},      {"int8", Type::int8},       {"uchar", Type::uint8},
    {"uint8", Type::uint8},    {"short", Type::int16},     {"int16", Type::int16},
    {"ushort", Type::uint16},  {"uint16", Type::uint16},   {"int", Type::int32},
    {"int32", Type::int32},    {"uint", Type::uint32},     {"uint32", Type::uint32},
    {"float", Type::float32},  {"float32", Type::float32}, {"double", Type::float64},
    {"float64", Type::float64}};
  for (const auto &[known, type] : names)
    if (known == name)
      return type;
  return {};
}

struct Property
{
  std::string name;
  Type type;
  std::optional<Type> count; ///< of a list: the type of its length
};

struct Element
{
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

class PlyReader
{
public:
  explicit PlyReader(const std::string &file)
      : file(file)
      , faults(file)
  {
    std::ifstream input(file, std::ios::binary);
    if (!input)
      throw BadInput(file + ": cannot be read; expected a PLY file: is the path right?");
    content.assign(std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>());
  }

  Polygons run()
  {
    read_header();
    bool has_vertices = false, has_faces = false;
    for (const Element &element : elements)
    {
      // Each row takes a byte at least: what says more than the file can hold is not reserved.
      if (!element.properties.empty() && element.count > content.size() - at)
        refuse("says that it has " + std::to_string(element.count) + " of `" + element.name +
               "`, in a file of " + std::to_string(content.size()) +
               " bytes: it is damaged, export it again");
      if (element.name == "vertex")
        has_vertices = read_vertices(element);
      else if (element.name == "face")
        has_faces = read_faces(element);
      else
        skip(element);
    }
    if (!has_vertices || !has_faces || mesh.faces.empty())
      refuse(std::string("has no ") +
             (!has_vertices ? "`vertex` with x, y and z" : "`face` with `vertex_indices`") +
             "; expected a mesh of triangles or quadrilaterals");
    check_indices();
    if (auto list = faults.take(); !list.empty())
      throw BadInput(std::move(list));
    return std::move(mesh);
  }

private:
  [[noreturn]] void refuse(const std::string &why) const
  {
    throw BadInput(file + ": " + why);
  }

  std::string_view next_line()
  {
    const std::size_t end = content.find('\n', at);
    if (end == std::string::npos)
      refuse("its header has no `end_header`; expected a PLY file: it is cut or of another kind");
    const std::string_view line = std::string_view(content).substr(at, end - at);
    at                          = end + 1;
    return line;
  }

  void read_header()
  {
    if (const auto words = words_of(next_line()); words.size() != 1 || words[0] != "ply")
      refuse("does not begin with `ply`; expected a PLY file");
    bool has_format = false;
    while (true)
    {
      const std::string_view line = next_line();
      const auto words            = words_of(line);
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info")
        continue;
      if (words[0] == "end_header")
        break;
      if (words[0] == "format" && words.size() == 3)
      {
        has_format = true;
        is_text    = words[1] == "ascii";
        if (!is_text && words[1] != "binary_little_endian")
          refuse("found format `" + std::string(words[1]) +
                 "`; expected ascii or binary_little_endian: export it as one of these");
      }
      else if (!read_declaration(words))
        refuse("found `" + std::string(line) +
               "` in its header; expected what a PLY header may hold: it is damaged, export it "
               "again");
    }
    if (!has_format)
      refuse("its header has no `format`; expected a PLY file");
  }

  /// `element NAME COUNT`, `property TYPE NAME` or `property list TYPE TYPE NAME`.
  bool read_declaration(const std::vector<std::string_view> &words)
  {
    if (words[0] == "element" && words.size() == 3)
    {
      Element element{std::string(words[1]), 0, {}};
      const auto [end, error] =
        std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
      elements.push_back(element);
      return error == std::errc() && end == words[2].data() + words[2].size();
    }
    if (words[0] != "property" || elements.empty())
      return false;
    const bool is_list = words.size() == 5 && words[1] == "list";
    if (!is_list && words.size() != 3)
      return false;
    const auto type  = type_of(words[is_list ? 3 : 1]);
    const auto count = is_list ? type_of(words[2]) : std::nullopt;
    if (!type || (is_list && !count))
      return false;
    elements.back().properties.push_back({std::string(words.back()), *type, count});
    return true;
  }

  template <typename Number>
  double number_from_bytes()
  {
    if (content.size() - at < sizeof(Number))
      refuse("ends within its numbers: it is cut, export it again");
    Number number;
    std::memcpy(&number, content.data() + at, sizeof(Number));
    at += sizeof(Number);
    return static_cast<double>(number);
  }

  double next(const Type type)
  {
    if (is_text)
      return next_word();
    switch (type)
    {
    case Type::int8:
      return number_from_bytes<std::int8_t>();
    case Type::uint8:
      return number_from_bytes<std::uint8_t>();
    case Type::int16:
      return number_from_bytes<std::int16_t>();
    case Type::uint16:
      return number_from_bytes<std::uint16_t>();
    case Type::int32:
      return number_from_bytes<std::int32_t>();
    case Type::uint32:
      return number_from_bytes<std::uint32_t>();
    case Type::float32:
      return number_from_bytes<float>();
    default:
      return number_from_bytes<double>();
    }
  }

  /// nan and inf are numbers here; what they stand for is refused by its name.
  double next_word()
  {
    at = std::min(content.find_first_not_of(" \t\r\n", at), content.size());
    if (at == content.size())
      refuse("ends within its numbers: it is cut, export it again");
    if (content[at] == '+')
      ++at;
    double number           = 0.;
    const char *const begin = content.data() + at;
    const auto [end, error] = std::from_chars(begin, content.data() + content.size(), number);
    const auto length       = static_cast<std::size_t>(end - begin);
    const bool is_word =
      at + length == content.size() ||
      std::string_view(" \t\r\n").find(content[at + length]) != std::string_view::npos;
    if (error != std::errc() || !is_word)
    {
      const std::size_t stop = std::min(content.find_first_of(" \t\r\n", at), content.size());
      refuse("found `" + content.substr(at, std::min<std::size_t>(stop - at, 40)) +
             "`; expected a number: it is damaged, export it again");
    }
    at += length;
    return number;
  }

  /// Length of a list that begins here; every entry takes a byte at least.
  std::size_t next_length(const Property &list)
  {
    const double length = next(*list.count);
    if (!(length >= 0.) || length != std::floor(length) ||
        length > static_cast<double>(content.size() - at))
      refuse("found a list `" + list.name + "` with a length of " + std::to_string(length) +
             ", in a file of " + std::to_string(content.size()) +
             " bytes: it is damaged, export it again");
    return static_cast<std::size_t>(length);
  }

  void skip(const Property &property)
  {
    const std::size_t n = property.count ? next_length(property) : 1;
    for (std::size_t k = 0; k < n; ++k)
      next(property.type);
  }

  void skip(const Element &element)
  {
    if (!element.properties.empty())
      for (std::size_t row = 0; row < element.count; ++row)
        for (const Property &property : element.properties)
          skip(property);
  }

  /// @return whether it has x, y and z
  bool read_vertices(const Element &element)
  {
    std::vector<int> column;
    int n_found = 0;
    for (const Property &property : element.properties)
    {
      const bool is_place = !property.count && property.name.size() == 1 &&
                            property.name[0] >= 'x' && property.name[0] <= 'z';
      column.push_back(is_place ? property.name[0] - 'x' : -1);
      n_found += is_place ? 1 : 0;
    }
    if (n_found != 3)
      return false;
    mesh.positions.setZero(static_cast<Eigen::Index>(element.count), 3);
    for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
    {
      for (std::size_t k = 0; k < column.size(); ++k)
        if (column[k] >= 0)
          mesh.positions(v, column[k]) = next(element.properties[k].type);
        else
          skip(element.properties[k]);
      if (!mesh.positions.row(v).allFinite())
        faults.add("positions that are not finite", "vertex " + std::to_string(v) + " is at (" +
                                                      std::to_string(mesh.positions(v, 0)) + ", " +
                                                      std::to_string(mesh.positions(v, 1)) + ", " +
                                                      std::to_string(mesh.positions(v, 2)) +
                                                      "); expected finite numbers");
    }
    return true;
  }

  /// @return whether it has a list of vertices
  bool read_faces(const Element &element)
  {
    bool has_list         = false;
    const auto is_corners = [](const Property &property)
    {
      return property.count &&
             (property.name == "vertex_indices" || property.name == "vertex_index");
    };
    for (const Property &property : element.properties)
      has_list = has_list || is_corners(property);
    if (!has_list)
      return false;
    mesh.faces.reserve(element.count);
    for (std::size_t row = 0; row < element.count; ++row)
      for (const Property &property : element.properties)
        if (is_corners(property))
          read_face(row, property);
        else
          skip(property);
    return true;
  }

  void read_face(const std::size_t row, const Property &list)
  {
    const std::size_t n = next_length(list);
    Polygon face        = {-1, -1, -1, -1};
    for (std::size_t k = 0; k < n; ++k)
    {
      const double corner = next(list.type);
      // What is no index becomes one that no vertex has.
      if (k < 4)
        face[k] = corner >= 0. && corner < 2147483647. && corner == std::floor(corner)
                    ? static_cast<int>(corner)
                    : 2147483647;
    }
    if (n != 3 && n != 4)
      faults.add("faces of other sizes", "face " + std::to_string(row) + " has " +
                                           std::to_string(n) +
                                           " corners; expected 3 or 4: triangulate the mesh");
    mesh.faces.push_back(face);
  }

  void check_indices()
  {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      for (const int corner : mesh.faces[f])
        if (corner >= mesh.positions.rows())
        {
          faults.add("faces with corners that do not exist",
                     "face " + std::to_string(f) +
                       " names a vertex that does not exist; expected 0 to " +
                       std::to_string(mesh.positions.rows() - 1));
          break;
        }
  }

  const std::string file;
  FaultList faults;
  std::string content;
  std::size_t at = 0; ///< of `content`, what is read next
  bool is_text   = false;
  std::vector<Element> elements;
  Polygons mesh;
};
} // namespace

Polygons read_ply(const std::string &file)
{
  return PlyReader(file).run();
}
} // namespace homespun::meshes
