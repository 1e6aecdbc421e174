// SPDX-License-Identifier: MIT
#include "verification/strain/kept_positions.h"

#include "meshes/files/surface_files.h"
#include "verification/record/number_text.h"
#include "verification/strain/cell_references.h"

#include <cmath>
#include <filesystem>
#include <vector>

namespace homespun::verification
{
std::string file_name_of(const StrainLevel &level)
{
  return level.load + "-" + name_of(level.law) + "-" + short_text(level.strain);
}

void keep(const std::string &run, const StrainLevel &level, const meshes::Sheet &sheet,
          const meshes::TriangleMesh &coarse_rest, const KeptPositions &positions)
{
  const std::string folder = folder_of_positions(run, level.cell);
  std::filesystem::create_directories(folder);
  const std::string of_meshes =
    folder + (Load(level.load).is_periodic() ? "/periodic.h5" : "/sheet.h5");
  if (!std::filesystem::exists(of_meshes))
  {
    meshes::Hdf5Writer file(of_meshes);
    write_meshes(file, sheet, coarse_rest);
    file.finish();
  }
  keep_state(folder, file_name_of(level), {sheet.mesh.vertices, sheet.mesh.triangles}, positions,
             [&](meshes::Hdf5Writer &file)
             {
               file.attribute("/", "load", level.load);
               file.attribute("/", "law", name_of(level.law));
               file.attribute("/", "strain", level.strain);
             });
}

std::string note_on_keeping(const StrainStudyOptions &options,
                            const std::vector<homogenization::UnitCell> &cells)
{
  double bytes = 0.;
  for (const homogenization::UnitCell &cell : cells)
    for (const std::string &load : options.loads)
    {
      const double n_cells = Load(load).is_periodic() ? options.supercell[0] * options.supercell[1]
                                                      : options.n_cells * options.n_cells;
      bytes +=
        2. * sizeof(double) * n_cells * cell.mesh.n_vertices() *
        static_cast<double>(options_of(options, cell).references.size() * options.strains.size());
    }
  return "positions of all levels are kept, at most " + short_text(std::ceil(bytes / 1e6)) + " MB";
}

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
