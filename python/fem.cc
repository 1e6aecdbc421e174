// SPDX-License-Identifier: MIT
// Homogenization for Python, on one rank. MPI starts with the first call and ends with the
// interpreter.
#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_frame.h"
#include "homogenization/lint/cell_reading.h"
#include "homogenization/lint/conformity.h"
#include "python/arrays.h"

#include <mpi.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace homespun::python
{
namespace
{
using homogenization::Phase;
using homogenization::UnitCell;

/// Whoever else uses MPI in this process may have started it.
void start_mpi()
{
  int is_started = 0;
  MPI_Initialized(&is_started);
  if (is_started)
    return;
  int granted = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &granted);
  py::module_::import("atexit").attr("register")(py::cpp_function(
    []()
    {
      int is_over = 0;
      MPI_Finalized(&is_over);
      if (!is_over)
        MPI_Finalize();
    }));
}

meshes::HomogenizedCell homogenized(const UnitCell &cell, const unsigned int order,
                                    const std::string &provenance)
{
  if (order != 1 && order != 2)
    throw meshes::BadInput("order: found " + std::to_string(order) + "; expected 1 or 2");
  start_mpi();
  const py::gil_scoped_release others_run;
  homogenization::HomogenizationOptions options;
  options.order  = order;
  options.solver = homogenization::CellSolver::fastest;
  return homogenized_cell(cell, homogenization::homogenize(cell, options, MPI_COMM_SELF),
                          provenance);
}

meshes::HomogenizedCell homogenize_file(const std::filesystem::path &file, const unsigned int order)
{
  return homogenized(homogenization::read_unit_cell(file), order,
                     "homespun for Python, " + file.string());
}

double number_of(const py::object &number, const std::string &name)
{
  const double value = PyFloat_AsDouble(number.ptr());
  if (!PyErr_Occurred())
    return value;
  PyErr_Clear();
  throw meshes::BadInput(name + ": found " + std::string(py::repr(number)) + "; expected a number");
}

Phase phase_of(const py::dict &phase, const std::string &name)
{
  const bool has_axes = phase.contains("E1");
  const std::vector<std::string> keys =
    has_axes ? std::vector<std::string>{"E1", "E2", "nu12", "G12", "angle", "thickness", "density"}
             : std::vector<std::string>{"E", "nu", "thickness", "density"};
  std::vector<std::string> faults;
  std::map<std::string, double> at;
  for (const std::string &key : keys)
    if (phase.contains(key))
      at[key] = number_of(phase[py::str(key)], name + ": `" + key + "`");
    else
      faults.push_back(name + ": has no `" + key +
                       "`; expected E, nu, thickness, density, or E1, E2, nu12, G12, angle, "
                       "thickness, density");
  if (!faults.empty())
    throw meshes::BadInput(faults);
  const Phase result =
    has_axes ? Phase{name,      at["E1"],    at["E2"],        at["nu12"],
                     at["G12"], at["angle"], at["thickness"], at["density"]}
             : homogenization::isotropic(name, at["E"], at["nu"], at["thickness"], at["density"]);
  if (faults = faults_of(result); !faults.empty())
    throw meshes::BadInput(faults);
  return result;
}

Eigen::VectorXi materials_of(const py::object &groups, const Eigen::Index n_triangles,
                             const std::size_t n_phases)
{
  Eigen::VectorXi materials = *Taken<Eigen::VectorXi>(groups, "groups");
  if (materials.size() != n_triangles)
    throw meshes::BadInput("groups: found " + std::to_string(materials.size()) +
                           "; expected one number per triangle, " + std::to_string(n_triangles));
  for (Eigen::Index t = 0; t < n_triangles; ++t)
    if (materials(t) >= static_cast<int>(n_phases))
      throw meshes::BadInput("groups: triangle " + std::to_string(t) + " has " +
                             std::to_string(materials(t)) + "; expected 0 to " +
                             std::to_string(n_phases - 1) + ", the index of a phase");
  return materials;
}

meshes::HomogenizedCell homogenize_arrays(const py::object &vertices, const py::object &triangles,
                                          const py::object &groups, const py::sequence &phases,
                                          const unsigned int order)
{
  UnitCell cell;
  cell.name           = "arrays";
  cell.mesh.vertices  = *Taken<meshes::Points>(vertices, "vertices");
  cell.mesh.triangles = *Taken<meshes::Triangles>(triangles, "triangles");
  for (std::size_t k = 0; k < phases.size(); ++k)
  {
    const std::string name = "phase " + std::to_string(k);
    const py::object phase = phases[k];
    if (!py::isinstance<py::dict>(phase))
      throw meshes::BadInput(name + ": found " + std::string(py::repr(phase)) +
                             "; expected a dict, such as dict(E=1e6, nu=0.3, thickness=5e-4, "
                             "density=400)");
    cell.phases.push_back(phase_of(phase, name));
  }
  if (cell.phases.empty())
    throw meshes::BadInput("phases: found none; expected a dict for each number in `groups`");
  cell.mesh.material = materials_of(groups, cell.mesh.n_triangles(), cell.phases.size());
  std::vector<std::string> faults = meshes::faults_of(cell.mesh, cell.name);
  if (!faults.empty())
    throw meshes::BadInput(faults);
  faults = meshes::messages_of(
    homogenization::conformity_faults(cell.mesh, cell.name, homogenization::Slits::refused, 1.));
  if (!faults.empty())
    throw meshes::BadInput(faults);
  homogenization::MatchedCell matched =
    homogenization::match_drawn_sides(cell.mesh, {}, {}, cell.name);
  faults = meshes::messages_of(matched.faults);
  if (matched.cuts_holes && faults.empty())
    faults = {cell.name +
              ": the outline cuts holes; expected them inside: draw the cell from another "
              "place, or homogenize it from a file"};
  if (!faults.empty())
    throw meshes::BadInput(faults);
  cell.mesh    = std::move(matched.mesh);
  cell.lattice = matched.lattice;
  return homogenized(cell, order, "homespun for Python, from arrays");
}
} // namespace

PYBIND11_MODULE(_fem, module)
{
  py::module_::import("homespun._light"); // which knows Cell and the exceptions
  module.def("homogenize_file", &homogenize_file, py::arg("file"), py::arg("order"));
  module.def("homogenize_arrays", &homogenize_arrays, py::arg("vertices"), py::arg("triangles"),
             py::arg("groups"), py::arg("phases"), py::arg("order"));
}
} // namespace homespun::python
