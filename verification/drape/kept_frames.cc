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

namespace
{
KeptMesh mesh_of(const DrapedCell &draped)
{
  return {draped.at_fine_vertices(draped.fine.positions), draped.fine_triangles()};
}
} // namespace

void keep_cloth(const std::string &run, const DrapedCell &draped)
{
  const std::string folder = folder_of_positions(run, draped.cell.name);
  std::filesystem::create_directories(folder);
  meshes::Hdf5Writer file(folder + "/cloth.h5");
  const KeptMesh mesh = mesh_of(draped);
  write_positions(file, "/start", mesh.vertices);
  write_positions(file, "/coarse_start", draped.coarse.positions);
  if (draped.sheet)
    write_meshes(file, *draped.sheet, draped.coarse.rest);
  else
  {
    write_triangles(file, "/triangles", mesh.triangles);
    write_triangles(file, "/coarse_triangles", draped.coarse.triangles);
  }
  file.finish();
}

void keep_frame(const std::string &run, const DrapedCell &draped, const std::string &reference,
                const int frame, const KeptPositions &positions)
{
  keep_state(folder_of_positions(run, draped.cell.name), file_name_of(reference, frame),
             mesh_of(draped), positions,
             [&](meshes::Hdf5Writer &file)
             {
               file.attribute("/", "reference", reference);
               file.attribute("/", "frame", frame);
             });
}
} // namespace homespun::verification
