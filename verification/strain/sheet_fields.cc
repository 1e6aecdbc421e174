// SPDX-License-Identifier: MIT
#include "verification/strain/sheet_fields.h"

#include "meshes/files/hdf5_writer.h"

namespace homespun::verification
{
void write_sheet_fields(const std::string &path, const meshes::Sheet &sheet,
                        const meshes::TriangleMesh &coarse_rest, const SheetFields &fields)
{
  meshes::Hdf5Writer file(path);
  const auto points = [&](const char *name, const meshes::Points &positions)
  {
    file.write(name, {static_cast<unsigned long long>(positions.rows()), 2}, positions.data(), "m");
  };
  const auto triangles = [&](const char *name, const meshes::TriangleMesh &mesh)
  {
    file.write(name, {static_cast<unsigned long long>(mesh.n_triangles()), 3},
               mesh.triangles.data());
  };
  points("/rest", sheet.mesh.vertices);
  triangles("/triangles", sheet.mesh);
  file.write("/material", {static_cast<unsigned long long>(sheet.mesh.n_triangles())},
             sheet.mesh.material.data());
  points("/reference", fields.fine);
  points("/upsampled", fields.upsampled);
  points("/coarse_rest", coarse_rest.vertices);
  triangles("/coarse_triangles", coarse_rest);
  points("/coarse", fields.coarse);
  file.attribute("/", "load", fields.load);
  file.attribute("/", "strain", fields.strain);
  file.attribute("/", "reference", fields.reference);
  file.attribute("/", "method", fields.method);
  file.finish();
}
} // namespace homespun::verification
