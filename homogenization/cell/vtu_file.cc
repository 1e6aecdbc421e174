// SPDX-License-Identifier: MIT
// VTK's XML format .vtu: https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html.
// Numbers stand in it as text, as base64, or appended at the end, raw or as base64; the latter
// three may be compressed in blocks by zlib.
#include "homogenization/cell/mesh_formats.h"
#include "homogenization/cell/parameter_text.h"

#include <zlib.h>

#include <cstring>

namespace homespun::homogenization
{
namespace
{
using Bytes = std::string;

/// An opening tag: its name and its attributes.
struct Tag
{
  std::string name;
  std::map<std::string, std::string> attributes;

  std::string operator[](const std::string &key) const
  {
    const auto place = attributes.find(key);
    return place == attributes.end() ? "" : place->second;
  }
};

/// Decodes base64 from `place` on, up to padding, a character that is none of it, or `wanted`
/// bytes.
Bytes decoded(const std::string_view text, std::size_t &place, const std::size_t wanted)
{
  static const std::string alphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  Bytes bytes;
  while (bytes.size() < wanted && place + 4 <= text.size())
  {
    unsigned int value = 0;
    int n              = 0;
    for (int k = 0; k < 4; ++k)
    {
      const char c          = text[place + static_cast<std::size_t>(k)];
      const std::size_t bit = alphabet.find(c);
      if (bit == std::string::npos && c != '=')
        return bytes;
      value = (value << 6) | (c == '=' ? 0u : static_cast<unsigned int>(bit));
      n += c == '=' ? 0 : 1;
    }
    place += 4;
    for (int k = 0; k < n - 1; ++k)
      bytes.push_back(static_cast<char>((value >> (16 - 8 * k)) & 0xffu));
    if (n < 4)
      break;
  }
  return bytes;
}

class VtuReader
{
public:
  explicit VtuReader(const std::string &file)
      : text(file)
      , content(text.content)
  {
  }

  RawMesh read()
  {
    std::string section;
    std::size_t place = 0;
    while ((place = content.find('<', place)) != std::string_view::npos)
    {
      if (content.substr(place, 4) == "<!--")
      {
        place = content.find("-->", place);
        continue;
      }
      const std::size_t end = content.find('>', place);
      if (end == std::string_view::npos)
        text.fail(
          "found a tag that is not closed; expected `>`: the file is cut off, write it again");
      const Tag tag = parsed(content.substr(place + 1, end - place - 1));
      place         = end + 1;
      if (tag.name == "VTKFile")
        head(tag);
      else if (tag.name == "Piece")
        ++n_pieces;
      else if (tag.name == "AppendedData")
      {
        appended_is_raw  = tag["encoding"] == "raw";
        const auto start = content.find('_', place);
        if (start == std::string_view::npos)
          text.fail("found no `_` in AppendedData; expected the data after it");
        appended = content.substr(start + 1);
        break;
      }
      else if (tag.name == "DataArray")
        arrays[section + "/" + lower(tag["Name"])] = {tag, place};
      else if (tag.name == "Points" || tag.name == "Cells" || tag.name == "CellData" ||
               tag.name == "PointData" || tag.name == "FieldData")
        section = tag.name;
    }
    if (n_pieces != 1)
      text.fail("holds " + std::to_string(n_pieces) +
                " pieces; expected an UnstructuredGrid of one");
    return assembled();
  }

private:
  struct Array
  {
    Tag tag;
    std::size_t place; ///< after its tag
  };

  static Tag parsed(std::string_view inside)
  {
    Tag tag;
    std::size_t k = inside.find_first_of(" \t\r\n/");
    tag.name      = std::string(inside.substr(0, k));
    while (k < inside.size())
    {
      const std::size_t equal = inside.find('=', k);
      if (equal == std::string_view::npos)
        break;
      const std::size_t open = inside.find_first_of("\"'", equal);
      if (open == std::string_view::npos)
        break;
      const std::size_t shut = inside.find(inside[open], open + 1);
      if (shut == std::string_view::npos)
        break;
      tag.attributes[trimmed(std::string(inside.substr(k, equal - k)))] =
        std::string(inside.substr(open + 1, shut - open - 1));
      k = shut + 1;
      while (k < inside.size() && std::isspace(static_cast<unsigned char>(inside[k])))
        ++k;
    }
    return tag;
  }

  void head(const Tag &tag)
  {
    if (tag["type"] != "UnstructuredGrid")
      text.fail("holds `" + tag["type"].substr(0, 40) + "`; expected UnstructuredGrid");
    if (tag["byte_order"] == "BigEndian")
      text.fail("holds big-endian numbers; expected LittleEndian: write it on a usual processor, "
                "or as text");
    header_size   = tag["header_type"] == "UInt64" ? 8 : 4;
    is_compressed = !tag["compressor"].empty();
    if (is_compressed && tag["compressor"] != "vtkZLibDataCompressor")
      text.fail("is compressed by `" + tag["compressor"].substr(0, 40) +
                "`; expected zlib or no compression");
  }

  std::uint64_t header_number(const Bytes &bytes, const std::size_t k) const
  {
    std::uint64_t value = 0;
    if ((k + 1) * header_size > bytes.size())
      text.fail(
        "found data that end early; expected their length before them: write the file again");
    std::memcpy(&value, bytes.data() + k * header_size, header_size); // little-endian
    return value;
  }

  /// The bytes of an array, whatever its coding.
  Bytes bytes_of(const std::string_view source, std::size_t place, const bool is_raw)
  {
    const auto take = [&](const std::size_t n)
    {
      if (!is_raw)
        return decoded(source, place, n);
      const Bytes its(source.substr(std::min(place, source.size()), n));
      place += n;
      return its;
    };
    if (!is_raw)
      while (place < source.size() && std::isspace(static_cast<unsigned char>(source[place])))
        ++place;
    if (!is_compressed)
    {
      // In base64, length and data are one stream; what was decoded beyond the length belongs to
      // the data.
      const std::size_t start = place;
      const std::uint64_t n   = header_number(take(header_size), 0);
      if (n > source.size())
        text.fail("found data of " + std::to_string(n) +
                  " bytes; expected at most the size of the file");
      place       = start;
      Bytes whole = take(header_size + n);
      if (whole.size() < header_size + n)
        text.fail(
          "found data that end early: the file is cut off; expected a whole one, write it again");
      return whole.substr(header_size, n);
    }
    // Blocks: their number, their size, the size of the last one, the compressed size of each.
    const std::size_t start = place;
    const std::uint64_t n   = header_number(take(header_size), 0);
    if (n > source.size())
      text.fail("found " + std::to_string(n) +
                " compressed blocks; expected at most the size of the file");
    place              = start;
    const Bytes header = take((3 + n) * header_size);
    Bytes result;
    std::vector<std::uint64_t> sizes;
    std::uint64_t all = 0;
    for (std::size_t b = 0; b < n; ++b)
    {
      sizes.push_back(header_number(header, 3 + b));
      if (sizes.back() > source.size())
        text.fail(
          "found a compressed block larger than the file; expected a whole file, write it again");
      all += sizes.back();
    }
    const std::uint64_t usual = n > 0 ? header_number(header, 1) : 0,
                        last  = n > 0 ? header_number(header, 2) : 0;
    const Bytes packed        = take(all);
    std::size_t from          = 0;
    for (std::size_t b = 0; b < n; ++b)
    {
      const std::uint64_t size = b + 1 == n && last > 0 ? last : usual;
      // zlib packs no denser than 1032 to 1.
      if (from + sizes[b] > packed.size() || size > 1032 * (sizes[b] + 64))
        text.fail("found compressed data that end early; expected a whole file, write it again");
      Bytes block(size, '\0');
      uLongf length = size;
      if (uncompress(reinterpret_cast<Bytef *>(block.data()), &length,
                     reinterpret_cast<const Bytef *>(packed.data() + from), sizes[b]) != Z_OK ||
          length != size)
        text.fail(
          "found compressed data that zlib cannot unpack; expected a whole file, write it again");
      result += block;
      from += sizes[b];
    }
    return result;
  }

  template <typename Number>
  static void append_as_double(const Bytes &bytes, std::vector<double> &values)
  {
    for (std::size_t k = 0; k + sizeof(Number) <= bytes.size(); k += sizeof(Number))
    {
      Number value;
      std::memcpy(&value, bytes.data() + k, sizeof(Number));
      values.push_back(static_cast<double>(value));
    }
  }

  std::vector<double> values_of(const std::string &name)
  {
    const auto found = arrays.find(name);
    if (found == arrays.end())
      text.fail("has no array `" + name + "`; expected it in an UnstructuredGrid");
    const Tag &tag = found->second.tag;
    std::vector<double> values;
    if (tag["format"] == "ascii")
    {
      const std::size_t end = content.find('<', found->second.place);
      MeshText part(text.file,
                    std::string(content.substr(found->second.place, end - found->second.place)));
      for (std::string_view word = part.word(); !word.empty(); word = part.word())
      {
        double value = 0.;
        if (!to_number(word, value))
          text.fail("array `" + name + "`: found `" + std::string(word.substr(0, 40)) +
                    "`; expected numbers");
        values.push_back(value);
      }
      return values;
    }
    Bytes bytes;
    if (tag["format"] == "appended")
    {
      long offset = 0;
      if (!to_integer(tag["offset"], offset) || offset < 0 ||
          static_cast<std::size_t>(offset) > appended.size())
        text.fail("array `" + name + "`: found the offset `" + tag["offset"].substr(0, 40) +
                  "`; expected one inside AppendedData");
      bytes = bytes_of(appended, static_cast<std::size_t>(offset), appended_is_raw);
    }
    else if (tag["format"] == "binary")
      bytes = bytes_of(content, found->second.place, false);
    else
      text.fail("array `" + name + "`: found the format `" + tag["format"].substr(0, 40) +
                "`; expected ascii, binary or appended");
    const std::string type = tag["type"];
    if (type == "Float64")
      append_as_double<double>(bytes, values);
    else if (type == "Float32")
      append_as_double<float>(bytes, values);
    else if (type == "Int64")
      append_as_double<std::int64_t>(bytes, values);
    else if (type == "UInt64")
      append_as_double<std::uint64_t>(bytes, values);
    else if (type == "Int32")
      append_as_double<std::int32_t>(bytes, values);
    else if (type == "UInt32")
      append_as_double<std::uint32_t>(bytes, values);
    else if (type == "Int16")
      append_as_double<std::int16_t>(bytes, values);
    else if (type == "UInt16")
      append_as_double<std::uint16_t>(bytes, values);
    else if (type == "UInt8")
      append_as_double<std::uint8_t>(bytes, values);
    else if (type == "Int8")
      append_as_double<std::int8_t>(bytes, values);
    else
      text.fail("array `" + name + "`: found the type `" + type.substr(0, 40) +
                "`; expected Float64, Int64 and the like");
    return values;
  }

  std::vector<double> points_of()
  {
    for (const auto &[name, its] : arrays)
      if (name.rfind("Points/", 0) == 0)
        return values_of(name);
    text.fail("has no points; expected them in the section Points");
  }

  /// −1, which no reader takes, where the number is no index.
  static long as_index(const double value)
  {
    return value >= 0. && value < 1e15 ? static_cast<long>(value) : -1;
  }

  RawMesh assembled()
  {
    RawMesh mesh;
    const std::vector<double> points = points_of(), corners = values_of("Cells/connectivity"),
                              offsets = values_of("Cells/offsets"),
                              types   = values_of("Cells/types");
    for (std::size_t k = 0; k + 2 < points.size(); k += 3)
      mesh.points.emplace_back(points[k], points[k + 1], points[k + 2]);
    std::vector<double> groups, angles;
    for (const auto &[name, its] : arrays)
      if (name.rfind("CellData/", 0) == 0 &&
          (its.tag["NumberOfComponents"].empty() || its.tag["NumberOfComponents"] == "1"))
      {
        if (is_group_array(name.substr(9)))
          groups = values_of(name);
        else if (name == "CellData/angle")
          angles = values_of(name);
      }
    if (offsets.size() != types.size() || (!groups.empty() && groups.size() != types.size()) ||
        (!angles.empty() && angles.size() != types.size()))
      text.fail("found " + std::to_string(types.size()) + " types, " +
                std::to_string(offsets.size()) + " offsets and " + std::to_string(groups.size()) +
                " groups of elements; expected as many: write the file again");
    double from = 0.;
    for (std::size_t k = 0; k < offsets.size(); ++k)
    {
      if (!(offsets[k] >= from && offsets[k] <= static_cast<double>(corners.size())))
        text.fail("found offsets that do not rise from 0 to " + std::to_string(corners.size()) +
                  "; expected that");
      std::vector<long> its;
      for (auto c = static_cast<std::size_t>(from); c < static_cast<std::size_t>(offsets[k]); ++c)
        its.push_back(as_index(corners[c]));
      from = offsets[k];
      if (!add_vtk_cell(text, mesh, as_index(types[k]), its))
        continue;
      mesh.cells.back().group = groups.empty() ? 0 : group_number(text, groups[k]);
      if (!angles.empty())
        mesh.angles.push_back(angles[k]);
    }
    return mesh;
  }

  MeshText text;
  const std::string_view content;
  std::map<std::string, Array> arrays; ///< by `Section/name`, the name in lower case
  std::string_view appended;
  std::size_t header_size = 4;
  bool is_compressed = false, appended_is_raw = false;
  int n_pieces = 0;
};
} // namespace

RawMesh read_vtu(const std::string &file)
{
  return VtuReader(file).read();
}
} // namespace homespun::homogenization
