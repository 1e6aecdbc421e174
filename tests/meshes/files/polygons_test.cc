// SPDX-License-Identifier: MIT
// Frames of other programs: OBJ and PLY as they are written elsewhere, and all that may be wrong.
#include "meshes/files/polygons.h"

#include "meshes/files/obj_file.h"
#include "meshes/files/surface_files.h"
#include "tests/content_of.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace homespun::meshes
{
namespace
{
/// A folder of this process alone, which goes away with it.
const struct Folder
{
  Folder()
  {
    std::filesystem::create_directories(path);
  }
  ~Folder()
  {
    std::filesystem::remove_all(path);
  }
  const std::filesystem::path path =
    std::filesystem::temp_directory_path() / ("homespun-polygons-" + std::to_string(::getpid()));
} folder;

std::string file_with(const std::string &content, const std::string &name = "mesh.ply")
{
  const std::string path = (folder.path / name).string();
  std::ofstream(path, std::ios::binary) << content;
  return path;
}

std::string refused(const std::string &content, const std::string &name = "mesh.ply")
{
  const std::string path = file_with(content, name);
  return tests::refusal([&]() { read_polygons(path); });
}

const std::string header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                           "property float y\nproperty float z\nelement face 2\n"
                           "property list uchar int vertex_indices\nend_header\n";
const std::string square = header + "0 0 0\n1 0 0\n1 1 0\n0 1 -2.5e-1\n3 0 1 2\n4 0 1 2 3\n";

template <typename Number>
std::string bytes_of(const std::vector<Number> &numbers)
{
  return {reinterpret_cast<const char *>(numbers.data()), numbers.size() * sizeof(Number)};
}

/// A binary file with doubles, properties that are not asked for, a list among them, another order
/// of elements and shorter integers.
std::string odd_binary()
{
  std::string text = "ply\r\nformat binary_little_endian 1.0\r\ncomment made elsewhere\r\n"
                     "obj_info none\r\nelement face 1\r\nproperty uchar flags\r\n"
                     "property list ushort ushort vertex_index\r\nelement edge 1\r\n"
                     "property int a\r\nproperty list int16 float32 weights\r\nelement vertex 3\r\n"
                     "property double z\r\nproperty uchar red\r\nproperty double x\r\n"
                     "property list uint8 int8 tags\r\nproperty double y\r\nend_header\r\n";
  text += bytes_of<std::uint8_t>({7}) + bytes_of<std::uint16_t>({3, 2, 0, 1});
  text += bytes_of<std::int32_t>({5}) + bytes_of<std::int16_t>({2}) + bytes_of<float>({0.5f, 1.f});
  for (int v = 0; v < 3; ++v)
    text += bytes_of<double>({0.1 * v}) + bytes_of<std::uint8_t>({255}) +
            bytes_of<double>({v + 0.25}) + bytes_of<std::uint8_t>({2}) +
            bytes_of<std::int8_t>({1, -1}) + bytes_of<double>({-1. / 3.});
  return text;
}
} // namespace

TEST(exact_polygons, text_and_binary_with_foreign_properties_are_read)
{
  const Polygons text = read_polygons(file_with(square));
  EXPECT_EQ(text.positions.row(3), Eigen::RowVector3d(0., 1., -0.25));
  EXPECT_EQ(text.faces, (std::vector<Polygon>{{0, 1, 2, -1}, {0, 1, 2, 3}}));
  const Polygons binary = read_polygons(file_with(odd_binary()));
  EXPECT_EQ(binary.faces, (std::vector<Polygon>{{2, 0, 1, -1}}));
  for (int v = 0; v < 3; ++v)
    EXPECT_EQ(binary.positions.row(v), Eigen::RowVector3d(v + 0.25, -1. / 3., 0.1 * v));
}

TEST(exact_polygons, what_is_written_here_is_read_back)
{
  const FloatPoints points = FloatPoints::Random(5, 3);
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 4, 2, 3;
  const std::string ply = file_with("", "own.ply"), obj = file_with("", "own.obj");
  write_ply(ply, points, triangles);
  write_obj(obj, points.cast<double>(), triangles);
  for (const std::string &file : {ply, obj})
  {
    const Polygons read = read_polygons(file);
    EXPECT_EQ(read.positions, points.cast<double>()) << file;
    EXPECT_EQ(read.faces, (std::vector<Polygon>{{0, 1, 2, -1}, {4, 2, 3, -1}})) << file;
    EXPECT_FALSE(read.has_vt);
  }
}

TEST(exact_polygons, a_flat_mesh_is_a_cloth_at_rest)
{
  const std::string flat = header + "0 0 3\n2 0 3\n2 1 3\n0 1 3\n3 0 1 2\n3 0 2 3\n";
  const Polygons mesh    = read_polygons(file_with(flat));
  const ClothMesh cloth  = flat_cloth(mesh, "flat");
  EXPECT_EQ(cloth.rest.vertices, mesh.positions.leftCols<2>());
  EXPECT_EQ(cloth.rest.triangles, cloth.triangles);
  EXPECT_EQ(cloth.positions, mesh.positions);
  const std::string text =
    tests::refusal([&]() { flat_cloth(read_polygons(file_with(square)), "bent.ply"); });
  EXPECT_NE(text.find("bent.ply: is not flat: vertex "), std::string::npos) << text;
  EXPECT_NE(text.find("expected the rest state as vt of an OBJ file"), std::string::npos) << text;
}

TEST(exact_polygons, a_flat_mesh_may_lie_in_any_plane_and_is_seen_from_its_upper_side)
{
  const std::string flat = header + "0 0 0\n2 0 0\n2 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  const Polygons lying   = read_polygons(file_with(flat));
  const Eigen::Matrix3d to_y_up =
    (Eigen::Matrix3d() << 1., 0., 0., 0., 0., 1., 0., -1., 0.).finished();
  const Eigen::Matrix3d to_x = (Eigen::Matrix3d() << 0., 0., 1., 1., 0., 0., 0., 1., 0.).finished();
  // A plane that the first axis lies in stays seen along it.
  const Eigen::Matrix3d tilted =
    Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX()).toRotationMatrix();
  for (const Eigen::Matrix3d &turn : {to_y_up, to_x, tilted})
  {
    Polygons mesh = lying;
    mesh.positions =
      (lying.positions * turn.transpose()).rowwise() + Eigen::RowVector3d(0.1, 0.3, 0.2);
    const ClothMesh cloth           = flat_cloth(mesh, "flat");
    const Eigen::RowVector2d corner = cloth.rest.vertices.row(0);
    EXPECT_LT((cloth.rest.vertices.rowwise() - corner - lying.positions.leftCols<2>())
                .cwiseAbs()
                .maxCoeff(),
              1e-15)
      << turn;
    for (Polygon &face : mesh.faces)
      std::swap(face[1], face[2]);
    const std::string text = tests::refusal([&]() { flat_cloth(mesh, "turned.obj"); });
    EXPECT_NE(text.find("turned.obj: all faces run clockwise seen from "), std::string::npos)
      << text;
    EXPECT_EQ(text.find("vt"), std::string::npos) << text;
    std::swap(mesh.faces[0][1], mesh.faces[0][2]);
    EXPECT_NE(tests::refusal([&]() { flat_cloth(mesh, "mixed.obj"); })
                .find("mixed.obj: 1 of 2 faces run clockwise"),
              std::string::npos);
  }
}

TEST(tripwire_polygons, every_truncation_is_refused)
{
  const std::string whole = odd_binary();
  for (std::size_t n = 0; n < whole.size(); ++n)
    EXPECT_NE(refused(whole.substr(0, n)), "") << n;
  // Of text the last number may be cut and still be one, and the last end of line is not needed.
  for (std::size_t n = 0; n + 2 < square.size(); ++n)
    EXPECT_NE(refused(square.substr(0, n)), "") << n;
}

TEST(tripwire_polygons, positions_that_are_not_finite_are_named_by_their_vertex)
{
  for (const std::string word : {"nan", "inf", "-inf"})
  {
    std::string text = square;
    text.replace(text.find("1 1 0"), 1, word);
    const std::string fault = refused(text);
    EXPECT_NE(fault.find("mesh.ply: vertex 2 is at (" + word), std::string::npos) << fault;
  }
  const std::string of_obj = refused("v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n", "nan.obj");
  EXPECT_NE(of_obj.find("nan.obj: line 3: found `nan`; expected a finite number, v 3 of the file"),
            std::string::npos)
    << of_obj;
}

TEST(tripwire_polygons, faults_are_named)
{
  const auto changed = [](const std::string &before, const std::string &after)
  {
    std::string text = square;
    return text.replace(text.find(before), before.size(), after);
  };
  const std::vector<std::pair<std::string, std::string>> cases = {
    {"", "its header has no `end_header`"},
    {"solid\nend_header\n", "does not begin with `ply`"},
    {changed("ascii", "binary_big_endian"), "found format `binary_big_endian`; expected ascii or"},
    {changed("format ascii 1.0\n", ""), "its header has no `format`"},
    {changed("float y", "complex y"), "found `property complex y` in its header"},
    {changed("vertex 4", "vertex four"), "found `element vertex four` in its header"},
    {changed("vertex 4", "vertex 4000000000"), "says that it has 4000000000 of `vertex`"},
    {changed("float z", "float w"), "has no `vertex` with x, y and z"},
    {changed("vertex_indices", "corners"), "has no `face` with `vertex_indices`"},
    {changed("4 0 1 2 3", "5 0 1 2 3 0"), "face 1 has 5 corners; expected 3 or 4"},
    {changed("4 0 1 2 3", "9999999 0"), "found a list `vertex_indices` with a length of 9999999"},
    {changed("4 0 1 2 3", "4 0 1 2 4"),
     "face 1 names a vertex that does not exist; expected 0 to 3"},
    {changed("4 0 1 2 3", "4 0 1 2 -1"), "face 1 names a vertex that does not exist"},
    {changed("1 1 0", "1 1,0 0"), "found `1,0`; expected a number"}};
  for (const auto &[text, words] : cases)
    EXPECT_NE(refused(text).find("mesh.ply: " + words), std::string::npos) << refused(text);
  EXPECT_NE(refused("", "mesh.stl").find("found the ending `.stl`; expected .obj or .ply"),
            std::string::npos);
  EXPECT_NE(tests::refusal([]() { read_polygons("/nowhere/a.ply"); })
              .find("/nowhere/a.ply: cannot be read"),
            std::string::npos);
}
} // namespace homespun::meshes
