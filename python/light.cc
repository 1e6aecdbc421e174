// SPDX-License-Identifier: MIT
// Cells, sheets and up-sampling for Python. Refusals are ValueError with the text of the program,
// what does not converge is homespun.NotConverged; the interpreter runs on while this computes.
#include "python/light.h"

#include "localization/upsampler.h"
#include "meshes/files/cell_file.h"
#include "meshes/files/format_version.h"
#include "python/arrays.h"

#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>

namespace homespun::python
{
namespace
{
namespace fs = std::filesystem;
using meshes::HomogenizedCell;
using Upsampler = localization::Upsampler<3, float>;
using Fine      = Upsampler::Fine;

/// A sheet of cells and the coarse mesh over it: two triangles per cell.
struct CellSheet
{
  CellSheet(const HomogenizedCell &cell, const int n1, const int n2)
      : fine(meshes::tile(cell.mesh, cell.lattice, n1, n2))
      , coarse(meshes::coarse_sheet(fine.origin, cell.lattice.vectors, n1, n2))
  {
  }

  meshes::Sheet fine;
  meshes::TriangleMesh coarse;
};

std::unique_ptr<Upsampler> make_upsampler(const HomogenizedCell &cell, const CellSheet &sheet,
                                          const bool microscopic)
{
  localization::UpsamplerOptions options;
  options.microscopic = microscopic;
  return std::make_unique<Upsampler>(cell, sheet.coarse, sheet.fine, options);
}

py::object upsampled(const Upsampler &upsampler, const py::object &positions, py::object out)
{
  if (out.is_none())
    out = py::array_t<float>({static_cast<py::ssize_t>(upsampler.n_fine()), py::ssize_t(3)});
  const Taken<localization::Positions<3>> coarse(positions, "positions");
  const auto fine = room_in<Fine>(out, "out");
  {
    const py::gil_scoped_release others_run;
    upsampler.upsample(*coarse, fine);
  }
  return out;
}

void declare_cell(py::module_ &module)
{
  py::class_<HomogenizedCell>(module, "Cell",
                              "A homogenized unit cell, as `homespun homogenize` leaves it in "
                              "cell.h5. Voigt order 11, 22, 12 with engineering shear; SI units.")
    .def_static(
      "read", [](const fs::path &file) { return meshes::read_cell(file); }, py::arg("file"),
      py::call_guard<py::gil_scoped_release>(), "The cell of a file cell.h5.")
    .def(
      "write",
      [](const HomogenizedCell &cell, const fs::path &file) { meshes::write_cell(cell, file); },
      py::arg("file"), py::call_guard<py::gil_scoped_release>(),
      "Writes a file that Cell.read() reads.")
    .def_property_readonly(
      "vertices",
      [](const py::object &self)
      { return view(self.cast<const HomogenizedCell &>().mesh.vertices, self); },
      "(n, 2) [m], not copied")
    .def_property_readonly(
      "triangles",
      [](const py::object &self)
      { return view(self.cast<const HomogenizedCell &>().mesh.triangles, self); },
      "(m, 3), not copied")
    .def_property_readonly(
      "material",
      [](const py::object &self)
      { return view(self.cast<const HomogenizedCell &>().mesh.material, self); },
      "(m) phase of each triangle, not copied")
    .def_property_readonly(
      "chi",
      [](const py::object &self) { return view(self.cast<const HomogenizedCell &>().chi, self); },
      "(n, 6) characteristic displacements [m], columns chi_11, chi_22, chi_12 "
      "with two components each, not copied")
    .def_property_readonly(
      "stiffness", [](const HomogenizedCell &cell) { return copy_of(cell.stiffness); },
      "C^H (3, 3) [N/m]")
    .def_property_readonly(
      "bending_stiffness",
      [](const HomogenizedCell &cell) -> py::object
      {
        if (!cell.bending)
          return py::none();
        return copy_of(cell.bending->stiffness);
      },
      "D^H (3, 3) [N m], None where the file has none")
    .def_property_readonly(
      "lattice", [](const HomogenizedCell &cell) { return copy_of(cell.lattice.vectors); },
      "rows a1, a2 [m]")
    .def_readonly("anchor", &HomogenizedCell::anchor, "vertex where chi is zero")
    .def_readonly("areal_density", &HomogenizedCell::areal_density, "[kg/m^2]")
    .def_readonly("provenance", &HomogenizedCell::provenance)
    .def_readonly("place_of_cut", &HomogenizedCell::place_of_cut,
                  "In words, where the cell is not cut from the cloth as it is drawn; else empty.");
}

void declare_sheet(py::module_ &module)
{
  const auto field = [](auto member)
  {
    return [member](const py::object &self)
    { return view(member(self.cast<const CellSheet &>()), self); };
  };
  py::class_<CellSheet>(module, "Sheet",
                        "n1 x n2 cells side by side, flat, and the coarse mesh over them: two "
                        "triangles per cell.")
    .def(py::init<const HomogenizedCell &, int, int>(), py::arg("cell"), py::arg("n1"),
         py::arg("n2"), py::call_guard<py::gil_scoped_release>())
    .def_property_readonly("vertices",
                           field([](const CellSheet &sheet) -> const meshes::Points &
                                 { return sheet.fine.mesh.vertices; }),
                           "(n, 2) of the fine mesh [m], not copied")
    .def_property_readonly("triangles",
                           field([](const CellSheet &sheet) -> const meshes::Triangles &
                                 { return sheet.fine.mesh.triangles; }),
                           "(m, 3) of the fine mesh, not copied")
    .def_property_readonly("material",
                           field([](const CellSheet &sheet) -> const Eigen::VectorXi &
                                 { return sheet.fine.mesh.material; }),
                           "(m) phase of each fine triangle, not copied")
    .def_property_readonly(
      "coarse_vertices",
      field([](const CellSheet &sheet) -> const meshes::Points & { return sheet.coarse.vertices; }),
      "(k, 2) [m], not copied")
    .def_property_readonly("coarse_triangles",
                           field([](const CellSheet &sheet) -> const meshes::Triangles &
                                 { return sheet.coarse.triangles; }),
                           "(l, 3), not copied");
}
} // namespace

PYBIND11_MODULE(_light, module)
{
  module.doc() = "Cells, cloths and up-sampling; see the package homespun.";
  py::register_exception<meshes::BadInput>(module, "BadInput", PyExc_ValueError);
  py::register_exception<meshes::NotConverged>(module, "NotConverged", PyExc_RuntimeError);
  const char *const why_not = "Why a file of this format_version is not read; empty where it is.";
  module.def("fault_of_format",
             py::overload_cast<const std::string &, int>(&meshes::fault_of_format), py::arg("path"),
             py::arg("found"), why_not);
  module.def("fault_of_format",
             py::overload_cast<const std::string &, const std::string &>(&meshes::fault_of_format),
             py::arg("path"), py::arg("found"), why_not);
  declare_cell(module);
  declare_sheet(module);
  declare_cloth(module);
  py::class_<Upsampler>(module, "Upsampler",
                        "Fine positions from coarse positions (paper Eqs. 9-12): what runs every "
                        "frame. One thread at a time.")
    .def(py::init(&make_upsampler), py::arg("cell"), py::arg("sheet"),
         py::arg("microscopic") = true, py::call_guard<py::gil_scoped_release>(),
         "microscopic=False interpolates the coarse motion alone.")
    .def_property_readonly("n_fine", &Upsampler::n_fine)
    .def_property_readonly("n_coarse", &Upsampler::n_coarse)
    .def("upsample", &upsampled, py::arg("positions"), py::arg("out") = py::none(),
         "Fine positions (n_fine, 3) float32 of the coarse positions (n_coarse, 3) float64 [m]. "
         "Neither is copied; with `out` nothing is allocated.");
}
} // namespace homespun::python
