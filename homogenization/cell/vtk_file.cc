// SPDX-License-Identifier: MIT
// Legacy VTK as text: https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html, versions
// 1 to 5.1.
#include "homogenization/cell/mesh_formats.h"
#include "homogenization/cell/parameter_text.h"

namespace homespun::homogenization
{
namespace
{
class VtkReader
{
public:
  explicit VtkReader(MeshText &text)
      : text(text)
  {
  }

  RawMesh read()
  {
    std::string_view line;
    text.line(line);
    if (line.substr(0, 5) != "# vtk")
      text.fail("found no header; expected `# vtk DataFile Version ...`");
    text.line(line); // the title
    const std::string encoding = lower(text.word());
    if (encoding != "ascii")
      text.fail("found the encoding `" + encoding.substr(0, 40) +
                "`; expected ASCII: save it as text, or as .vtu");
    for (std::string word = lower(text.word()); !word.empty(); word = lower(text.word()))
      section(word);
    add_cells();
    return std::move(mesh);
  }

private:
  void section(const std::string &word)
  {
    if (word == "dataset")
    {
      const std::string kind = lower(text.word());
      if (kind != "unstructured_grid")
        text.fail("found the data set `" + kind.substr(0, 40) + "`; expected UNSTRUCTURED_GRID");
    }
    else if (word == "points")
      points();
    else if (word == "cells")
      cells();
    else if (word == "cell_types")
    {
      const long n = text.count("types of elements");
      for (long k = 0; k < n; ++k)
        types.push_back(text.integer("the type of an element"));
    }
    else if (word == "cell_data" || word == "point_data")
    {
      n_data   = text.count("data");
      of_cells = word == "cell_data";
    }
    else if (word == "metadata")
      metadata();
    else if (word == "field")
      field();
    else
      data(word);
  }

  void points()
  {
    const long n = text.count("points");
    text.word(); // the type of the numbers
    for (long k = 0; k < n; ++k)
    {
      Eigen::Vector3d x;
      for (double &component : x)
        component = text.number("a coordinate");
      mesh.points.push_back(x);
    }
  }

  void cells()
  {
    const long n = text.count("elements"), size = text.count("numbers of elements");
    // From version 5 on: offsets, one more than elements, and all corners in a row.
    if (lower(trimmed(std::string(text.peek_line()))).empty() && next_is_offsets())
    {
      std::vector<long> offsets;
      for (long k = 0; k < n; ++k)
        offsets.push_back(text.integer("an offset"));
      if (lower(text.word()) != "connectivity")
        text.fail("found no section CONNECTIVITY; expected it after OFFSETS");
      text.word();
      std::vector<long> all;
      for (long k = 0; k < size; ++k)
        all.push_back(text.integer("the number of a point of an element"));
      for (std::size_t k = 0; k + 1 < offsets.size(); ++k)
      {
        if (offsets[k] < 0 || offsets[k] > offsets[k + 1] || offsets[k + 1] > size)
          text.fail("found offsets that do not rise from 0 to " + std::to_string(size) +
                    "; expected that");
        corners.emplace_back(all.begin() + offsets[k], all.begin() + offsets[k + 1]);
      }
      return;
    }
    for (long k = 0; k < n; ++k)
    {
      corners.emplace_back();
      const long n_corners = first_count >= 0 ? first_count : text.count("points of an element");
      first_count          = -1;
      for (long c = 0; c < n_corners; ++c)
        corners.back().push_back(text.integer("the number of a point of an element"));
    }
  }

  /// Whether the word OFFSETS and its type follow; otherwise that word is the first count.
  bool next_is_offsets()
  {
    const std::string word = lower(text.word());
    if (word == "offsets")
    {
      text.word();
      return true;
    }
    if (!to_integer(word, first_count) || first_count < 0 || first_count > 1000)
      text.fail("found `" + word.substr(0, 40) + "`; expected the number of points of an element");
    return false;
  }

  void metadata()
  {
    std::string_view line;
    text.line(line);
    while (text.line(line) && !trimmed(std::string(line)).empty())
    {
    }
  }

  void field()
  {
    text.word();
    const long n = text.count("arrays");
    for (long k = 0; k < n; ++k)
    {
      std::string name = std::string(text.word());
      if (lower(name) == "metadata")
      {
        metadata();
        name = std::string(text.word());
      }
      const long components = text.count("components"), tuples = text.count("values");
      text.word();
      array(name, components, tuples);
    }
  }

  void data(const std::string &kind)
  {
    const std::string name = std::string(text.word());
    if (kind == "lookup_table")
    {
      text.skip(4 * text.count("colours"), "a colour");
      return;
    }
    text.word(); // the type of the numbers
    long components = 0;
    if (kind == "scalars")
    {
      components = 1;
      if (const std::string rest = trimmed(std::string(text.peek_line())); !rest.empty())
        components = text.count("components");
      if (text.word() != "LOOKUP_TABLE")
        text.fail("found no LOOKUP_TABLE; expected it after SCALARS");
      text.word();
    }
    else if (kind == "vectors" || kind == "normals")
      components = 3;
    else if (kind == "tensors")
      components = 9;
    else
      text.fail("found `" + kind.substr(0, 40) +
                "`; expected POINTS, CELLS, CELL_TYPES, CELL_DATA or data of one of these");
    array(name, components, n_data);
  }

  void array(const std::string &name, const long components, const long tuples)
  {
    const bool is_wanted =
      of_cells && components == 1 && (is_group_array(name) || lower(name) == "angle");
    if (!is_wanted)
    {
      if (components > 0 && tuples > static_cast<long>(text.content.size()) / components)
        text.fail("found more values of `" + name +
                  "` than the file can hold; expected a whole file");
      text.skip(components * tuples, "a value");
      return;
    }
    std::vector<double> &values = lower(name) == "angle" ? angles : groups;
    values.clear();
    for (long k = 0; k < tuples; ++k)
      values.push_back(text.number("a value of cell data"));
  }

  void add_cells()
  {
    if (types.size() != corners.size())
      text.fail("found " + std::to_string(types.size()) + " types for " +
                std::to_string(corners.size()) +
                " elements; expected as many: the file is cut off, write it again");
    for (const std::vector<double> *values : {&groups, &angles})
      if (!values->empty() && values->size() != corners.size())
        text.fail("found " + std::to_string(values->size()) + " cell data for " +
                  std::to_string(corners.size()) + " elements; expected as many");
    for (std::size_t k = 0; k < corners.size(); ++k)
      if (add_vtk_cell(text, mesh, types[k], corners[k]))
      {
        mesh.cells.back().group = groups.empty() ? 0 : group_number(text, groups[k]);
        if (!angles.empty())
          mesh.angles.push_back(angles[k]);
      }
  }

  MeshText &text;
  RawMesh mesh;
  std::vector<std::vector<long>> corners;
  std::vector<long> types;
  std::vector<double> groups, angles;
  long n_data      = 0;
  bool of_cells    = false;
  long first_count = -1;
};
} // namespace

RawMesh read_vtk(MeshText &text)
{
  return VtkReader(text).read();
}
} // namespace homespun::homogenization
