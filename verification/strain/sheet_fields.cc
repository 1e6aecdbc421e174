// SPDX-License-Identifier: MIT
#include "verification/strain/sheet_fields.h"

#include "meshes/files/surface_files.h"
#include "verification/record/kept_positions.h"
#include "verification/record/number_text.h"

#include <vector>

namespace homespun::verification
{
void write_sheet_fields(const std::string &path, const meshes::Sheet &sheet,
                        const meshes::TriangleMesh &coarse_rest, const SheetFields &fields)
{
  meshes::Hdf5Writer file(path);
  write_meshes(file, sheet, coarse_rest);
  write_positions(file, "/reference", fields.fine);
  write_positions(file, "/upsampled", fields.upsampled);
  write_positions(file, "/coarse", fields.coarse);
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
