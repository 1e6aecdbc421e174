// SPDX-License-Identifier: MIT
// One cell in every format: what Gmsh and VTK wrote of data/halves.geo holds the same areas by
// group.
#include "homogenization/cell/cell_mesh_file.h"
#include "meshes/plain/lattice.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

using namespace homespun;
using namespace homespun::homogenization;

namespace
{
const std::string data = DATA;

double area_of(const CellMeshFile &file, const int group)
{
  const Eigen::VectorXd areas = meshes::signed_areas(file.mesh);
  double sum                  = 0.;
  for (int t = 0; t < file.mesh.n_triangles(); ++t)
    sum += file.mesh.material(t) == group ? areas(t) : 0.;
  return sum;
}

/// Soft is 3/8 of the square, hard 5/8, in triangles that all turn left.
void expect_halves(const std::string &name, const int soft, const int hard)
{
  const CellMeshFile file = read_cell_mesh(data + name);
  EXPECT_EQ(file.mesh.n_triangles(), 16) << name;
  EXPECT_EQ(file.mesh.n_vertices(), 15) << name;
  EXPECT_NEAR(area_of(file, soft), 0.375, 1e-12) << name;
  EXPECT_NEAR(area_of(file, hard), 0.625, 1e-12) << name;
  EXPECT_TRUE(meshes::faults_of(file.mesh, name).empty()) << name;
  EXPECT_NEAR(meshes::lattice_of_outline(file.mesh).area(), 1., 1e-12) << name;
}

class Folder
{
public:
  Folder()
      : path(std::filesystem::temp_directory_path() /
             (std::string("homespun-mesh-") +
              testing::UnitTest::GetInstance()->current_test_info()->name()))
  {
    std::filesystem::create_directories(path);
  }
  ~Folder()
  {
    std::filesystem::remove_all(path);
  }
  std::string file(const std::string &name, const std::string &content) const
  {
    std::ofstream(path / name) << content;
    return (path / name).string();
  }

  const std::filesystem::path path;
};

std::string content_of(const std::string &file)
{
  std::ifstream input(file, std::ios::binary);
  std::ostringstream text;
  text << input.rdbuf();
  return text.str();
}

/// Two triangles and a quadrilateral around it, as AVS UCD.
const std::string ucd = "# a comment\n5 4 0 0 0\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 2 0 0\n"
                        "1 9 line 1 2\n2 4 tri 1 2 3\n3 4 tri 1 3 4\n4 6 tri 2 5 3\n";
} // namespace

TEST(exact_cell_mesh_file, gmsh_formats_hold_the_same_groups_by_name_and_number)
{
  for (const char *name : {"halves-msh22.msh", "halves-msh40.msh", "halves-msh41.msh"})
  {
    expect_halves(name, 7, 3);
    EXPECT_EQ(read_cell_mesh(data + name).number_of_name.at("soft"), 7) << name;
  }
  expect_halves("quadrilaterals.msh", 7, 3);
  for (const char *name : {"halves.unv", "quadrilaterals.unv"})
  {
    const auto names = read_cell_mesh(data + name).number_of_name;
    expect_halves(name, names.at("soft"), names.at("hard"));
  }
  for (const char *name : {"halves-abaqus.inp", "quadrilaterals-abaqus.inp"})
  {
    const auto names = read_cell_mesh(data + name).number_of_name;
    expect_halves(name, names.at("soft"), names.at("hard"));
  }
}

TEST(exact_cell_mesh_file, vtk_formats_hold_the_same_groups_in_every_encoding)
{
  expect_halves("halves.vtk", 7, 3);
  for (const char *name : {"version-5.vtk", "text.vtu", "base64.vtu", "base64-zlib.vtu",
                           "appended-raw.vtu", "appended-raw-zlib.vtu", "appended-base64.vtu"})
  {
    expect_halves(name, 7, 3);
    const CellMeshFile file = read_cell_mesh(data + name);
    ASSERT_EQ(file.angle.size(), 16) << name;
    for (int t = 0; t < 16; ++t)
      EXPECT_EQ(file.angle(t), 10. * t) << name;
  }
}

TEST(exact_cell_mesh_file, ucd_is_told_from_abaqus_by_its_first_letter)
{
  const Folder folder;
  for (const char *name : {"cell.inp", "cell.ucd"})
  {
    const CellMeshFile file = read_cell_mesh(folder.file(name, ucd));
    EXPECT_EQ(file.mesh.n_triangles(), 3);
    EXPECT_NEAR(area_of(file, 4), 1., 1e-14);
    EXPECT_NEAR(area_of(file, 6), 0.5, 1e-14);
  }
}

TEST(exact_cell_mesh_file, quadrilaterals_are_cut_along_the_shorter_diagonal_and_turned_left)
{
  const Folder folder;
  // A kite, clockwise: its diagonals are 2 (first to third corner) and 1.
  const std::string kite =
    "4 1 0 0 0\n1 0 0 0\n2 0.5 0.5 0\n3 2 0 0\n4 0.5 -0.5 0\n1 0 quad 1 2 3 4\n";
  const CellMeshFile file = read_cell_mesh(folder.file("kite.ucd", kite));
  ASSERT_EQ(file.mesh.n_triangles(), 2);
  EXPECT_GT(meshes::signed_areas(file.mesh).minCoeff(), 0.);
  for (int t = 0; t < 2; ++t)
  {
    std::set<int> corners(file.mesh.triangles.row(t).begin(), file.mesh.triangles.row(t).end());
    EXPECT_TRUE(corners.count(1) == 1 && corners.count(3) == 1) << "cut along the shorter diagonal";
  }
  // An arrow head: only the longer diagonal lies inside.
  const std::string arrow =
    "4 1 0 0 0\n1 0 0 0\n2 -1 0.4 0\n3 3 0 0\n4 -1 -0.4 0\n1 0 quad 1 2 3 4\n";
  EXPECT_GT(meshes::signed_areas(read_cell_mesh(folder.file("arrow.ucd", arrow)).mesh).minCoeff(),
            0.);
}

TEST(exact_cell_mesh_file, abaqus_sets_may_stand_anywhere_and_hold_others)
{
  const Folder folder;
  const std::string whole = content_of(data + "halves-abaqus.inp");
  const std::string head  = whole.substr(0, whole.find("*ELSET,ELSET=hard"));
  const auto expect_same  = [&](const std::string &name, const std::string &content)
  {
    const CellMeshFile file = read_cell_mesh(folder.file(name, content));
    EXPECT_EQ(file.number_of_name.size(), 2u) << name;
    EXPECT_NEAR(area_of(file, file.number_of_name.at("soft")), 0.375, 1e-9) << name;
    EXPECT_NEAR(area_of(file, file.number_of_name.at("hard")), 0.625, 1e-9) << name;
  };
  expect_same("before.inp", whole.substr(whole.find("*ELSET,ELSET=hard")) + "\n" + head);
  expect_same(
    "nested.inp",
    head + "*ELSET, ELSET=soft\nleft, right\n*ELSET, ELSET=left, GENERATE\n1, 7, 2\n"
           "*ELSET, ELSET=right\n2, 4, 6, 8\n*ELSET, ELSET=hard, GENERATE\n9, 2000000000, 1\n");
  expect_same("of-elements.inp",
              head + "*ELSET, ELSET=hard\nSurface2\n*ELSET, ELSET=soft\nSurface1\n");
  expect_same("continued.inp",
              head + "*ELSET,\nELSET=hard, GENERATE\n9, 16\n*ELSET, ELSET=soft, GENERATE\n1, 8\n");
}

TEST(exact_cell_mesh_file, unv_groups_may_be_empty_and_stand_before_the_elements)
{
  const Folder folder;
  const std::string whole  = content_of(data + "halves.unv");
  const std::size_t groups = whole.find("    -1\n  2477");
  ASSERT_NE(groups, std::string::npos);
  const std::string empty =
    "         5         0         0         0         0         0         0         0\nnone\n";
  std::string behind = whole, in_front = whole;
  behind.insert(whole.rfind("    -1"), empty);
  in_front.insert(whole.find("\n", groups + 8) + 1, empty);
  for (const std::string &content :
       {behind, in_front, whole.substr(groups) + whole.substr(0, groups)})
  {
    const CellMeshFile file = read_cell_mesh(folder.file("cell.unv", content));
    EXPECT_EQ(file.number_of_name.count("none"), 0u);
    EXPECT_NEAR(area_of(file, file.number_of_name.at("soft")), 0.375, 1e-9);
    EXPECT_NEAR(area_of(file, file.number_of_name.at("hard")), 0.625, 1e-9);
  }
}

TEST(exact_cell_mesh_file, a_point_that_no_element_uses_may_lie_anywhere)
{
  const Folder folder;
  const std::string cell = "4 1 0 0 0\n1 3 4 5\n2 0 0 0\n3 1 0 0\n4 0 1 0\n1 0 tri 2 3 4\n";
  EXPECT_EQ(read_cell_mesh(folder.file("cell.ucd", cell)).mesh.n_vertices(), 3);
}

TEST(exact_cell_mesh_file, a_file_without_groups_is_group_zero)
{
  const Folder folder;
  const std::string vtk = "# vtk DataFile Version 2.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS "
                          "3 double\n0 0 0 1 0 0 0 1 0\n"
                          "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n";
  EXPECT_EQ(read_cell_mesh(folder.file("cell.vtk", vtk)).mesh.material(0), 0);
}

TEST(tripwire_cell_mesh_file, every_format_cut_off_anywhere_is_refused_or_read_as_less)
{
  const Folder folder;
  for (const char *name :
       {"halves-msh22.msh", "halves-msh40.msh", "halves-msh41.msh", "halves.vtk", "version-5.vtk",
        "text.vtu", "base64.vtu", "base64-zlib.vtu", "appended-raw.vtu", "appended-raw-zlib.vtu",
        "appended-base64.vtu", "halves.unv", "halves-abaqus.inp"})
  {
    const std::string whole  = content_of(data + name);
    const std::string ending = std::filesystem::path(name).extension().string();
    int refused              = 0;
    for (std::size_t length = 0; length < whole.size(); length += 37)
    {
      const std::string path = folder.file("cut" + ending, whole.substr(0, length));
      // Nothing but BadInput leaves; its message names the file.
      const std::string message = tests::refusal([&]() { read_cell_mesh(path); });
      refused += message.empty() ? 0 : 1;
      EXPECT_TRUE(message.empty() || message.find("cut" + ending) != std::string::npos) << message;
    }
    EXPECT_GT(refused, static_cast<int>(whole.size() / 37) / 2) << name;
  }
}

TEST(tripwire_cell_mesh_file, what_cannot_be_a_cell_is_refused_with_what_to_do)
{
  const Folder folder;
  const auto says =
    [&](const std::string &name, const std::string &content, const std::string &part)
  {
    const std::string message =
      tests::refusal([&]() { read_cell_mesh(folder.file(name, content)); });
    EXPECT_NE(message.find(part), std::string::npos) << name << ": " << message;
  };
  says("a.exo", "CDF", "its ending is `.exo`; expected Gmsh .msh");
  says("a.ucd", "1 1 0 0 0\n1 0 0 0\n1 0 tet 1 1 1 1\n", "mesh the surface alone");
  says("b.ucd", "3 1 0 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n1 0 tri 1 2 4\n", "names point 4");
  says("c.ucd", "3 1 0 0 0\n1 0 0 0\n2 1 0 1\n3 0 1 0\n1 0 tri 1 2 3\n",
       "not flat: z reaches from 0 to 1");
  says("d.ucd", "999999999 1 0 0 0\n", "at most what the rest of the file can hold");
  says("a.msh", "$MeshFormat\n4.1 1 8\n", "binary .msh; expected text");
  says("b.msh", "$MeshFormat\n3.0 0 8\n$EndMeshFormat\n", "expected 2, 4.0 or 4.1");
  says("c.msh",
       "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n0\n$EndNodes\n$Elements\n1\n1 10 2 0 0 1 2 3 "
       "4 5 6 7 8 9\n$EndElements\n",
       "-order 1");
  says("a.vtk", "# vtk DataFile Version 3.0\nx\nBINARY\n", "expected ASCII");
  says("a.inp", "*NODE\n1, 0, 0\n*ELEMENT, TYPE=C3D8\n", "Abaqus' type `C3D8`");
  says("b.inp", "*NODE, SYSTEM=C\n1, 1, 90\n", "cylindrical or spherical coordinates");
  says("c.inp", "*SYSTEM\n0, 0, 0, 1, 1, 0\n", "found *system, which makes or moves points");
  says("d.inp", "*INSTANCE, NAME=a, PART=b\n0.5, 0, 0\n", "where it was drawn");
  says("e.inp", "*NODE, INPUT=points.txt\n", "found data in another file");
  says("f.inp", "*ELSET, ELSET=a, GENERATE\n9223372036854775800, 9223372036854775807, 1\n",
       "expected `first, last, step`");
  says("g.inp", "*ELSET, ELSET=a, GENERATE\n-9223372036854775800, 5, 1\n",
       "expected `first, last, step`");
  says("h.inp", "*ELSET, ELSET=a\nb\n", "neither a number nor a set");
  says("a.vtu", "<VTKFile type=\"PolyData\">", "expected UnstructuredGrid");
}
