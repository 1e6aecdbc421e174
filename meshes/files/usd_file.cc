// SPDX-License-Identifier: MIT
#include "meshes/files/usd_file.h"

#include "meshes/files/write_whole.h"
#include "meshes/plain/errors.h"

#include <charconv>

namespace homespun::meshes
{
namespace
{
template <typename Number>
void append(std::string &text, const Number number)
{
  char digits[32];
  const auto [end, error] = std::to_chars(digits, digits + sizeof(digits), number);
  text.append(digits, end);
}

void append_point(std::string &text, const Eigen::RowVector3f &point)
{
  for (int i = 0; i < 3; ++i)
  {
    text += i == 0 ? "(" : ", ";
    append(text, point(i));
  }
  text += ')';
}

/// NAME = [entry, entry, ...]
template <typename Entry>
void append_list(std::string &text, const std::string &name, const Eigen::Index n,
                 const Entry &entry)
{
  text += "    " + name + " = [";
  for (Eigen::Index k = 0; k < n; ++k)
  {
    if (k > 0)
      text += ", ";
    entry(k);
  }
  text += "]\n";
}
} // namespace

void write_usda(const std::string &file, const FloatPoints &positions, const Triangles &triangles,
                const UpAxis up)
{
  const Eigen::Index n = positions.rows();
  for (Eigen::Index v = 0; v < n; ++v)
    if (!positions.row(v).allFinite())
      throw BadInput(file + ": not written: vertex " + std::to_string(v) +
                     " has a position that is not finite");
  if (n == 0 || (triangles.size() > 0 && (triangles.minCoeff() < 0 || triangles.maxCoeff() >= n)))
    throw BadInput(file +
                   ": not written: a triangle names a vertex that does not exist; expected 0 "
                   "to " +
                   std::to_string(n - 1));
  std::string text = std::string("#usda 1.0\n(\n    defaultPrim = \"cloth\"\n"
                                 "    doc = \"up-sampled by homespun\"\n"
                                 "    metersPerUnit = 1\n    upAxis = \"") +
                     (up == UpAxis::y ? "Y" : "Z") + "\"\n)\n\ndef Mesh \"cloth\"\n{\n";
  const FloatPoints corners =
    (FloatPoints(2, 3) << positions.colwise().minCoeff(), positions.colwise().maxCoeff())
      .finished();
  append_list(text, "float3[] extent", 2,
              [&](const Eigen::Index k) { append_point(text, corners.row(k)); });
  append_list(text, "int[] faceVertexCounts", triangles.rows(),
              [&](const Eigen::Index) { text += '3'; });
  append_list(text, "int[] faceVertexIndices", triangles.size(),
              [&](const Eigen::Index k) { append(text, triangles.data()[k]); });
  append_list(text, "point3f[] points", n,
              [&](const Eigen::Index k) { append_point(text, positions.row(k)); });
  text += "    uniform token subdivisionScheme = \"none\"\n}\n";
  write_whole(file, text);
}
} // namespace homespun::meshes
