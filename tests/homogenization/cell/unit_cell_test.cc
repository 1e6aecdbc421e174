// SPDX-License-Identifier: MIT
// Every way to hand in a broken cell, and the message that answers it.
#include "homogenization/cell/unit_cell.h"
#include "homogenization/lint/cell_reading.h"
#include "meshes/plain/errors.h"
#include "tests/content_of.h"
#include "tests/meshes/plain/shapes.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>

using namespace homespun;
using namespace homespun::homogenization;
using tests::content_of;

namespace
{

/// The mesh as a .msh 2.2 file; material numbers are written as physical tags, named soft and hard.
std::string msh(const meshes::TriangleMesh &mesh)
{
  std::ostringstream text;
  text.precision(17);
  text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
       << "$PhysicalNames\n2\n2 1 \"soft\"\n2 2 \"hard\"\n$EndPhysicalNames\n"
       << "$Nodes\n"
       << mesh.n_vertices() << "\n";
  for (int v = 0; v < mesh.n_vertices(); ++v)
    text << v + 1 << " " << mesh.vertices.row(v) << " 0\n";
  text << "$EndNodes\n$Elements\n" << mesh.n_triangles() << "\n";
  for (int t = 0; t < mesh.n_triangles(); ++t)
    text << t + 1 << " 2 2 " << mesh.material(t) + 1 << " " << mesh.material(t) + 1 << " "
         << mesh.triangles.row(t).array() + 1 << "\n";
  text << "$EndElements\n";
  return text.str();
}

const std::string keys = "set Mesh = cell.msh\nset Length unit = 0.01\n"
                         "set Young's modulus = soft: 1e6, hard: 1e7\n"
                         "set Poisson's ratio = soft: 0.3, hard: 0.3\n"
                         "set Thickness = soft: 5e-4, hard: 5e-4\n"
                         "set Density = soft: 400, hard: 400\n";

meshes::TriangleMesh stripes()
{
  meshes::TriangleMesh mesh = tests::parallelogram(tests::square_lattice(1.), 4, 4);
  mesh.material.tail(16).setOnes();
  return mesh;
}

std::string replaced(std::string text, const std::string &from, const std::string &to)
{
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

class CellFolder
{
public:
  CellFolder()
      : path(
          std::filesystem::temp_directory_path() /
          ("homespun-cells-" + std::to_string(std::hash<std::string>()(
                                 testing::UnitTest::GetInstance()->current_test_info()->name()))))
  {
    std::filesystem::create_directories(path);
  }
  ~CellFolder()
  {
    std::filesystem::remove_all(path);
  }

  UnitCell read(const std::string &prm, const std::string &mesh) const
  {
    std::ofstream(path / "cell.prm") << prm;
    std::ofstream(path / "cell.msh") << mesh;
    return read_unit_cell((path / "cell.prm").string());
  }

  /// The faults, joined by newlines; empty where the cell is read.
  std::string refusal(const std::string &prm, const std::string &mesh) const
  {
    try
    {
      read(prm, mesh);
      return "";
    }
    catch (const meshes::BadInput &bad)
    {
      return bad.what();
    }
  }

  const std::filesystem::path path;
};

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)
} // namespace

TEST(exact_unit_cell, the_shipped_cells_are_sound)
{
  for (const char *name : {"layered", "three-stiffness"})
  {
    const UnitCell cell = read_unit_cell(std::string(CELLS) + name + ".prm");
    EXPECT_NEAR(cell.mesh.n_triangles(), 720, 36) << name;
    EXPECT_NEAR(cell.lattice.area(), 1e-4, 1e-14) << name;
    EXPECT_NEAR(meshes::signed_areas(cell.mesh).sum(), 1e-4, 1e-14) << name;
    // Soft first, as the groups are numbered.
    EXPECT_EQ(cell.phases[0].E1, 1e6) << name;
  }
  EXPECT_NEAR(read_unit_cell(std::string(CELLS) + "layered.prm").areal_density(), 0.2, 1e-14);
}

TEST(exact_unit_cell, names_numbers_orthotropy_and_lattices_are_understood)
{
  const CellFolder folder;
  const UnitCell by_name = folder.read(keys, msh(stripes()));
  EXPECT_EQ(by_name.phases[1].name, "hard");
  EXPECT_EQ(by_name.phases[1].E1, 1e7);
  EXPECT_NEAR(by_name.lattice.vectors(0, 0), 0.01, 1e-16);

  const std::string numbered = replaced(replaced(keys, "soft: 1e6, hard: 1e7", "1: 1e6, 2: 1e7"),
                                        "Thickness = soft", "Thickness = 1");
  EXPECT_EQ(folder.read(numbered, msh(stripes())).phases[1].E1, 1e7);

  std::string yarn = replaced(replaced(keys, ", hard: 1e7", ""), "0.3, hard: 0.3", "0.3");
  yarn += "set Orthotropic = hard: 1e7 1e6 0.3 4e5 45\nset Lattice vectors = 1 0; 0 1\n";
  const Phase phase = folder.read(yarn, msh(stripes())).phases[1];
  EXPECT_EQ(phase.E2, 1e6);
  EXPECT_EQ(phase.angle, 45.);
}

TEST(exact_unit_cell, obj_has_the_phases_of_its_materials_and_is_told_to_have_them)
{
  const CellFolder folder;
  const std::string its_keys = replaced(keys, "cell.msh", "cell.obj");
  const auto obj             = [&](const std::string &soft, const std::string &hard)
  {
    std::ofstream(folder.path / "cell.obj")
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 2 0\nv 1 2 0\n"
      << soft << "f 1 2 4 3\n"
      << hard << "f 3 4 6 5\n";
  };
  obj("usemtl soft\n", "usemtl hard\n");
  EXPECT_EQ(folder.read(its_keys, "").phases[1].E1, 1e7);
  obj("", "");
  EXPECT_SAYS(folder.refusal(its_keys, ""), "expected one per material: `usemtl ground`");
}

TEST(exact_unit_cell, a_set_of_all_triangles_gives_its_values_to_all_groups)
{
  const CellFolder folder;
  const std::string mesh = replaced(msh(stripes()), "Names\n2\n", "Names\n3\n2 0 \"all\"\n");
  const UnitCell cell =
    folder.read(replaced(keys, "Thickness = soft: 5e-4", "Thickness = all: 4e-4"), mesh);
  EXPECT_EQ(cell.phases[0].thickness, 4e-4);
  EXPECT_EQ(cell.phases[1].thickness, 5e-4);
  EXPECT_SAYS(folder.refusal(replaced(keys, "Thickness = ", "Thickness = 1e-4, all: 4e-4, "), mesh),
              "key `Thickness`: all groups are given a value twice, once by `all`");
  EXPECT_SAYS(folder.refusal(keys + "set Layers = all: 1e-4 1e6 0.3\n", mesh),
              "names the group `all`, which no triangle of the mesh has");
}

TEST(exact_unit_cell, layers_take_the_place_of_moduli_and_thickness)
{
  const CellFolder folder;
  std::string film        = replaced(keys, ", hard: 1e7", "");
  film                    = replaced(film, "0.3, hard: 0.3", "0.3");
  const std::size_t begin = film.find("set Thickness");
  film.replace(begin, film.find('\n', begin) - begin, "set Thickness = soft: 6e-4");
  const auto with = [&](const std::string &layers)
  { return film + "set Layers = " + layers + "\n"; };
  const Phase phase =
    folder.read(with("hard: 6e-4 1e6 0.3, 4e-4 1.4e7 0.4"), msh(stripes())).phases[1];
  const Phase expected = layered("hard", {{6e-4, 1e6, 0.3}, {4e-4, 1.4e7, 0.4}}, phase.density);
  EXPECT_EQ(bending_stiffness(phase), bending_stiffness(expected));
  EXPECT_EQ(plane_stress_stiffness(phase), plane_stress_stiffness(expected));
  const auto refused = [&](const std::string &layers, const char *const part)
  {
    const std::string text = folder.refusal(with(layers), msh(stripes()));
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  refused("hard: 6e-4 1e6",
          "key `Layers`: found `hard: 6e-4 1e6`; expected `group: thickness E nu");
  refused("6e-4 1e6 0.3", "key `Layers`: found `6e-4 1e6 0.3`");
  refused("hard: 6e-4 1e6 0.3, 1e-4 1e7 0.3, hard: 6e-4 1e6 0.3",
          "key `Layers`: group `hard` is given twice");
  refused("hard: 6e-4 1e6 0.3, 4e-4 -1.4e7 0.4", "phase `hard`, layer `2` has Young's modulus");
  refused("hart: 6e-4 1e6 0.3", "key `Layers` names the group `hart`");
  refused("hard: 6e-4 1e6 0.3, soft: 6e-4 1e6 0.3",
          "group `soft` is given both in `Layers` and in `Young's modulus`");
}

TEST(exact_unit_cell, poissons_ratio_of_one_half_is_fine)
{
  EXPECT_EQ(CellFolder().refusal(replaced(keys, "soft: 0.3", "soft: 0.5"), msh(stripes())), "");
}

TEST(tripwire_unit_cell, a_mesh_outside_of_the_folder_of_its_cell_is_refused)
{
  const CellFolder folder;
  std::ofstream(folder.path / "other.msh") << msh(stripes());
  std::filesystem::create_directories(folder.path / "inside");
  std::ofstream(folder.path / "inside" / "cell.prm") << replaced(keys, "cell.msh", "../other.msh");
  std::ofstream(folder.path / "inside" / "linked.prm") << replaced(keys, "cell.msh", "link.msh");
  std::filesystem::create_symlink("../other.msh", folder.path / "inside" / "link.msh");
  for (const char *const name : {"inside/cell.prm", "inside/linked.prm"})
    try
    {
      read_unit_cell((folder.path / name).string());
      ADD_FAILURE() << name << " was read";
    }
    catch (const meshes::BadInput &bad)
    {
      EXPECT_SAYS(std::string(bad.what()), "outside of the folder");
    }
  EXPECT_SAYS(folder.refusal(replaced(keys, "cell.msh", "/etc/passwd"), ""),
              "outside of the folder");
  // Below is inside.
  std::filesystem::create_directories(folder.path / "meshes");
  std::ofstream(folder.path / "meshes" / "below.msh") << msh(stripes());
  EXPECT_EQ(folder.refusal(replaced(keys, "cell.msh", "meshes/below.msh"), ""), "");
}

TEST(tripwire_unit_cell, missing_files_are_named)
{
  const CellFolder folder;
  try
  {
    read_unit_cell("nowhere/cell.prm");
    FAIL();
  }
  catch (const meshes::BadInput &bad)
  {
    EXPECT_SAYS(std::string(bad.what()), "nowhere/cell.prm: no such file");
  }
  EXPECT_SAYS(folder.refusal(replaced(keys, "cell.msh", "other.msh"), ""),
              "other.msh: no such file");
}

TEST(tripwire_unit_cell, all_faults_of_keys_and_groups_are_told_at_once)
{
  const CellFolder folder;
  const std::string unknown_keys =
    folder.refusal(keys + "set Yong's modulus = soft: 1\nthickness 3\n", msh(stripes()));
  EXPECT_SAYS(unknown_keys, "cell.prm:7: unknown key `Yong's modulus`");
  EXPECT_SAYS(unknown_keys, "cell.prm:8: found `thickness 3`; expected `set KEY = VALUE`");

  std::string prm = replaced(keys, "Young's modulus = soft: 1e6, hard: 1e7",
                             "Young's modulus = soft: -1, hrad: 1e7");
  prm             = replaced(prm, "ratio = soft: 0.3, hard: 0.3", "ratio = soft: 1.0, hard: x");
  const std::string faults = folder.refusal(prm, msh(stripes()));
  EXPECT_SAYS(faults, "names the group `hrad`, which no triangle of the mesh has; expected one of "
                      "`soft`, `hard`");
  EXPECT_SAYS(faults, "group `hard` of the mesh has no value in key `Young's modulus`");
  EXPECT_SAYS(faults, "found `hard: x`; expected `group: value`");
  EXPECT_SAYS(faults, "`soft` has Young's modulus -1 Pa");
}

TEST(tripwire_unit_cell, poissons_ratio_out_of_range_is_refused)
{
  const CellFolder folder;
  for (const char *ratio : {"1", "-1", "1.5"})
    EXPECT_SAYS(
      folder.refusal(replaced(keys, "soft: 0.3", std::string("soft: ") + ratio), msh(stripes())),
      "has Poisson's ratio");
}

TEST(tripwire_unit_cell, opposite_sides_that_do_not_match_are_named_with_the_remedy)
{
  meshes::TriangleMesh mesh = stripes();
  mesh.vertices(9, 1) += 0.01;
  const std::string faults = CellFolder().refusal(keys, msh(mesh));
  EXPECT_SAYS(faults, "has no periodic image; the nearest candidate is vertex");
  EXPECT_SAYS(faults, "off by 0.0001 m");
  EXPECT_SAYS(faults, "Periodic Curve");
}

TEST(tripwire_unit_cell, a_lattice_that_does_not_fit_is_refused)
{
  const CellFolder folder;
  EXPECT_SAYS(folder.refusal(keys + "set Lattice vectors = 1 0; 0 2\n", msh(stripes())),
              "expected equal areas: mend `Lattice vectors`");
  EXPECT_SAYS(folder.refusal(keys + "set Lattice vectors = 1 0; 2 0\n", msh(stripes())),
              "parallel or zero");
  EXPECT_SAYS(folder.refusal(keys + "set Lattice vectors = 1 0\n", msh(stripes())),
              "expected `auto` or two vectors");
}

TEST(exact_unit_cell, an_angle_per_triangle_turns_the_orthotropic_groups)
{
  const CellFolder folder;
  const std::string data = DATA;
  std::ofstream(folder.path / "cell.vtu")
    << content_of(data + "text.vtu"); // triangle t at 10 t degrees
  std::string prm     = replaced(keys, "cell.msh", "cell.vtu");
  prm                 = replaced(prm, "soft: 1e6, hard: 1e7", "7: 1e6");
  prm                 = replaced(prm, "soft: 0.3, hard: 0.3", "7: 0.3");
  prm                 = replaced(replaced(prm, "soft: 5e-4, hard: 5e-4", "7: 5e-4, 3: 5e-4"),
                                 "soft: 400, hard: 400", "7: 400, 3: 400");
  const UnitCell cell = folder.read(prm + "set Orthotropic = 3: 1e7 1e6 0.3 4e5 15\n", "");
  const std::vector<Eigen::Matrix3d> stiffness = cell.stiffness_of_phase();
  const std::vector<int> group                 = cell.group_of_phase();
  const Phase soft                             = isotropic("7", 1e6, 0.3, 5e-4, 400.);
  int n_turned                                 = 0;
  for (int t = 0; t < 16; ++t)
  {
    const auto phase = static_cast<std::size_t>(cell.mesh.material(t));
    Phase expected   = soft;
    if (cell.phases[phase].name == "3")
    {
      expected = {"3", 1e7, 1e6, 0.3, 4e5, 15. + 10. * t, 5e-4, 400.};
      ++n_turned;
    }
    EXPECT_LT((stiffness[phase] - plane_stress_stiffness(expected)).norm(), 1e-12 * 1e7) << t;
    EXPECT_EQ(group[phase], group[static_cast<std::size_t>(
                              cell.phase_of_group()[static_cast<std::size_t>(group[phase])])]);
  }
  EXPECT_EQ(n_turned, 8);
  EXPECT_EQ(cell.phases.size(), 9u);
  EXPECT_EQ(cell.phase_of_group().size(), 2u);
  EXPECT_SAYS(
    folder.refusal(replaced(replaced(prm, "7: 1e6", "7: 1e6, 3: 1e6"), "7: 0.3", "7: 0.3, 3: 0.3"),
                   ""),
    "has cell data `angle`, and no group is in key `Orthotropic`");
  std::ofstream(folder.path / "cell.vtu")
    << replaced(content_of(data + "text.vtu"), "60 70 80 90 100 110", "nan nan nan nan nan nan");
  EXPECT_SAYS(
    folder.refusal(prm + "set Orthotropic = 3: 1e7 1e6 0.3 4e5 15, 7: 1e6 1e6 0.3 4e5 0\n", ""),
    "angle");
}

TEST(tripwire_unit_cell, inverted_and_overlapping_triangles_are_refused)
{
  const CellFolder folder;
  meshes::TriangleMesh folded = stripes();
  folded.vertices.row(12) += Eigen::RowVector2d(0.6, 0.); // an inner vertex beyond its neighbours
  EXPECT_NE(folder.refusal(keys, msh(folded)), "");

  meshes::TriangleMesh twice = stripes();
  const int m                = twice.n_triangles();
  twice.triangles.conservativeResize(m + 1, 3);
  twice.triangles.row(m) = twice.triangles.row(9);
  twice.material.conservativeResize(m + 1);
  twice.material(m) = 0;
  EXPECT_NE(folder.refusal(keys, msh(twice)), "");
}

TEST(tripwire_unit_cell, a_mesh_cut_off_anywhere_is_refused_by_name)
{
  const CellFolder folder;
  const std::string whole = msh(stripes());
  for (const double part : {0., 0.1, 0.3, 0.5, 0.7, 0.9})
    EXPECT_SAYS(folder.refusal(keys, whole.substr(0, static_cast<std::size_t>(
                                                       part * static_cast<double>(whole.size())))),
                "cell.msh");
  const std::string shipped = content_of(std::string(CELLS) + "layered.msh");
  for (const double part : {0.2, 0.5, 0.8, 0.97})
    EXPECT_SAYS(
      folder.refusal(keys, shipped.substr(0, static_cast<std::size_t>(
                                               part * static_cast<double>(shipped.size())))),
      "cell.msh");
}
