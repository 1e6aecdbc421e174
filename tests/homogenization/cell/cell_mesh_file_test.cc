// SPDX-License-Identifier: MIT
// One cell in every format: what Gmsh and VTK wrote of data/halves.geo holds the same areas by
// group, and the same vertices, triangles, groups and angles where the format keeps their order.
#include "homogenization/cell/cell_mesh_file.h"
#include "meshes/plain/drawn_lattice.h"
#include "meshes/plain/lattice.h"
#include "tests/content_of.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

using namespace homespun;
using namespace homespun::homogenization;
using tests::content_of;

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
  EXPECT_NEAR(meshes::frames_of(file.mesh, 1e-9).at(0).lattice.area(), 1., 1e-12) << name;
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
  for (const char *name :
       {"version-5.vtk", "binary.vtk", "text.vtu", "base64.vtu", "base64-zlib.vtu",
        "appended-raw.vtu", "appended-raw-zlib.vtu", "appended-base64.vtu"})
  {
    expect_halves(name, 7, 3);
    const CellMeshFile file = read_cell_mesh(data + name);
    ASSERT_EQ(file.angle.size(), 16) << name;
    for (int t = 0; t < 16; ++t)
      EXPECT_EQ(file.angle(t), 10. * t) << name;
  }
}

TEST(exact_cell_mesh_file, a_converted_mesh_keeps_its_vertices_and_triangles_in_their_order)
{
  const CellMeshFile ours = read_cell_mesh(data + "halves-msh41.msh");
  // Gmsh gave the points the same numbers in both.
  const CellMeshFile unv = read_cell_mesh(data + "halves.unv");
  EXPECT_EQ(unv.mesh.material, ours.mesh.material);
  EXPECT_EQ(unv.number_of_name, ours.number_of_name);
  // In .msh they have 16 digits.
  EXPECT_LT((unv.mesh.vertices - ours.mesh.vertices).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(unv.mesh.triangles, ours.mesh.triangles);
  // Gmsh writes fewer digits to Abaqus' decks.
  EXPECT_EQ(read_cell_mesh(data + "halves-abaqus.inp").mesh.triangles, ours.mesh.triangles);
  const CellMeshFile vtk = read_cell_mesh(data + "binary.vtk");
  for (const char *name : {"base64.vtu", "appended-raw-zlib.vtu"})
  {
    const CellMeshFile vtu = read_cell_mesh(data + name);
    EXPECT_EQ(vtu.mesh.triangles, vtk.mesh.triangles) << name;
    EXPECT_EQ(vtu.mesh.material, vtk.mesh.material) << name;
    EXPECT_EQ(vtu.angle, vtk.angle) << name;
  }
}

TEST(exact_cell_mesh_file, msh_gives_angles_as_element_data)
{
  const Folder folder;
  std::ostringstream block;
  block << "$ElementData\n1\n\"angle\"\n1\n0.0\n3\n0\n1\n16\n";
  for (int t = 16; t >= 1; --t) // in any order
    block << t << " " << 10 * t << "\n";
  block << "$EndElementData\n";
  for (const char *name : {"halves-msh22.msh", "halves-msh40.msh", "halves-msh41.msh"})
  {
    const std::string whole = content_of(data + name);
    // The elements of halves.geo are numbered from 1 on in their order.
    const CellMeshFile file = read_cell_mesh(folder.file(name, whole + block.str()));
    ASSERT_EQ(file.angle.size(), 16) << name;
    for (int t = 0; t < 16; ++t)
      EXPECT_EQ(file.angle(t), 10. * (t + 1)) << name;
    std::string other = block.str();
    other.replace(other.find("angle"), 5, "speed");
    EXPECT_EQ(read_cell_mesh(folder.file("other.msh", whole + other)).angle.size(), 0);
    const auto refused = [&](const std::string &from, const std::string &to)
    {
      std::string changed = block.str();
      changed.replace(changed.find(from), from.size(), to);
      return tests::refusal([&]() { read_cell_mesh(folder.file("changed.msh", whole + changed)); });
    };
    EXPECT_NE(refused("\n7 70", "\n99 70").find("element 7 has no value"), std::string::npos);
    EXPECT_NE(refused("\n7 70", "\n8 70").find("element 8 has two values"), std::string::npos);
    EXPECT_NE(refused("\n0\n1\n16", "\n0\n3\n16").find("3 components"), std::string::npos);
    EXPECT_NE(refused("70", "x").find("expected an angle"), std::string::npos);
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
              head + "*ELSET, ELSET=hard\nSurface2\n*ELSET, ELSET=soft\nSURFACE1\n");
  expect_same("continued.inp",
              head + "*ELSET,\nELSET=hard, GENERATE\n9, 16\n*ELSET, ELSET=soft, GENERATE\n1, 8\n");
}

TEST(exact_cell_mesh_file, an_abaqus_set_of_all_elements_leaves_them_in_the_sets_that_it_is_made_of)
{
  const Folder folder;
  const std::string whole = content_of(data + "halves-abaqus.inp");
  const std::string head  = whole.substr(0, whole.find("*ELSET,ELSET=hard"));
  std::string own         = head;
  for (const auto &[from, to] : {std::pair("Surface1", "soft"), {"Surface2", "hard"}})
    own.replace(own.find(from), 8, to);
  for (const std::string &sets :
       {whole + "\n*ELSET, ELSET=all\nhard, soft\n",
        whole + "\n*ELSET, ELSET=all, GENERATE\n1, 16\n", own + "*ELSET, ELSET=all\nsoft, hard\n"})
  {
    const CellMeshFile file = read_cell_mesh(folder.file("cell.inp", sets));
    EXPECT_NEAR(area_of(file, file.number_of_name.at("soft")), 0.375, 1e-9) << sets;
    EXPECT_NEAR(area_of(file, file.number_of_name.at("hard")), 0.625, 1e-9) << sets;
    EXPECT_EQ(file.number_of_name.at("all"), 0);
  }
  // The sets of *ELEMENT count only where another set names them: Gmsh calls them Surface1, ...
  const CellMeshFile file =
    read_cell_mesh(folder.file("cell.inp", head + "*ELSET, ELSET=cloth, GENERATE\n1, 16\n"));
  EXPECT_NEAR(area_of(file, file.number_of_name.at("cloth")), 1., 1e-9);
}

TEST(exact_cell_mesh_file, obj_has_the_groups_of_its_materials_or_else_those_of_its_groups)
{
  const Folder folder;
  const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n";
  const std::string left = "f 1/1 2/1 3/1\nf 1 3 4\n", right = "f 2 5 6 3\n", vt = "vt 0 0\n";
  for (const std::string &content :
       {"g soft\n" + left + "g hard yarn\n" + right,
        "usemtl soft\n" + left + "usemtl hard yarn\n" + right,
        "usemtl soft\ng a\n" + left + "g b\nusemtl hard yarn\n" + right})
  {
    const CellMeshFile file = read_cell_mesh(folder.file("cell.obj", points + vt + content));
    EXPECT_EQ(file.number_of_name.size(), 2u) << content;
    EXPECT_EQ(area_of(file, file.number_of_name.at("soft")), 1.) << content;
    EXPECT_EQ(area_of(file, file.number_of_name.at("hard yarn")), 1.) << content;
  }
  const CellMeshFile file = read_cell_mesh(folder.file("cell.obj", points + vt + left + right));
  EXPECT_EQ(area_of(file, 0), 2.);
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
  const auto expect_refused = [&](const std::string &name, const std::size_t step)
  {
    const std::string whole  = content_of(data + name);
    const std::string ending = std::filesystem::path(name).extension().string();
    int refused = 0, tried = 0;
    for (std::size_t length = 0; length < whole.size(); length += step, ++tried)
    {
      const std::string path = folder.file("cut" + ending, whole.substr(0, length));
      // Nothing but BadInput leaves; its message names the file.
      const std::string message = tests::refusal([&]() { read_cell_mesh(path); });
      refused += message.empty() ? 0 : 1;
      EXPECT_TRUE(message.empty() || message.find("cut" + ending) != std::string::npos) << message;
    }
    EXPECT_GT(refused, tried / 2) << name;
  };
  for (const char *name : {"halves-msh22.msh", "halves-msh40.msh", "halves-msh41.msh"})
    expect_refused(name, 37);
  // Python is begun for each of these.
  for (const char *name :
       {"halves.vtk", "binary.vtk", "appended-raw-zlib.vtu", "halves.unv", "halves-abaqus.inp"})
    expect_refused(name, content_of(data + name).size() / 5);
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
    EXPECT_NE(message.find(name), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  };
  says("a.msh", "$MeshFormat\n4.1 1 8\n", "binary .msh; expected text");
  says("b.msh", "$MeshFormat\n3.0 0 8\n$EndMeshFormat\n", "expected 2, 4.0 or 4.1");
  says("c.msh",
       "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n0\n$EndNodes\n$Elements\n1\n1 10 2 0 0 1 2 3 "
       "4 5 6 7 8 9\n$EndElements\n",
       "-order 1");
  says("d.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n999999999\n",
       "at most what the rest of the file can hold");
  says("a.foo", "CDF", "its ending is `.foo`; expected .msh");
  const std::string points = "4 1 0 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n";
  says("a.ucd", points + "1 0 tet 1 2 3 4\n", "mesh the surface alone");
  says("b.ucd", points + "1 0 tri 1 2 9\n", "expected a whole mesh");
  says("c.ucd", points + "1 0 tri 1 2 4\n", "not flat: z reaches from 0 to 1");
  says("d.ucd", points + "1 -1 tri 1 2 3\n", "expected a whole number from 0 to 1e9");
  const std::string vtk =
    "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n"
    "0 0 0 1 0 0 0 1 0 .5 0 0 .5 .5 0 0 .5 0\n";
  says("a.vtk", vtk + "CELLS 1 4\n3 0 1 7\nCELL_TYPES 1\n5\n", "names point 7; expected 0 to 5");
  says("b.vtk", vtk + "CELLS 1 7\n6 0 1 2 3 4 5\nCELL_TYPES 1\n22\n", "are read from .msh alone");
  says("c.vtk", vtk + "CELLS 1 7\n6 0 1 2 3 4 5\nCELL_TYPES 1\n6\n", "mesh the surface alone");
  says("d.vtk",
       vtk + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\nCELL_DATA 1\nSCALARS phase int 1\n"
             "LOOKUP_TABLE default\n1\nSCALARS material int 1\nLOOKUP_TABLE default\n2\n",
       "`phase` and `material`, which differ");
  const std::string one_cell = vtk + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n";
  says("e.vtk", one_cell + "CELL_DATA 1\nVECTORS angle double\n1 2 3\n",
       "cell data `angle` with several components");
  says("f.vtk",
       one_cell + "POINT_DATA 6\nSCALARS angle double 1\nLOOKUP_TABLE default\n1 2 3 4 5 6\n",
       "found `angle` at the points");
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
  const std::string triangle = "*NODE\n1, 0, 0\n2, 1, 0\n3, 0, 1\n*ELEMENT, TYPE=S3\n1, 1, 2, ";
  says("i.inp", triangle + "3\n*ELSET, ELSET=a\n1\n*ELSET, ELSET=b\n1\n",
       "element 1 is in the sets `a` and `b`");
  says("j.inp", triangle + "4\n", "names point 4, which the file does not give");
  says("k.inp", triangle + "3\n*NODE\n1, 5, 5\n", "point 1 is given twice");
  std::string unv         = content_of(data + "halves.unv");
  const std::string seven = "         8         7         0";
  says("a.unv", unv.replace(unv.find(seven), seven.size(), "         8         9         0"),
       "in the sets `hard` and `soft`");
  says("a.vtu", "<VTKFile type=\"PolyData\">", "meshio cannot read as .vtu");
}
