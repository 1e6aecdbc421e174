// SPDX-License-Identifier: MIT
// Cells, sheets and up-sampling for Python. Refusals are ValueError with the text of the program,
// what does not converge is homespun.NotConverged; the interpreter runs on while this computes.
#include "python/light.h"

#include "localization/garment/garment_panels.h"
#include "localization/garment/placed_garment.h"
#include "localization/given_method.h"
#include "meshes/files/format_version.h"
#include "python/arrays.h"
#include "python/laid_garment.h"

#include <pybind11/stl.h>

#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace homespun::python
{
namespace
{
using meshes::HomogenizedCell;
template <int dim, typename Scalar>
using Upsampler = localization::Upsampler<dim, Scalar>;

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

std::unique_ptr<CellSheet> make_sheet(const HomogenizedCell &cell, const long n1, const long n2,
                                      const long max_triangles)
{
  for (const auto &[name, number] : {std::pair("n1", n1), std::pair("n2", n2)})
    if (number < 1)
      throw meshes::BadInput(std::string(name) + ": found " + std::to_string(number) +
                             "; expected at least 1 cell");
  check_size(cell, static_cast<double>(n1) * static_cast<double>(n2), max_triangles);
  const py::gil_scoped_release others_run; // and no longer: pybind11 enters the object in a list
  return std::make_unique<CellSheet>(cell, static_cast<int>(n1), static_cast<int>(n2));
}

/// In space, as what runs every frame; in the plane, in double precision, as studies compare.
struct CellUpsampler
{
  localization::Method used;
  const Upsampler<3, float> in_space;
  const std::function<std::unique_ptr<Upsampler<2, double>>()> make_in_plane; ///< no Python in it
  std::unique_ptr<Upsampler<2, double>> in_plane = {}; ///< once it is asked for
};

using Held = std::optional<std::vector<std::string>>;

/// A method on a coarse cloth; what it cannot have there is a warning.
localization::GivenMethod method_on(const HomogenizedCell &cell, const std::string &method,
                                    const localization::GivenCloth &given)
{
  const auto found = on_given(localization::Method(method), cell, given);
  if (!found.left_out.empty() && PyErr_WarnEx(PyExc_UserWarning, found.left_out.c_str(), 1) != 0)
    throw py::error_already_set(); // warnings are errors
  return found;
}

localization::GivenCloth given_of(const Held &held, const bool has_slip)
{
  localization::GivenCloth given;
  if (held)
    given.held = held->empty() ? std::vector<std::string>{"none"} : *held;
  if (has_slip)
    given.slip = localization::Slip::of_cloth;
  return given;
}

std::unique_ptr<CellUpsampler> over_sheet(const HomogenizedCell &cell, const CellSheet &sheet,
                                          const std::string &method, const Held &held,
                                          const bool has_slip)
{
  const auto found = method_on(cell, method, given_of(held, has_slip));
  const py::gil_scoped_release others_run;
  return std::unique_ptr<CellUpsampler>(new CellUpsampler{
    found.used,
    {cell, sheet.coarse, sheet.fine, found.options},
    [&cell, &sheet, options = found.options]()
    { return std::make_unique<Upsampler<2, double>>(cell, sheet.coarse, sheet.fine, options); }});
}

std::unique_ptr<CellUpsampler> over_garment(const HomogenizedCell &cell, const LaidGarment &garment,
                                            const std::string &method, const Held &held,
                                            const bool has_slip)
{
  localization::GivenCloth given = given_of(held, has_slip);
  given.panels                   = localization::garment_panels(garment.coarse, garment.fine);
  const auto found               = method_on(cell, method, given);
  const auto placed              = [&cell, &garment, options = found.options]()
  { return placed_garment(cell, garment.coarse, garment.fine, options); };
  const py::gil_scoped_release others_run;
  return std::unique_ptr<CellUpsampler>(
    new CellUpsampler{found.used, Upsampler<3, float>(placed()),
                      [placed]() { return std::make_unique<Upsampler<2, double>>(placed()); }});
}

/// @param normals to be filled, or None
template <int dim, typename Scalar>
py::object upsampled(const Upsampler<dim, Scalar> &upsampler, const py::object &positions,
                     py::object out, const py::object &normals)
{
  using Fine = typename Upsampler<dim, Scalar>::Fine;
  if (out.is_none())
    out = py::array_t<Scalar>({static_cast<py::ssize_t>(upsampler.n_fine()), py::ssize_t(dim)});
  const Taken<localization::Positions<dim>> coarse(positions, "positions");
  const auto fine = room_in<Fine>(out, "out");
  if (normals.is_none())
  {
    const py::gil_scoped_release others_run;
    upsampler.upsample(*coarse, fine);
    return out;
  }
  const auto room = room_in<Fine>(normals, "normals");
  {
    const py::gil_scoped_release others_run;
    upsampler.upsample(*coarse, fine, room);
  }
  return out;
}

py::object upsample(CellUpsampler &upsampler, const py::object &positions, const py::object &out,
                    const py::object &normals)
{
  const py::array given = py::array::ensure(positions);
  if (!given || given.ndim() != 2 || given.shape(1) != 2)
    return upsampled(upsampler.in_space, positions, out, normals);
  if (!upsampler.in_plane)
  {
    const py::gil_scoped_release others_run;
    upsampler.in_plane = upsampler.make_in_plane();
  }
  return upsampled(*upsampler.in_plane, positions, out, normals);
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
      py::arg("max_triangles") = most_triangles,
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

void declare_upsampler(py::module_ &module)
{
  py::class_<CellUpsampler>(module, "Upsampler",
                            "Fine positions from coarse positions: what runs every frame. One "
                            "thread at a time.")
    .def(
      py::init(&over_sheet), py::arg("cell"), py::arg("sheet"), py::kw_only(),
      py::arg("method") = "localized", py::arg("held") = py::none(), py::arg("has_slip") = false,
      py::keep_alive<1, 2>(), py::keep_alive<1, 3>(),
      "method: what up-sampling adds to the coarse motion, `affine`, `localized` (the paper's) "
      "or `full`, or terms as in `localized+modes`. held: edges on lattice lines that are held, "
      "of left, right, bottom, top, for the term edges. has_slip: of a coarse cloth that moves by "
      "that term. What a method cannot have here is left out with a warning.")
    .def(py::init(&over_garment), py::arg("cell"), py::arg("garment"), py::kw_only(),
         py::arg("method") = "localized", py::arg("held") = py::none(), py::arg("has_slip") = false,
         py::keep_alive<1, 2>(), py::keep_alive<1, 3>(),
         "garment: a Garment of the same cell. held: of all its panels; edges that are sewn or lie "
         "on no lattice line have no terms of edges.")
    .def_property_readonly(
      "n_fine", [](const CellUpsampler &of) { return of.in_space.n_fine(); },
      "Number of fine vertices.")
    .def_property_readonly(
      "n_coarse", [](const CellUpsampler &of) { return of.in_space.n_coarse(); },
      "Number of coarse vertices.")
    .def_property_readonly(
      "terms", [](const CellUpsampler &of) { return of.used.term_names(); },
      "Terms of the method that are used here.")
    .def("upsample", &upsample, py::arg("positions"), py::arg("out") = py::none(),
         py::arg("normals") = py::none(),
         "Fine positions (n_fine, 3) float32 of the coarse positions (n_coarse, 3) float64 [m]; in "
         "the plane, of (n_coarse, 2), (n_fine, 2) float64, as `homespun strain` compares them. "
         "Neither is copied; with `out` nothing is allocated. `normals` (n_fine, 3) float32 is "
         "filled with unit normals, of a method with the term curved.")
    .def("__repr__",
         [](const CellUpsampler &of)
         {
           return "<homespun.Upsampler of " + std::to_string(of.in_space.n_coarse()) +
                  " coarse vertices to " + std::to_string(of.in_space.n_fine()) + " fine>";
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
  declare_upsampler(module);
}
} // namespace homespun::python
