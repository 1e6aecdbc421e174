// SPDX-License-Identifier: MIT
#include "meshes/files/frame_caches.h"

#include "meshes/plain/errors.h"

#include <charconv>

namespace homespun::meshes
{
namespace
{
template <typename Number>
void append_bytes(std::string &bytes, const Number number)
{
  bytes.append(reinterpret_cast<const char *>(&number), sizeof(Number));
}

void check(const std::string &file, const FloatPoints &positions, const int n_points)
{
  if (positions.rows() != n_points)
    throw BadInput(file + ": not written: a frame has " + std::to_string(positions.rows()) +
                   " vertices; expected " + std::to_string(n_points));
  for (Eigen::Index v = 0; v < positions.rows(); ++v)
    if (!positions.row(v).allFinite())
      throw BadInput(file + ": not written: vertex " + std::to_string(v) +
                     " has a position that is not finite");
}

template <typename Number>
void append(std::string &text, const Number number)
{
  char digits[32];
  const auto [end, error] = std::to_chars(digits, digits + sizeof(digits), number);
  text.append(digits, end);
}

template <typename Row>
void append_tuple(std::string &text, const Row &row)
{
  for (Eigen::Index i = 0; i < row.size(); ++i)
  {
    text += i == 0 ? "(" : ", ";
    append(text, row(i));
  }
  text += ')';
}

/// [entry, entry, ...]
template <typename Entry>
void append_list(std::string &text, const Eigen::Index n, const Entry &entry)
{
  text += '[';
  for (Eigen::Index k = 0; k < n; ++k)
  {
    if (k > 0)
      text += ", ";
    entry(k);
  }
  text += ']';
}

/// The phases of a look, in the order of their numbers.
std::vector<std::vector<int>> triangles_of_phases(const Eigen::VectorXi &material)
{
  std::vector<std::vector<int>> of(
    material.size() == 0 ? 0 : static_cast<std::size_t>(material.maxCoeff() + 1));
  for (int t = 0; t < material.size(); ++t)
    of[static_cast<std::size_t>(material(t))].push_back(t);
  return of;
}

std::string material_of(const std::string &phase, const Eigen::RowVector3f &colour)
{
  std::string text =
    "        def Material \"" + phase +
    "\"\n        {\n            token outputs:surface.connect = </cloth/materials/" + phase +
    "/shader.outputs:surface>\n            def Shader \"shader\"\n"
    "            {\n                uniform token info:id = "
    "\"UsdPreviewSurface\"\n                color3f inputs:diffuseColor = ";
  append_tuple(text, colour);
  return text + "\n                float inputs:roughness = 0.9\n"
                "                token outputs:surface\n            }\n        }\n";
}
} // namespace

PointCache::PointCache(const std::string &name, const int n_points, const int n_frames)
    : name(name)
    , n_points(n_points)
    , file(name)
{
  std::string head("POINTCACHE2", 12); // with the zero behind it
  append_bytes(head, 1);
  append_bytes(head, n_points);
  append_bytes(head, 0.f);
  append_bytes(head, 1.f);
  append_bytes(head, n_frames);
  file.append(head);
}

void PointCache::append(const FloatPoints &positions)
{
  check(name, positions, n_points);
  file.append(std::string(reinterpret_cast<const char *>(positions.data()),
                          static_cast<std::size_t>(positions.size()) * sizeof(float)));
}

void PointCache::finish()
{
  file.finish();
}

UsdAnimation::UsdAnimation(const std::string &name, const int n_points, const Triangles &triangles,
                           const ClothLook &look, const UsdStage &stage)
    : name(name)
    , n_points(n_points)
    , file(name)
{
  if (triangles.size() > 0 && (triangles.minCoeff() < 0 || triangles.maxCoeff() >= n_points))
    throw BadInput(name +
                   ": not written: a triangle names a vertex that does not exist; expected 0 to " +
                   std::to_string(n_points - 1));
  std::string text = "#usda 1.0\n(\n    defaultPrim = \"cloth\"\n    doc = \"up-sampled by "
                     "homespun\"\n    endTimeCode = " +
                     std::to_string(stage.n_frames - 1) +
                     "\n    metersPerUnit = 1\n    startTimeCode = 0\n    timeCodesPerSecond = ";
  meshes::append(text, stage.frames_per_second);
  text += std::string("\n    upAxis = \"") + (stage.up == UpAxis::y ? "Y" : "Z") +
          "\"\n)\n\ndef Xform \"cloth\"\n{\n    def Scope \"materials\"\n    {\n";
  const auto phases = triangles_of_phases(look.material);
  for (std::size_t k = 0; k < phases.size(); ++k)
    text += material_of("phase_" + std::to_string(k), colour_of_phase(static_cast<int>(k)));
  text += "    }\n    def Mesh \"surface\"\n    {\n        int[] faceVertexCounts = ";
  append_list(text, triangles.rows(), [&](const Eigen::Index) { text += '3'; });
  text += "\n        int[] faceVertexIndices = ";
  append_list(text, triangles.size(),
              [&](const Eigen::Index k) { meshes::append(text, triangles.data()[k]); });
  text += "\n        uniform token subdivisionScheme = \"none\"\n";
  if (!phases.empty())
  {
    text += "        uniform token subsetFamily:materialBind:familyType = \"partition\"\n"
            "        texCoord2f[] primvars:st = ";
    append_list(text, look.corners.size(),
                [&](const Eigen::Index k)
                { append_tuple(text, look.texture.row(look.corners.data()[k]).cast<float>()); });
    text += " (\n            interpolation = \"faceVarying\"\n        )\n";
  }
  for (std::size_t k = 0; k < phases.size(); ++k)
  {
    const std::string phase = "phase_" + std::to_string(k);
    text +=
      "        def GeomSubset \"" + phase +
      "\" (\n            prepend apiSchemas = [\"MaterialBindingAPI\"]\n        )\n        {\n"
      "            uniform token elementType = \"face\"\n"
      "            uniform token familyName = \"materialBind\"\n"
      "            int[] indices = ";
    append_list(text, static_cast<Eigen::Index>(phases[k].size()),
                [&](const Eigen::Index t)
                { meshes::append(text, phases[k][static_cast<std::size_t>(t)]); });
    text += "\n            rel material:binding = </cloth/materials/" + phase + ">\n        }\n";
  }
  file.append(text + "        point3f[] points.timeSamples = {\n");
}

void UsdAnimation::append(const FloatPoints &positions)
{
  check(name, positions, n_points);
  const std::string time = "            " + std::to_string(frame++) + ": ";
  std::string text       = time;
  append_list(text, positions.rows(),
              [&](const Eigen::Index k) { append_tuple(text, positions.row(k)); });
  file.append(text + ",\n");
  extents += time + '[';
  append_tuple(extents, positions.colwise().minCoeff().eval());
  extents += ", ";
  append_tuple(extents, positions.colwise().maxCoeff().eval());
  extents += "],\n";
}

void UsdAnimation::finish()
{
  file.append("        }\n        float3[] extent.timeSamples = {\n" + extents +
              "        }\n    }\n}\n");
  file.finish();
}
} // namespace homespun::meshes
