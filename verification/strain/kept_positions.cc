// SPDX-License-Identifier: MIT
#include "verification/strain/kept_positions.h"

#include "meshes/files/hdf5_reader.h"
#include "meshes/plain/errors.h"
#include "verification/record/number_text.h"
#include "verification/strain/cell_references.h"
#include "verification/strain/sheet_fields.h"

#include <cmath>
#include <filesystem>

namespace homespun::verification
{
std::string file_name_of(const StrainLevel &level)
{
  return level.load + "-" + name_of(level.law) + "-" + short_text(level.strain);
}

std::string folder_of_positions(const std::string &run, const std::string &cell)
{
  return run + "/" + cell + "/positions";
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
    add_meshes(file, sheet, coarse_rest);
    file.finish();
  }
  meshes::Hdf5Writer file(folder + "/" + file_name_of(level) + ".h5");
  add_points(file, "/coarse", positions.coarse);
  add_points(file, "/reference", positions.reference);
  file.attribute("/", "load", level.load);
  file.attribute("/", "law", name_of(level.law));
  file.attribute("/", "strain", level.strain);
  file.finish();
}

meshes::Points kept_reference(const std::string &run, const StrainLevel &level,
                              const int n_vertices)
{
  const std::string path = folder_of_positions(run, level.cell) + "/" + file_name_of(level) + ".h5";
  if (!std::filesystem::exists(path))
    throw meshes::BadInput(path + ": is not there; expected the positions of the reference, which "
                                  "`homespun strain --keep` leaves: run the study with it");
  const meshes::Hdf5Reader file(path, "the positions of a level");
  const std::vector<double> values =
    file.numbers("/reference", {static_cast<unsigned long long>(n_vertices), 2});
  return Eigen::Map<const meshes::Points>(values.data(), n_vertices, 2);
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
} // namespace homespun::verification
