// SPDX-License-Identifier: MIT
// Homogenization for Python, on one rank. MPI starts with the first call and ends with the
// interpreter.
#include "homogenization/lint/cell_frame.h"
#include "homogenization/lint/cell_lint.h"
#include "homogenization/lint/cell_reading.h"
#include "homogenization/lint/conformity.h"
#include "python/arrays.h"
#include "python/bracketed_cell.h"
#include "python/one_at_a_time.h"
#include "verification/cell/assessed_cell.h"
#include "verification/cell/cell_edges.h"
#include "verification/cell/cell_summary.h"

#include <mpi.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace homespun::python
{
namespace
{
using homogenization::Phase;
using homogenization::UnitCell;

struct Choices
{
  Choices(const long order, const bool bars, const std::optional<long> max_dofs)
      : order(static_cast<unsigned int>(order))
      , bars(bars)
  {
    if (order != 1 && order != 2)
      throw meshes::BadInput("order: found " + std::to_string(order) + "; expected 1 or 2");
    constexpr long most = std::numeric_limits<unsigned int>::max();
    if (max_dofs && (*max_dofs < 1 || *max_dofs > most))
      throw meshes::BadInput("max_dofs: found " + std::to_string(*max_dofs) + "; expected 1 to " +
                             std::to_string(most) + ", or None");
    if (max_dofs)
      this->max_dofs = static_cast<unsigned int>(*max_dofs);
  }

  unsigned int order;
  bool bars;
  std::optional<unsigned int> max_dofs; ///< of brackets; nothing: the default of the program
};

/// Whoever else uses MPI in this process may have started it.
void start_mpi()
{
  int was_started = 0;
  {
    const OneAtATime mine;
    MPI_Initialized(&was_started);
    int granted = 0;
    if (!was_started)
      MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &granted);
  }
  if (was_started)
    return;
  py::module_::import("atexit").attr("register")(py::cpp_function(
    []()
    {
      int is_over = 0;
      MPI_Finalized(&is_over);
      if (!is_over)
        MPI_Finalize();
    }));
}

/// What the program tells on the terminal, as a warning of Python.
void warn(const std::string &text)
{
  if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 2) != 0)
    throw py::error_already_set(); // warnings are errors
}

/// A text of the program with its option as an argument.
std::string in_python(std::string text)
{
  const std::string option = "--max-dofs";
  const std::size_t place  = text.find(option);
  return place == std::string::npos ? text : text.replace(place, option.size(), "max_dofs");
}

template <typename Found>
BracketOfStiffness bracket_of(const Found &found)
{
  return {found.lower,
          found.upper,
          0.5 * (found.lower + found.upper),
          0.5 * verification::bars_of(found),
          found.width,
          found.is_of_drawing};
}

/// As `homespun homogenize` does it.
verification::AssessedCell assessed(const UnitCell &cell, const Choices &choices)
{
  const auto silent = [](const std::string &) {};
  homogenization::HomogenizationOptions options;
  options.order = choices.order;
  if (verification::too_dear_second_order(cell, options).empty())
    options.second_order = meshes::laws_with(&meshes::LawProperties::has_second_order);
  verification::AssessedCell result = verification::assess(cell, options, MPI_COMM_SELF);
  result.edges                      = verification::affordable_edges(cell, choices.order);
  if (!choices.bars)
    return result;
  verification::BracketOptions bracket;
  bracket.order    = choices.order;
  bracket.max_dofs = choices.max_dofs.value_or(bracket.max_dofs);
  verification::add_bracket(cell, bracket, silent, result);
  verification::add_bending(cell, bracket, silent, result);
  return result;
}

BracketedCell homogenized(const UnitCell &cell, const Choices &choices,
                          const std::string &provenance)
{
  start_mpi();
  const verification::AssessedCell found = [&]()
  {
    const OneAtATime mine;
    return assessed(cell, choices);
  }();
  for (const verification::Verdict &check : found.checks)
    if (check.outcome == verification::Outcome::fail)
      warn("FAIL " + check.claim + ": found " + std::string(py::str(py::float_(check.value))) +
           "; expected " + check.limit);
  BracketedCell result{verification::homogenized_cell(cell, found, provenance), {}, {}};
  result.edges = found.edges->edges;
  if (found.bracket && found.bracket->bracket)
    result.stiffness_bracket = bracket_of(*found.bracket->bracket);
  else if (choices.bars)
    warn("bracket on C^H: " + in_python(found.bracket->remark));
  if (found.bending && found.bending->bracket)
    result.bending_bracket = bracket_of(*found.bending->bracket);
  else if (choices.bars)
    warn("bracket on D^H: " + in_python(found.bending->remark));
  return result;
}

BracketedCell homogenize_file(const std::filesystem::path &file, const Choices &choices)
{
  std::ostringstream warnings;
  const UnitCell cell = [&]()
  {
    const OneAtATime mine;
    return homogenization::read_unit_cell(file, MPI_COMM_NULL, &warnings);
  }();
  std::istringstream lines(warnings.str());
  for (std::string line; std::getline(lines, line);)
    warn(line.substr(line.find(": ") + 2)); // behind `warning`
  return homogenized(cell, choices, "homespun for Python, " + file.string());
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
  for (const auto &[key, value] : phase)
    if (at.count(py::str(key)) == 0)
      faults.push_back(name + ": found `" + std::string(py::str(key)) + "`; expected " +
                       meshes::one_of(keys));
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

/// With the lattice that its outline has.
/// @throws BadInput where the mesh is none of a cell
UnitCell periodic(UnitCell cell)
{
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
  std::vector<homogenization::Finding> findings =
    homogenization::lint_mechanisms(cell.mesh, cell.lattice, 1.);
  for (const homogenization::Finding &one : homogenization::lint_contrast(cell))
    findings.push_back(one);
  for (const homogenization::Finding &one : findings)
    if (one.severity == homogenization::Severity::error)
      faults.push_back(cell.name + ": " + homogenization::text_of(one));
  if (!faults.empty())
    throw meshes::BadInput(faults);
  return cell;
}

BracketedCell homogenize_arrays(const py::object &vertices, const py::object &triangles,
                                const py::object &groups, const py::sequence &phases,
                                const Choices &choices)
{
  UnitCell cell;
  cell.name           = "arrays";
  cell.mesh.vertices  = *Taken<meshes::Points>(vertices, "vertices");
  cell.mesh.triangles = *Taken<meshes::Triangles>(triangles, "triangles");
  for (std::size_t k = 0; k < phases.size(); ++k)
  {
    const std::string name = "phase " + std::to_string(k);
    const py::object given = phases[k];
    py::dict phase;
    if (PyDict_Update(phase.ptr(), given.ptr()) != 0)
    {
      PyErr_Clear();
      throw meshes::BadInput(name + ": found " + std::string(py::repr(given)) +
                             "; expected a dict, such as dict(E=1e6, nu=0.3, thickness=5e-4, "
                             "density=400)");
    }
    cell.phases.push_back(phase_of(phase, name));
  }
  if (cell.phases.empty())
    throw meshes::BadInput("phases: found none; expected a dict for each number in `groups`");
  cell.mesh.material = materials_of(groups, cell.mesh.n_triangles(), cell.phases.size());
  {
    const py::gil_scoped_release others_run;
    cell = periodic(std::move(cell));
  }
  return homogenized(cell, choices, "homespun for Python, from arrays");
}
} // namespace

PYBIND11_MODULE(_fem, module)
{
  py::module_::import("homespun._light"); // which knows Cell and the exceptions
  py::class_<Choices>(module, "Choices")
    .def(py::init<long, bool, std::optional<long>>(), py::arg("order"), py::arg("bars"),
         py::arg("max_dofs"));
  module.def("homogenize_file", &homogenize_file, py::arg("file"), py::arg("choices"));
  module.def("homogenize_arrays", &homogenize_arrays, py::arg("vertices"), py::arg("triangles"),
             py::arg("groups"), py::arg("phases"), py::arg("choices"));
}
} // namespace homespun::python
