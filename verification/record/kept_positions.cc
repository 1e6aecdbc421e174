// SPDX-License-Identifier: MIT
#include "verification/record/kept_positions.h"

#include "meshes/files/hdf5_reader.h"
#include "meshes/plain/errors.h"
#include "verification/record/checksum.h"

#include <filesystem>
#include <vector>

namespace homespun::verification
{
std::string folder_of_positions(const std::string &run, const std::string &cell)
{
  return run + "/" + cell + "/positions";
}

void write_positions(meshes::Hdf5Writer &file, const std::string &name,
                     const PositionRows &positions)
{
  file.write(name,
             {static_cast<unsigned long long>(positions.rows()),
              static_cast<unsigned long long>(positions.cols())},
             positions.data(), "m");
}

void write_triangles(meshes::Hdf5Writer &file, const std::string &name,
                     const meshes::Triangles &triangles)
{
  file.write(name, {static_cast<unsigned long long>(triangles.rows()), 3}, triangles.data());
}

void write_meshes(meshes::Hdf5Writer &file, const meshes::Sheet &sheet,
                  const meshes::TriangleMesh &coarse_rest)
{
  const Eigen::VectorXi &material = sheet.mesh.material;
  write_positions(file, "/rest", sheet.mesh.vertices);
  write_triangles(file, "/triangles", sheet.mesh.triangles);
  file.write("/material", {static_cast<unsigned long long>(material.size())}, material.data());
  write_positions(file, "/coarse_rest", coarse_rest.vertices);
  write_triangles(file, "/coarse_triangles", coarse_rest.triangles);
}

std::string KeptMesh::checksum() const
{
  const auto bytes = [](const auto &matrix)
  {
    return std::string(reinterpret_cast<const char *>(matrix.data()),
                       sizeof(*matrix.data()) * static_cast<std::size_t>(matrix.size()));
  };
  return checksum_of_text(bytes(vertices) + bytes(triangles));
}

void keep_state(const std::string &folder, const std::string &name, const KeptMesh &mesh,
                const KeptPositions &positions,
                const std::function<void(meshes::Hdf5Writer &)> &describe)
{
  std::filesystem::create_directories(folder);
  meshes::Hdf5Writer file(folder + "/" + name + ".h5");
  write_positions(file, "/coarse", positions.coarse);
  write_positions(file, "/reference", positions.reference);
  file.attribute("/", "mesh", mesh.checksum());
  describe(file);
  file.finish();
}

namespace
{
constexpr const char *kept_by = "which `homespun strain --keep` or `drape --keep` leaves";

void refuse_absent(const std::string &path, const char *what)
{
  if (!std::filesystem::exists(path))
    throw meshes::BadInput(path + ": is not there; expected " + what + ", " + kept_by +
                           ": run the study with it");
}
} // namespace

KeptMesh kept_mesh(const std::string &path, const std::string &vertices)
{
  refuse_absent(path, "the meshes of the positions");
  constexpr auto any = meshes::Hdf5Reader::any;
  const meshes::Hdf5Reader file(path, "the meshes of kept positions");
  const auto points                = file.shape_of(vertices, {any, any}),
             corners               = file.shape_of("/triangles", {any, 3});
  const std::vector<double> values = file.numbers(vertices, points);
  const std::vector<int> indices   = file.integers("/triangles", corners);
  return {
    Eigen::Map<const PositionRows>(values.data(), static_cast<Eigen::Index>(points[0]),
                                   static_cast<Eigen::Index>(points[1])),
    Eigen::Map<const meshes::Triangles>(indices.data(), static_cast<Eigen::Index>(corners[0]), 3)};
}

PositionRows kept_reference(const std::string &folder, const std::string &name,
                            const KeptMesh &mesh)
{
  const std::string path = folder + "/" + name + ".h5";
  refuse_absent(path, "the positions of the reference");
  const meshes::Hdf5Reader file(path, "the positions of a state");
  if (file.text_attribute("/", "mesh") != mesh.checksum())
    throw meshes::BadInput(path +
                           ": is not of the mesh that lies beside it; expected the "
                           "checksum " +
                           mesh.checksum() +
                           " in its attribute `mesh`: run the study again, with "
                           "--keep --overwrite");
  const Eigen::Index n = mesh.vertices.rows(), c = mesh.vertices.cols();
  const std::vector<double> values = file.numbers(
    "/reference", {static_cast<unsigned long long>(n), static_cast<unsigned long long>(c)});
  return Eigen::Map<const PositionRows>(values.data(), n, c);
}
} // namespace homespun::verification
