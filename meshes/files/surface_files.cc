// SPDX-License-Identifier: MIT
#include "meshes/files/surface_files.h"

#include "meshes/files/write_whole.h"
#include "meshes/plain/errors.h"

#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace homespun::meshes
{
namespace
{
static_assert(sizeof(float) == 4 && sizeof(int) == 4, "PLY and VTU say float32 and int32");

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#  error "binary files are written in the byte order of the machine, which must be little-endian"
#endif

template <typename Number>
void append_bytes(std::string &bytes, const Number *const numbers, const std::size_t n)
{
  bytes.append(reinterpret_cast<const char *>(numbers), n * sizeof(Number));
}

[[noreturn]] void refuse(const std::string &file, const std::string &why)
{
  throw BadInput(file + ": not written: " + why);
}

/// @param item what each of the n rows belongs to
void check_values(const std::string &file, const std::vector<VertexData> &data,
                  const Eigen::Index n, const std::string &item)
{
  for (const VertexData &array : data)
  {
    if (array.values.rows() != n || (array.values.cols() != 1 && array.values.cols() != 3))
      refuse(file, "`" + array.name + "` has shape (" + std::to_string(array.values.rows()) + ", " +
                     std::to_string(array.values.cols()) + "); expected (" + std::to_string(n) +
                     ", 1) or (" + std::to_string(n) + ", 3)");
    for (Eigen::Index k = 0; k < n; ++k)
      if (!array.values.row(k).allFinite())
        refuse(file, "`" + array.name + "` is not finite at " + item + " " + std::to_string(k));
  }
}

void check(const std::string &file, const FloatPoints &positions, const Triangles &triangles,
           const std::vector<VertexData> &data)
{
  const Eigen::Index n = positions.rows();
  for (Eigen::Index v = 0; v < n; ++v)
    if (!positions.row(v).allFinite())
      refuse(file, "vertex " + std::to_string(v) + " has a position that is not finite");
  if (triangles.size() > 0 && (triangles.minCoeff() < 0 || triangles.maxCoeff() >= n))
    refuse(file, "a triangle names vertex " +
                   std::to_string(triangles.minCoeff() < 0 ? triangles.minCoeff()
                                                           : triangles.maxCoeff()) +
                   "; expected 0 to " + std::to_string(n - 1));
  check_values(file, data, n, "vertex");
}

std::string escaped(const std::string &text)
{
  std::string result;
  for (const char c : text)
    result += c == '&'   ? "&amp;"
              : c == '<' ? "&lt;"
              : c == '>' ? "&gt;"
              : c == '"' ? "&quot;"
                         : std::string(1, c);
  return result;
}
/// Lists of words as VTK's ASCII strings: the code of each letter, a zero behind each word.
std::string field_data(const std::vector<WordList> &lists)
{
  std::string text;
  for (const WordList &list : lists)
  {
    text += "<Array type=\"String\" Name=\"" + escaped(list.name) + "\" NumberOfTuples=\"" +
            std::to_string(list.words.size()) + "\" format=\"ascii\">";
    for (const std::string &word : list.words)
    {
      for (const char c : word)
        text += std::to_string(static_cast<unsigned char>(c)) + " ";
      text += "0 ";
    }
    text += "</Array>\n";
  }
  return text.empty() ? "" : "<FieldData>\n" + text + "</FieldData>\n";
}
} // namespace

void write_ply(const std::string &file, const FloatPoints &positions, const Triangles &triangles,
               const std::vector<VertexData> &scalars)
{
  check(file, positions, triangles, scalars);
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment positions in metres\n"
                     "element vertex " +
                     std::to_string(positions.rows()) +
                     "\nproperty float x\nproperty float y\nproperty float z\n";
  for (const VertexData &scalar : scalars)
  {
    bool is_plain = !scalar.name.empty();
    for (const char c : scalar.name)
      is_plain = is_plain && (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_');
    if (!is_plain || scalar.values.cols() != 1)
      throw BadInput(file + ": not written: `" + scalar.name + "` has " +
                     std::to_string(scalar.values.cols()) +
                     " components; expected one, and a name of letters, digits and _");
    text += "property float " + scalar.name + "\n";
  }
  text += "element face " + std::to_string(triangles.rows()) +
          "\nproperty list uchar int vertex_indices\nend_header\n";
  for (Eigen::Index v = 0; v < positions.rows(); ++v)
  {
    append_bytes(text, positions.data() + 3 * v, 3);
    for (const VertexData &scalar : scalars)
      append_bytes(text, scalar.values.data() + v, 1);
  }
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
  {
    text += '\3';
    append_bytes(text, triangles.data() + 3 * t, 3);
  }
  write_whole(file, text);
}

void write_vtu(const std::string &file, const FloatPoints &positions, const Triangles &triangles,
               const std::vector<VertexData> &data, const std::vector<VertexData> &cell_data,
               const std::vector<WordList> &words)
{
  check(file, positions, triangles, data);
  check_values(file, cell_data, triangles.rows(), "triangle");
  const auto n = static_cast<std::size_t>(positions.rows()),
             m = static_cast<std::size_t>(triangles.rows());
  // Appended raw: each array begins with its number of bytes, and stands at its offset after the
  // `_`.
  std::string head, appended;
  const auto put = [&](const char *const type, const std::string &name,
                       const Eigen::Index components, const auto *const numbers,
                       const std::size_t count)
  {
    head += std::string("<DataArray type=\"") + type + "\" Name=\"" + escaped(name) +
            "\" NumberOfComponents=\"" + std::to_string(components) +
            "\" format=\"appended\" offset=\"" + std::to_string(appended.size()) + "\"/>\n";
    const std::uint64_t bytes = count * sizeof(*numbers);
    append_bytes(appended, &bytes, 1);
    append_bytes(appended, numbers, count);
  };
  head = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
         "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n" +
         field_data(words) + "<Piece NumberOfPoints=\"" + std::to_string(n) +
         "\" NumberOfCells=\"" + std::to_string(m) + "\">\n<PointData>\n";
  for (const VertexData &array : data)
    put("Float32", array.name, array.values.cols(), array.values.data(),
        static_cast<std::size_t>(array.values.size()));
  head += "</PointData>\n<CellData>\n";
  for (const VertexData &array : cell_data)
    put("Float32", array.name, array.values.cols(), array.values.data(),
        static_cast<std::size_t>(array.values.size()));
  head += "</CellData>\n<Points>\n";
  put("Float32", "positions [m]", 3, positions.data(), 3 * n);
  head += "</Points>\n<Cells>\n";
  put("Int32", "connectivity", 1, triangles.data(), 3 * m);
  std::vector<std::int64_t> offsets(m);
  for (std::size_t t = 0; t < m; ++t)
    offsets[t] = 3 * static_cast<std::int64_t>(t + 1);
  put("Int64", "offsets", 1, offsets.data(), m);
  constexpr std::uint8_t vtk_triangle = 5;
  const std::vector<std::uint8_t> types(m, vtk_triangle);
  put("UInt8", "types", 1, types.data(), m);
  head += "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  write_whole(file, head + appended + "\n</AppendedData>\n</VTKFile>\n");
}

FrameCollection::FrameCollection(std::string file)
    : file(std::move(file))
{
}

void FrameCollection::append(const double time, const std::string &frame)
{
  if (!std::isfinite(time))
    throw BadInput(file + ": not written: the time of " + frame + " is not finite");
  frames.emplace_back(time, frame);
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
                     "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const auto &[when, name] : frames)
  {
    char number[40];
    std::snprintf(number, sizeof(number), "%.17g", when);
    text += std::string("<DataSet timestep=\"") + number + "\" part=\"0\" file=\"" + escaped(name) +
            "\"/>\n";
  }
  write_whole(file, text + "</Collection>\n</VTKFile>\n");
}
} // namespace homespun::meshes
