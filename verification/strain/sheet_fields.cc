// SPDX-License-Identifier: MIT
#include "verification/strain/sheet_fields.h"

#include "meshes/files/surface_files.h"
#include "verification/record/number_text.h"

#include <vector>

namespace homespun::verification
{
namespace
{
void add_triangles(meshes::Hdf5Writer &file, const std::string &name,
                   const meshes::TriangleMesh &mesh)
{
  file.write(name, {static_cast<unsigned long long>(mesh.n_triangles()), 3}, mesh.triangles.data());
}
} // namespace

void add_points(meshes::Hdf5Writer &file, const std::string &name, const meshes::Points &points)
{
  file.write(name, {static_cast<unsigned long long>(points.rows()), 2}, points.data(), "m");
}

void add_meshes(meshes::Hdf5Writer &file, const meshes::Sheet &sheet,
                const meshes::TriangleMesh &coarse_rest)
{
  add_points(file, "/rest", sheet.mesh.vertices);
  add_triangles(file, "/triangles", sheet.mesh);
  file.write("/material", {static_cast<unsigned long long>(sheet.mesh.n_triangles())},
             sheet.mesh.material.data());
  add_points(file, "/coarse_rest", coarse_rest.vertices);
  add_triangles(file, "/coarse_triangles", coarse_rest);
}

void write_sheet_fields(const std::string &path, const meshes::Sheet &sheet,
                        const meshes::TriangleMesh &coarse_rest, const SheetFields &fields)
{
  meshes::Hdf5Writer file(path);
  add_meshes(file, sheet, coarse_rest);
  add_points(file, "/reference", fields.fine);
  add_points(file, "/upsampled", fields.upsampled);
  add_points(file, "/coarse", fields.coarse);
  file.attribute("/", "load", fields.load);
  file.attribute("/", "strain", fields.strain);
  file.attribute("/", "reference", fields.reference);
  file.attribute("/", "method", fields.method);
  file.finish();
}

void write_sheet_vtu(const std::string &path, const meshes::Sheet &sheet, const SheetFields &fields)
{
  const meshes::Points &rest = sheet.mesh.vertices;
  const auto in_space        = [](const meshes::Points &points)
  {
    meshes::FloatPoints all = meshes::FloatPoints::Zero(points.rows(), 3);
    all.leftCols<2>()       = points.cast<float>();
    return all;
  };
  std::vector<meshes::VertexData> data;
  const auto displacement = [&](const std::string &of, const meshes::Points &positions) {
    data.push_back({"displacement " + of + " [m]", in_space(positions - rest)});
  };
  const auto error = [&](const std::string &of, const meshes::Points &positions)
  {
    const Eigen::VectorXf distance = (positions - fields.fine).rowwise().norm().cast<float>();
    data.push_back({"error " + of + " [m]", distance});
  };
  displacement("reference", fields.fine);
  displacement("affine", fields.affine);
  displacement(fields.method, fields.upsampled);
  error("affine", fields.affine);
  error(fields.method, fields.upsampled);
  const Eigen::VectorXf phase = sheet.mesh.material.cast<float>();
  meshes::write_vtu(
    path, in_space(rest), sheet.mesh.triangles, data, {{"phase", phase}},
    {{"load, strain, reference", {fields.load, short_text(fields.strain), fields.reference}}});
}
} // namespace homespun::verification
