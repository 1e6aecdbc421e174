// SPDX-License-Identifier: MIT
#include "meshes/files/obj_reader.h"

#include "meshes/files/words.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/fault_list.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <set>
#include <string_view>
#include <utility>

namespace homespun::meshes
{
namespace
{
/// Whether the whole word is a finite number. Not strtod, which asks the locale for the decimal
/// point.
bool read_number(std::string_view word, double &number)
{
  if (!word.empty() && word.front() == '+')
    word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size() && std::isfinite(number);
}

bool read_number(const std::string_view word, long &number)
{
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size();
}

class ObjReader
{
public:
  ObjReader(const std::string &file, const NeedsVt needs_vt)
      : file(file)
      , needs_vt(needs_vt == NeedsVt::yes)
      , faults(file)
  {
  }

  ObjContent run()
  {
    std::ifstream input(file, std::ios::binary);
    if (!input)
      throw BadInput(file + ": cannot be read; expected a Wavefront OBJ file: is the path right?");
    std::string line, continued;
    while (std::getline(input, line))
    {
      ++number;
      if (!line.empty() && line.back() == '\r')
        line.pop_back();
      if (!line.empty() && line.back() == '\\' && line.find('#') == std::string::npos)
      {
        line.back() = ' ';
        continued += line;
        continue;
      }
      read_line(continued + line);
      continued.clear();
    }
    read_line(continued); // of a file that ends in a backslash
    if (input.bad())
      throw BadInput(file + ": cannot be read to its end");
    if (content.faces.empty() && faults.empty())
      faults.add("empty files",
                 "has no face (`f`); expected a mesh of triangles or quadrilaterals");
    if (auto list = faults.take(); !list.empty())
      throw BadInput(std::move(list));
    return std::move(content);
  }

private:
  std::string here() const
  {
    return "line " + std::to_string(number) + ": ";
  }

  void read_line(const std::string &line)
  {
    const std::vector<std::string_view> words =
      words_of(std::string_view(line).substr(0, line.find('#')));
    if (words.empty())
      return;
    static const std::set<std::string_view> skipped = {"o", "s", "vn", "mtllib"};
    // What ARCSim adds of velocities, edges, remeshing and labels does not touch positions and
    // faces.
    static const std::set<std::string_view> of_arcsim = {"ny", "nv", "nl", "e",  "ea",
                                                         "ed", "tl", "tp", "td", "ms"};
    if (words[0] == "v")
      read_coordinates(words, content.v);
    else if (words[0] == "vt")
      read_coordinates(words, content.vt);
    else if (words[0] == "f")
      read_face(words);
    else if (words[0] == "usemtl" || words[0] == "g")
      (words[0] == "g" ? group : material) =
        words.size() == 1 ? ""
                          : std::string(words[1].data(), words.back().data() + words.back().size());
    else if (of_arcsim.count(words[0]) > 0)
      content.passed_over.insert(std::string(words[0]));
    else if (skipped.count(words[0]) == 0)
      faults.add("unknown lines", here() + "found `" + std::string(words[0]) +
                                    "`; expected v, vt or f (o, g, s, vn, usemtl, mtllib and # are "
                                    "skipped): export polygons only, no curves and loose edges");
  }

  template <std::size_t n>
  void read_coordinates(const std::vector<std::string_view> &words,
                        std::vector<std::array<double, n>> &points)
  {
    points.push_back({});
    if (words.size() <= n)
      faults.add("short lines", here() + "`" + std::string(words[0]) + "` has " +
                                  std::to_string(words.size() - 1) + " numbers; expected " +
                                  std::to_string(n));
    for (std::size_t i = 0; i < n && i + 1 < words.size(); ++i)
      if (!read_number(words[i + 1], points.back()[i]))
        faults.add("coordinates that are not finite numbers",
                   here() + "found `" + std::string(words[i + 1]) +
                     "`; expected a finite number, " + std::string(words[0]) + " " +
                     std::to_string(points.size()) + " of the file");
  }

  /// One index, from 1 or negative, into a list of n; −1 where it is a fault.
  int index_of(const std::string_view word, const std::size_t n, const std::string &what)
  {
    long index           = 0;
    const bool is_number = read_number(word, index);
    if (is_number && index < 0)
      index += static_cast<long>(n) + 1;
    if (is_number && index >= 1 && index <= static_cast<long>(n))
      return static_cast<int>(index - 1);
    faults.add("indices out of range", here() + "the face names " + what + " `" +
                                         std::string(word) + "`; expected 1 to " +
                                         std::to_string(n) + ", or −1 to −" + std::to_string(n) +
                                         ", of the lines above it");
    return -1;
  }

  void read_face(const std::vector<std::string_view> &words)
  {
    const std::size_t n = words.size() - 1;
    if (n != 3 && n != 4)
    {
      faults.add("faces of other sizes", here() + "the face has " + std::to_string(n) +
                                           " corners; expected 3 or 4: triangulate the mesh");
      return;
    }
    std::vector<ObjCorner> face;
    bool is_sound = true;
    for (std::size_t k = 1; k <= n; ++k)
    {
      const std::string_view word   = words[k];
      const std::size_t slash       = word.find('/');
      const std::string_view first  = word.substr(0, slash);
      const std::string_view rest   = slash == std::string_view::npos ? "" : word.substr(slash + 1);
      const std::string_view second = rest.substr(0, rest.find('/'));
      ObjCorner corner              = {index_of(first, content.v.size(), "v"), -1};
      if (!second.empty())
        corner.vt = index_of(second, content.vt.size(), "vt");
      is_sound = is_sound && corner.v >= 0 && (second.empty() || corner.vt >= 0);
      if (needs_vt && second.empty())
      {
        faults.add("faces without vt", here() + "the face has no vt: cloth without vt: export UV "
                                                "coordinates in metres");
        return;
      }
      face.push_back(corner);
    }
    if (!is_sound)
      return;
    content.faces.push_back(std::move(face));
    const std::string &name = material.empty() ? group : material;
    const int next          = static_cast<int>(content.number_of_group.size()) + 1;
    content.group_of_face.push_back(
      name.empty() ? 0 : content.number_of_group.emplace(name, next).first->second);
  }

  std::string file;
  bool needs_vt;
  FaultList faults;
  ObjContent content;
  std::string material, group; ///< of the faces to come
  int number = 0;
};
} // namespace

ObjContent read_obj(const std::string &file, const NeedsVt needs_vt)
{
  return ObjReader(file, needs_vt).run();
}
} // namespace homespun::meshes
