// SPDX-License-Identifier: MIT
#include "verification/drape/kept_frames.h"

#include <cstdio>
#include <filesystem>

namespace homespun::verification
{
std::string file_name_of(const std::string &reference, const int frame)
{
  char number[16];
  std::snprintf(number, sizeof(number), "-%04d", frame);
  return reference + number;
}

void keep_cloth(const std::string &run, const DrapedCell &draped)
{
  const std::string folder = folder_of_positions(run, draped.cell.name);
  std::filesystem::create_directories(folder);
  meshes::Hdf5Writer file(folder + "/cloth.h5");
  const auto write_triangles = [&](const std::string &name, const meshes::Triangles &triangles) {
    file.write(name, {static_cast<unsigned long long>(triangles.rows()), 3}, triangles.data());
  };
  write_positions(file, "/start", draped.at_fine_vertices(draped.fine.positions));
  write_triangles("/triangles", draped.fine_triangles());
  write_positions(file, "/coarse_start", draped.coarse.positions);
  write_triangles("/coarse_triangles", draped.coarse.triangles);
  if (draped.sheet)
  {
    write_positions(file, "/rest", draped.sheet->mesh.vertices);
    write_positions(file, "/coarse_rest", draped.coarse.rest.vertices);
    const Eigen::VectorXi &material = draped.sheet->mesh.material;
    file.write("/material", {static_cast<unsigned long long>(material.size())}, material.data());
  }
  file.finish();
}

void keep_frame(const std::string &run, const std::string &cell, const std::string &reference,
                const int frame, const KeptPositions &positions)
{
  keep_state(folder_of_positions(run, cell), file_name_of(reference, frame), positions,
             [&](meshes::Hdf5Writer &file)
             {
               file.attribute("/", "reference", reference);
               file.attribute("/", "frame", frame);
             });
}
} // namespace homespun::verification
