// SPDX-License-Identifier: MIT
#include "homogenization/cell_mesh_file.h"

#include "meshes/errors.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/tria.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace homespun::homogenization
{
namespace
{
/// Names of the two-dimensional physical groups, from the section $PhysicalNames of a .msh file.
std::map<std::string, int> physical_names(const std::string &file)
{
  std::map<std::string, int> number_of_name;
  std::ifstream input(file);
  std::string line;
  while (std::getline(input, line))
    if (line.rfind("$PhysicalNames", 0) == 0)
    {
      int count = 0;
      input >> count;
      for (int k = 0; k < count && input; ++k)
      {
        int dimension = 0, number = 0;
        input >> dimension >> number;
        std::getline(input, line);
        const std::size_t first = line.find('"'), last = line.rfind('"');
        if (input && dimension == 2 && first != std::string::npos && last > first)
          number_of_name[line.substr(first + 1, last - first - 1)] = number;
      }
      break;
    }
    else if (line.rfind("$Nodes", 0) == 0)
      break;
  return number_of_name;
}
} // namespace

std::string reason_of(const std::exception &exception)
{
  std::istringstream text(exception.what());
  std::string line, reason;
  bool inside = false;
  while (std::getline(text, line))
  {
    if (line.find("Additional information") != std::string::npos)
      inside = true;
    else if (inside &&
             (line.empty() || line.find("Stacktrace") != std::string::npos || line[0] == '-'))
      break;
    else if (inside)
      reason += (reason.empty() ? "" : " ") + line.substr(line.find_first_not_of(' '));
  }
  return reason.empty() ? "no reason given" : reason;
}

CellMeshFile read_cell_mesh(const std::string &file)
{
  if (!std::filesystem::is_regular_file(file))
    throw meshes::BadInput(file +
                           ": no such file; expected a mesh: mend the key `Mesh`, whose path is "
                           "relative to the .prm file");
  CellMeshFile result;
  dealii::Triangulation<2> triangulation;
  try
  {
    dealii::GridIn<2> reader(triangulation);
    reader.read(file);
  }
  catch (const std::exception &exception)
  {
    throw meshes::BadInput(
      file + ": cannot be read as a mesh: " + reason_of(exception) +
      "; expected a whole file of a format that deal.II's GridIn reads (Gmsh .msh 2 or "
      "4, .vtk, .vtu, .inp, .ucd, .unv) with triangles or quadrilaterals: write it again");
  }
  if (triangulation.n_active_cells() == 0)
    throw meshes::BadInput(
      file + ": holds no triangles or quadrilaterals; expected the cell's mesh: in Gmsh, "
             "add a Physical Surface and mesh with -2");

  const auto &points         = triangulation.get_vertices();
  meshes::TriangleMesh &mesh = result.mesh;
  mesh.vertices.resize(static_cast<Eigen::Index>(points.size()), 2);
  for (std::size_t v = 0; v < points.size(); ++v)
    mesh.vertices.row(static_cast<Eigen::Index>(v)) << points[v][0], points[v][1];
  int n_triangles = 0;
  for (const auto &cell : triangulation.active_cell_iterators())
    n_triangles += cell->n_vertices() == 3 ? 1 : 2;
  mesh.triangles.resize(n_triangles, 3);
  mesh.material.resize(n_triangles);
  int t = 0;
  const auto add =
    [&](const auto &cell, const unsigned int a, const unsigned int b, const unsigned int c)
  {
    mesh.material(t) = static_cast<int>(cell->material_id());
    mesh.triangles.row(t++) << static_cast<int>(cell->vertex_index(a)),
      static_cast<int>(cell->vertex_index(b)), static_cast<int>(cell->vertex_index(c));
  };
  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->n_vertices() == 3)
      add(cell, 0, 1, 2);
    else // deal.II numbers a quadrilateral lexicographically
    {
      add(cell, 0, 1, 3);
      add(cell, 0, 3, 2);
    }
  result.number_of_name = physical_names(file);
  return result;
}
} // namespace homespun::homogenization
