// SPDX-License-Identifier: MIT
#include "verification/strain/kept_positions.h"

#include "verification/record/number_text.h"
#include "verification/strain/cell_references.h"

#include <cmath>
#include <filesystem>

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
} // namespace homespun::verification
