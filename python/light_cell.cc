// SPDX-License-Identifier: MIT
// Homogenized cells for Python, and the brackets on their stiffness.
#include "meshes/files/cell_file.h"
#include "meshes/plain/homogenized_cell.h"
#include "python/arrays.h"
#include "python/bracketed_cell.h"
#include "python/light.h"
#include "python/one_at_a_time.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string>

namespace homespun::python
{
namespace
{
namespace fs = std::filesystem;
using meshes::HomogenizedCell;

std::string text_of(const HomogenizedCell &cell)
{
  const Eigen::Matrix3d &C = cell.stiffness;
  const int n_phases       = cell.mesh.material.maxCoeff() + 1;
  std::ostringstream text;
  text.precision(3);
  text << "<homespun.Cell " << 1e3 * cell.lattice.vectors.row(0).norm() << " x "
       << 1e3 * cell.lattice.vectors.row(1).norm() << " mm: " << cell.mesh.n_triangles()
       << " triangles, " << n_phases << (n_phases == 1 ? " phase" : " phases") << ", C11 "
       << C(0, 0) << ", C22 " << C(1, 1) << ", C12 " << C(0, 1) << ", C66 " << C(2, 2) << " N/m, ";
  if (cell.bending)
    text << "D11 " << cell.bending->stiffness(0, 0) << ", D22 " << cell.bending->stiffness(1, 1)
         << " N m, ";
  text << cell.areal_density << " kg/m^2>";
  return text.str();
}

void declare_bracket(py::module_ &module)
{
  using Bracket     = BracketOfStiffness;
  const auto matrix = [](Eigen::Matrix3d Bracket::*member)
  { return [member](const Bracket &bracket) { return copy_of(bracket.*member); }; };
  py::class_<Bracket>(module, "Bracket",
                      "A guaranteed bracket on C^H [N/m] or D^H [N m]: lower <= exact <= upper as "
                      "quadratic forms, Voigt order 11, 22, 12.")
    .def_property_readonly("lower", matrix(&Bracket::lower), "(3, 3) [N/m] or [N m]")
    .def_property_readonly("upper", matrix(&Bracket::upper), "(3, 3) [N/m] or [N m]")
    .def_property_readonly("centre", matrix(&Bracket::centre),
                           "(3, 3) [N/m] or [N m], half the sum of lower and upper")
    .def_property_readonly("half_width", matrix(&Bracket::half_width),
                           "(3, 3) [N/m] or [N m]: no entry of the exact stiffness is farther from "
                           "that of centre")
    .def_readonly("width", &Bracket::width,
                  "[-] by how much any energy can be wrong, relative: the largest "
                  "v.(upper - lower).v / v.upper.v")
    .def_readonly("is_of_drawing", &Bracket::is_of_drawing,
                  "Whether it holds for the curved outlines of a mesh of six-node triangles; Cell "
                  "has straight ones.")
    .def("__repr__",
         [](const Bracket &bracket)
         {
           std::ostringstream text;
           text.precision(3);
           text << "<homespun.Bracket: 11 " << bracket.centre(0, 0) << " +- "
                << bracket.half_width(0, 0) << ", 22 " << bracket.centre(1, 1) << " +- "
                << bracket.half_width(1, 1) << ", relative width " << bracket.width << ">";
           return text.str();
         });
}
} // namespace

void check_size(const HomogenizedCell &cell, const double n_cells, const long max_triangles)
{
  constexpr long that_have_numbers = std::numeric_limits<int>::max() / 3; // so have three corners
  if (max_triangles < 1 || max_triangles > that_have_numbers)
    throw meshes::BadInput("max_triangles: found " + std::to_string(max_triangles) +
                           "; expected 1 to " + std::to_string(that_have_numbers));
  const double n_triangles = n_cells * cell.mesh.n_triangles();
  if (n_triangles <= static_cast<double>(max_triangles))
    return;
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::digits10);
  text << "cells: " << std::round(n_cells) << " of " << cell.mesh.n_triangles()
       << " triangles would be a fine mesh of " << std::round(n_triangles)
       << "; expected at most max_triangles = " << max_triangles
       << ": take a larger cell or a smaller mesh (is it in metres?), or raise max_triangles";
  throw meshes::BadInput(text.str());
}

void declare_cell(py::module_ &module)
{
  using Cell       = HomogenizedCell;
  const auto field = [](auto member)
  {
    return [member](const py::object &self)
    { return view(member(self.cast<const Cell &>()), self); };
  };
  py::class_<Cell>(module, "Cell",
                   "A homogenized unit cell, as `homespun homogenize` leaves it in cell.h5. Voigt "
                   "order 11, 22, 12 with engineering shear; SI units.")
    .def_static(
      "read", [](const fs::path &file) { return meshes::read_cell(file); }, py::arg("file"),
      py::call_guard<OneAtATime>(),
      "The cell of a file cell.h5. Raises BadInput naming the file and what is wrong with it.")
    .def(
      "write", [](const Cell &cell, const fs::path &file) { meshes::write_cell(cell, file); },
      py::arg("file"), py::call_guard<OneAtATime>(),
      "Writes a file that Cell.read() reads, whole or not at all.")
    .def_property_readonly("vertices",
                           field([](const Cell &cell) -> auto & { return cell.mesh.vertices; }),
                           "(n, 2) float64 [m], not copied")
    .def_property_readonly("triangles",
                           field([](const Cell &cell) -> auto & { return cell.mesh.triangles; }),
                           "(m, 3) int32, not copied")
    .def_property_readonly("material",
                           field([](const Cell &cell) -> auto & { return cell.mesh.material; }),
                           "(m,) int32, phase of each triangle, not copied")
    .def_property_readonly("chi", field([](const Cell &cell) -> auto & { return cell.chi; }),
                           "(n, 6) float64 characteristic displacements [m] under unit macro "
                           "strain, columns chi_11, chi_22, chi_12 with two components each, not "
                           "copied: under the macro strain E a vertex moves by E.y - sum E_a chi_a")
    .def_property_readonly(
      "stiffness", [](const Cell &cell) { return copy_of(cell.stiffness); }, "C^H (3, 3) [N/m]")
    .def_property_readonly(
      "bending_stiffness",
      [](const Cell &cell) -> py::object
      {
        if (!cell.bending)
          return py::none();
        return copy_of(cell.bending->stiffness);
      },
      "D^H (3, 3) [N m], None where the file has none")
    .def_property_readonly(
      "lattice", [](const Cell &cell) { return copy_of(cell.lattice.vectors); },
      "(2, 2) [m], rows a1, a2")
    .def_readonly("anchor", &Cell::anchor, "Vertex where chi is zero.")
    .def_readonly("areal_density", &Cell::areal_density, "[kg/m^2]")
    .def_readonly("provenance", &Cell::provenance, "How it was made, one line.")
    .def_readonly("place_of_cut", &Cell::place_of_cut,
                  "In words, where the cell is not cut from the cloth as it is drawn; else empty.")
    .def("__repr__", &text_of);
  declare_bracket(module);
  py::class_<BracketedCell, Cell>(module, "BracketedCell",
                                  "A cell that homogenize() made, with the brackets that "
                                  "`homespun homogenize` gives.")
    .def_property_readonly(
      "stiffness_bracket", [](const BracketedCell &cell) { return cell.stiffness_bracket; },
      "Bracket on C^H [N/m]; None without bars, or where the mesh is too large for them")
    .def_property_readonly(
      "bending_bracket", [](const BracketedCell &cell) { return cell.bending_bracket; },
      "Bracket on D^H [N m]; None without bars, or where the mesh is too large for them");
}
} // namespace homespun::python
