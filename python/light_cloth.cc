// SPDX-License-Identifier: MIT
// A moving cloth for Python: membrane of a cell, gravity, damping, bending.
#include "meshes/cloth/cloth_mesh.h"
#include "meshes/plain/homogenized_cell.h"
#include "python/arrays.h"
#include "python/laid_garment.h"
#include "python/light.h"
#include "shell/solver/cloth.h"
#include "shell/terms/inertial_terms.h"
#include "shell/terms/membrane_term.h"
#include "shell/terms/plate_term.h"

#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace homespun::python
{
namespace
{
using meshes::HomogenizedCell;

/// What a cloth is made of beside its mesh.
struct ClothChoices
{
  std::vector<int> held;
  Eigen::RowVector3d gravity;
  double damping, viscosity;
  bool bends;
  std::string integrator;
};

shell::Integrator integrator_of(const std::string &name)
{
  if (name == "linearly implicit")
    return shell::Integrator::linearly_implicit;
  if (name == "implicit")
    return shell::Integrator::implicit;
  if (name == "conserving")
    return shell::Integrator::conserving;
  throw meshes::BadInput("integrator: found `" + name +
                         "`; expected `linearly implicit`, `implicit` or `conserving`");
}

void add_bending(const HomogenizedCell &cell, const meshes::ClothMesh &mesh,
                 const shell::Integrator integrator, shell::Cloth &cloth)
{
  if (!cell.bending)
    throw meshes::BadInput("bending: the cell has no D^H; expected one that `homespun homogenize` "
                           "gave both stiffnesses: homogenize it again without --no-bars");
  cloth.add(shell::plate_term(mesh, {shell::PlateStiffness::from(cell.bending->stiffness)},
                              integrator == shell::Integrator::conserving
                                ? shell::PlateModel::hinges
                                : shell::PlateModel::by_mesh));
}

/// A cloth of one cell's stiffness: all triangles are phase 0.
std::unique_ptr<shell::Cloth> make_cloth(const HomogenizedCell &cell, const meshes::ClothMesh &mesh,
                                         const ClothChoices &choices)
{
  const Eigen::VectorXd masses = shell::lumped_masses(mesh, {cell.areal_density});
  shell::ClothOptions options;
  options.integrator = integrator_of(choices.integrator);
  auto cloth = std::make_unique<shell::Cloth>(mesh.positions, masses, choices.held, options);
  cloth->add(shell::membrane_term(mesh, {cell.stiffness}, choices.viscosity));
  if (!choices.gravity.isZero(0.))
    cloth->add(shell::gravity_term(masses, choices.gravity));
  if (choices.damping != 0.)
    cloth->add(shell::mass_damping_term(masses, choices.damping));
  if (choices.bends)
    add_bending(cell, mesh, options.integrator, *cloth);
  return cloth;
}

std::vector<int> indices_in(const py::object &list, const std::string &name)
{
  const Taken<Eigen::VectorXi> taken(list, name);
  const auto indices = *taken;
  return {indices.begin(), indices.end()};
}

Eigen::RowVector3d vector_in(const py::object &numbers, const std::string &name)
{
  return *Taken<Eigen::RowVector3d>(numbers, name);
}
} // namespace

void declare_cloth(py::module_ &module)
{
  using shell::Cloth;
  py::class_<Cloth>(module, "Cloth",
                    "A cloth in motion with the effective stiffness of a cell. rest (n, 2) and "
                    "triangles (m, 3) are the flat mesh, positions (n, 3) where it begins (rest, "
                    "with z = 0); held vertices stay or are moved by prescribe().")
    .def(
      py::init(
        [](const HomogenizedCell &cell, const py::object &rest, const py::object &triangles,
           const py::object &positions, const py::object &held, const py::object &gravity,
           const double damping, const double viscosity, const bool bending,
           const std::string &integrator)
        {
          const meshes::ClothMesh mesh = cloth_of(rest, triangles, positions);
          const ClothChoices choices   = {indices_in(held, "held"),
                                          vector_in(gravity, "gravity"),
                                          damping,
                                          viscosity,
                                          bending,
                                          integrator};
          const py::gil_scoped_release others_run;
          return make_cloth(cell, mesh, choices);
        }),
      py::arg("cell"), py::arg("rest"), py::arg("triangles"), py::kw_only(),
      py::arg("positions") = py::none(), py::arg("held") = py::tuple(),
      py::arg("gravity") = py::make_tuple(0., 0., -9.81), py::arg("damping") = 0.,
      py::arg("viscosity") = 0., py::arg("bending") = false,
      py::arg("integrator") = "linearly implicit",
      "rest (n, 2) [m], triangles (m, 3), positions (n, 3) [m], held: indices (k,), gravity (3,) "
      "[m/s^2], damping [1/s], viscosity [s]; bending takes D^H of the cell; integrator `linearly "
      "implicit`, `implicit` or `conserving`. Raises BadInput naming the argument.")
    .def(
      "step", [](Cloth &cloth, const double h) { cloth.step(h); }, py::arg("h"),
      py::call_guard<py::gil_scoped_release>(), "One time step of h [s]. Raises NotConverged.")
    .def(
      "solve_equilibrium",
      [](Cloth &cloth, const double tolerance) { cloth.solve_equilibrium(tolerance); },
      py::arg("tolerance") = 1e-8, py::call_guard<py::gil_scoped_release>(),
      "Static equilibrium under the prescribed positions, to |forces| below the tolerance times "
      "their sum. Raises NotConverged.")
    .def(
      "prescribe",
      [](Cloth &cloth, const int vertex, const py::object &position)
      { cloth.prescribe(vertex, vector_in(position, "position")); },
      py::arg("vertex"), py::arg("position"),
      "Where a held vertex is to be at the end of the next step, position (3,) [m].")
    .def_property_readonly(
      "positions",
      [](const py::object &self) { return view(self.cast<const Cloth &>().positions(), self); },
      "(n, 3) float64 [m], not copied: changes with the next step")
    .def_property_readonly(
      "velocities",
      [](const py::object &self) { return view(self.cast<const Cloth &>().velocities(), self); },
      "(n, 3) float64 [m/s], not copied: changes with the next step")
    .def_property_readonly(
      "masses",
      [](const py::object &self) { return view(self.cast<const Cloth &>().masses(), self); },
      "(n,) float64 [kg], not copied")
    .def_property_readonly("time", &Cloth::time, "[s]")
    .def_property_readonly("kinetic_energy", &Cloth::kinetic_energy, "[J]")
    .def_property_readonly("stored_energy", &Cloth::stored_energy, "[J]")
    .def("__repr__",
         [](const Cloth &cloth)
         {
           std::ostringstream text;
           text.precision(3);
           text << "<homespun.Cloth of " << cloth.masses().size() << " vertices, "
                << cloth.masses().sum() << " kg, at " << cloth.time() << " s: kinetic energy "
                << cloth.kinetic_energy() << " J, stored " << cloth.stored_energy() << " J>";
           return text.str();
         });
}
} // namespace homespun::python
