// SPDX-License-Identifier: MIT
#include "verification/drape/kept_frames.h"

#include "meshes/files/hdf5_reader.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

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
constexpr const char *coarse_step = "coarse_time_step_uncertainty_m";

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

void keep_frame(const std::string &run, const DrapedCell &draped, const KeptFrame &frame)
{
  keep_state(folder_of_positions(run, draped.cell.name),
             file_name_of(frame.reference, frame.number), mesh_of(draped), frame.positions,
             [&](meshes::Hdf5Writer &file)
             {
               file.attribute("/", "reference", frame.reference);
               file.attribute("/", "frame", frame.number);
               if (std::isfinite(frame.coarse_step))
                 file.attribute("/", coarse_step, frame.coarse_step);
             });
}

double kept_coarse_step(const std::string &folder, const std::string &name)
{
  const meshes::Hdf5Reader file(folder + "/" + name + ".h5", "the positions of a state");
  return file.number_attribute("/", coarse_step).value_or(std::numeric_limits<double>::quiet_NaN());
}
} // namespace homespun::verification
