// SPDX-License-Identifier: MIT
// Cells, sheets and up-sampling for Python. Refusals are ValueError with the text of the program,
// what does not converge is homespun.NotConverged; the interpreter runs on while this computes.
#include "python/light.h"

#include "localization/garment/placed_garment.h"
#include "localization/upsampler.h"
#include "meshes/files/format_version.h"
#include "python/arrays.h"
#include "python/laid_garment.h"

#include <memory>
#include <sstream>

namespace homespun::python
{
namespace
{
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

std::unique_ptr<CellSheet> make_sheet(const HomogenizedCell &cell, const int n1, const int n2,
                                      const long max_triangles)
{
  for (const auto &[name, number] : {std::pair("n1", n1), std::pair("n2", n2)})
    if (number < 1)
      throw meshes::BadInput(std::string(name) + ": found " + std::to_string(number) +
                             "; expected at least 1 cell");
  check_size(cell, static_cast<double>(n1) * n2, max_triangles);
  return std::make_unique<CellSheet>(cell, n1, n2);
}

std::unique_ptr<Upsampler> make_upsampler(const HomogenizedCell &cell, const CellSheet &sheet,
                                          const bool microscopic)
{
  localization::UpsamplerOptions options;
  options.microscopic = microscopic;
  return std::make_unique<Upsampler>(cell, sheet.coarse, sheet.fine, options);
}

std::unique_ptr<Upsampler> make_garment_upsampler(const HomogenizedCell &cell,
                                                  const LaidGarment &garment,
                                                  const bool microscopic)
{
  localization::UpsamplerOptions options;
  options.microscopic = microscopic;
  return std::make_unique<Upsampler>(
    localization::placed_garment(cell, garment.coarse, garment.fine, options));
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
    .def(
      py::init(&make_sheet), py::arg("cell"), py::arg("n1"), py::arg("n2"), py::kw_only(),
      py::arg("max_triangles") = most_triangles, py::call_guard<py::gil_scoped_release>(),
      "n1, n2: numbers of cells along the lattice vectors, at least 1. Raises BadInput where the "
      "cell is no parallelogram, or the fine mesh would have more than max_triangles.")
    .def_property_readonly("vertices",
                           field([](const CellSheet &sheet) -> const meshes::Points &
                                 { return sheet.fine.mesh.vertices; }),
                           "(n, 2) float64 of the fine mesh [m], not copied")
    .def_property_readonly("triangles",
                           field([](const CellSheet &sheet) -> const meshes::Triangles &
                                 { return sheet.fine.mesh.triangles; }),
                           "(m, 3) int32 of the fine mesh, not copied")
    .def_property_readonly("material",
                           field([](const CellSheet &sheet) -> const Eigen::VectorXi &
                                 { return sheet.fine.mesh.material; }),
                           "(m,) int32, phase of each fine triangle, not copied")
    .def_property_readonly(
      "coarse_vertices",
      field([](const CellSheet &sheet) -> const meshes::Points & { return sheet.coarse.vertices; }),
      "(k, 2) float64 [m], not copied")
    .def_property_readonly("coarse_triangles",
                           field([](const CellSheet &sheet) -> const meshes::Triangles &
                                 { return sheet.coarse.triangles; }),
                           "(l, 3) int32, not copied")
    .def("__repr__",
         [](const CellSheet &sheet)
         {
           std::ostringstream text;
           text << "<homespun.Sheet of " << sheet.fine.n1 << " x " << sheet.fine.n2
                << " cells: " << sheet.coarse.n_triangles() << " coarse triangles, "
                << sheet.fine.mesh.n_triangles() << " fine>";
           return text.str();
         });
}
} // namespace

PYBIND11_MODULE(_light, module)
{
  module.attr("__version__") = HOMESPUN_VERSION;
  module.doc()               = "Cells, cloths and up-sampling; see the package homespun.";
  module.attr("__module__")  = "homespun"; // whose names the classes are
  auto bad_input = py::register_exception<meshes::BadInput>(module, "BadInput", PyExc_ValueError);
  bad_input.doc() =
    "Input that cannot be used: a line per fault, which says the file, key, element or argument, "
    "what was found, what was expected and what to do.";
  auto not_converged =
    py::register_exception<meshes::NotConverged>(module, "NotConverged", PyExc_RuntimeError);
  not_converged.doc() =
    "A solver that stopped before its tolerance, with the norms of its residuals.";
  bad_input.attr("__module__")     = "homespun";
  not_converged.attr("__module__") = "homespun";
  const char *const why_not = "Why a file of this format_version is not read; empty where it is.";
  module.def("fault_of_format",
             py::overload_cast<const std::string &, int>(&meshes::fault_of_format), py::arg("path"),
             py::arg("found"), why_not);
  module.def("fault_of_format",
             py::overload_cast<const std::string &, const std::string &>(&meshes::fault_of_format),
             py::arg("path"), py::arg("found"), why_not);
  declare_cell(module);
  declare_sheet(module);
  declare_garment(module);
  declare_cloth(module);
  py::class_<Upsampler>(module, "Upsampler",
                        "Fine positions from coarse positions (paper Eqs. 9-12): what runs every "
                        "frame. One thread at a time.")
    .def(py::init(&make_upsampler), py::arg("cell"), py::arg("sheet"),
         py::arg("microscopic") = true, py::call_guard<py::gil_scoped_release>(),
         "microscopic=False interpolates the coarse motion alone.")
    .def(py::init(&make_garment_upsampler), py::arg("cell"), py::arg("sheet"),
         py::arg("microscopic") = true, py::call_guard<py::gil_scoped_release>(),
         "sheet: a Garment of the same cell.")
    .def_property_readonly("n_fine", &Upsampler::n_fine, "Number of fine vertices.")
    .def_property_readonly("n_coarse", &Upsampler::n_coarse, "Number of coarse vertices.")
    .def("upsample", &upsampled, py::arg("positions"), py::arg("out") = py::none(),
         "Fine positions (n_fine, 3) float32 of the coarse positions (n_coarse, 3) float64 [m]. "
         "Neither is copied; with `out` nothing is allocated.")
    .def("__repr__",
         [](const Upsampler &upsampler)
         {
           return "<homespun.Upsampler of " + std::to_string(upsampler.n_coarse()) +
                  " coarse vertices to " + std::to_string(upsampler.n_fine()) + " fine>";
         });
}
} // namespace homespun::python
