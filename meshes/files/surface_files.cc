// SPDX-License-Identifier: MIT
#include "meshes/files/surface_files.h"

#include "meshes/files/write_whole.h"
#include "meshes/plain/errors.h"

#include <algorithm>
#include <array>
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

ClothLook ClothLook::of(const Points &rest, const Triangles &corners,
                        const Eigen::VectorXi &material)
{
  const Eigen::RowVector2d low = rest.colwise().minCoeff(), size = rest.colwise().maxCoeff() - low;
  return {material, (rest.rowwise() - low) / size.maxCoeff(), corners};
}

Eigen::RowVector3f colour_of_phase(const int phase)
{
  constexpr std::array<std::array<int, 3>, 8> colours = {{{230, 159, 0},
                                                          {86, 180, 233},
                                                          {0, 158, 115},
                                                          {240, 228, 66},
                                                          {0, 114, 178},
                                                          {213, 94, 0},
                                                          {204, 121, 167},
                                                          {120, 120, 120}}};
  const std::array<int, 3> &of = colours[static_cast<std::size_t>(phase) % colours.size()];
  return Eigen::RowVector3f(static_cast<float>(of[0]), static_cast<float>(of[1]),
                            static_cast<float>(of[2])) /
         255.f;
}

namespace
{
void append_colour(std::string &bytes, const Eigen::RowVector3f &colour)
{
  for (int c = 0; c < 3; ++c)
    bytes += static_cast<char>(static_cast<unsigned char>(std::lround(255.f * colour(c))));
}

/// What vertices have of a look: texture coordinates, and colours, the mean of their triangles.
Eigen::Matrix<float, Eigen::Dynamic, 5, Eigen::RowMajor>
look_at_vertices(const ClothLook &look, const Triangles &triangles, const Eigen::Index n_vertices)
{
  Eigen::Matrix<float, Eigen::Dynamic, 5, Eigen::RowMajor> at_vertices;
  at_vertices.setZero(n_vertices, 5);
  Eigen::VectorXf n_triangles = Eigen::VectorXf::Zero(n_vertices);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int v                  = triangles(t, k);
      at_vertices.row(v).head<2>() = look.texture.row(look.corners(t, k)).cast<float>();
      at_vertices.row(v).tail<3>() += colour_of_phase(look.material(t));
      n_triangles(v) += 1.f;
    }
  for (Eigen::Index v = 0; v < n_vertices; ++v)
    at_vertices.row(v).tail<3>() /= std::max(n_triangles(v), 1.f);
  return at_vertices;
}

void check_look(const std::string &file, const ClothLook &look, const FloatPoints &positions,
                const Triangles &triangles, const FloatPoints &normals)
{
  if (normals.rows() != 0 && (normals.rows() != positions.rows() || !normals.allFinite()))
    refuse(file, "normals are not finite, or not one for each vertex");
  if (look.material.size() == 0)
    return;
  if (look.material.size() != triangles.rows() || look.corners.rows() != triangles.rows() ||
      look.material.minCoeff() < 0 || look.corners.minCoeff() < 0 ||
      look.corners.maxCoeff() >= look.texture.rows() || !look.texture.allFinite())
    refuse(file, "phases or texture coordinates do not belong to its triangles");
}
} // namespace

void write_ply(const std::string &file, const FloatPoints &positions, const Triangles &triangles,
               const ClothLook &look, const FloatPoints &normals)
{
  check(file, positions, triangles, {});
  check_look(file, look, positions, triangles, normals);
  const bool has_look = look.material.size() > 0, has_normals = normals.rows() > 0;
  const std::string colour = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  std::string text         = "ply\nformat binary_little_endian 1.0\ncomment positions in metres\n"
                             "element vertex " +
                     std::to_string(positions.rows()) +
                     "\nproperty float x\nproperty float y\nproperty float z\n";
  if (has_normals)
    text += "property float nx\nproperty float ny\nproperty float nz\n";
  if (has_look)
    text += "property float s\nproperty float t\n" + colour;
  text += "element face " + std::to_string(triangles.rows()) +
          "\nproperty list uchar int vertex_indices\n";
  if (has_look)
    text += "property int material\n" + colour + "property list uchar float texcoord\n";
  text += "end_header\n";
  const auto at_vertices = has_look ? look_at_vertices(look, triangles, positions.rows())
                                    : decltype(look_at_vertices(look, triangles, 0))();
  for (Eigen::Index v = 0; v < positions.rows(); ++v)
  {
    append_bytes(text, positions.data() + 3 * v, 3);
    if (has_normals)
      append_bytes(text, normals.data() + 3 * v, 3);
    if (has_look)
    {
      append_bytes(text, at_vertices.data() + 5 * v, 2);
      append_colour(text, at_vertices.row(v).tail<3>());
    }
  }
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
  {
    text += '\3';
    append_bytes(text, triangles.data() + 3 * t, 3);
    if (!has_look)
      continue;
    append_bytes(text, look.material.data() + t, 1);
    append_colour(text, colour_of_phase(look.material(t)));
    text += '\6';
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::RowVector2f place = look.texture.row(look.corners(t, k)).cast<float>();
      append_bytes(text, place.data(), 2);
    }
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
