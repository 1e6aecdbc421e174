// SPDX-License-Identifier: MIT
// Cells laid over a coarse cloth of any shape, for Python: an OBJ file, or arrays.
#include "localization/garment/unit_question.h"
#include "meshes/files/obj_file.h"
#include "meshes/files/polygons.h"
#include "meshes/garment/fine_cloth.h"
#include "meshes/plain/homogenized_cell.h"
#include "python/arrays.h"
#include "python/laid_garment.h"
#include "python/light.h"

#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

namespace homespun::python
{
namespace
{
namespace fs = std::filesystem;
using meshes::ClothMesh;
using meshes::HomogenizedCell;

/// How the numbers of a file are taken.
struct Reading
{
  double unit, vt_unit;
  bool is_flat, accepts_strain;
};

void check_unit(const char *name, const double unit)
{
  if (!(unit > 0.) || !std::isfinite(unit))
    throw meshes::BadInput(std::string(name) + ": found " + std::string(py::str(py::float_(unit))) +
                           "; expected metres per unit, as 0.01 of centimetres");
}

/// @throws BadInput also where its units are questionable
ClothMesh cloth_in(const HomogenizedCell &cell, const fs::path &file, const Reading &reading)
{
  meshes::Polygons mesh = meshes::read_polygons(file);
  mesh.positions *= reading.unit;
  localization::RestUnits units;
  units.file    = file;
  units.unit    = reading.unit;
  units.vt_unit = reading.vt_unit;
  units.has_vt  = mesh.has_vt && !reading.is_flat;
  units.answer  = localization::AnswerBy::keyword;
  ClothMesh cloth =
    units.has_vt ? meshes::read_cloth(file, reading.vt_unit) : meshes::flat_cloth(mesh, file);
  if (units.has_vt)
  {
    cloth.positions   = mesh.positions;
    units.may_be_flat = meshes::is_flat(mesh);
  }
  if (reading.accepts_strain)
    return cloth;
  std::string question =
    localization::question_of_cells(cloth, std::sqrt(cell.lattice.area()), units);
  if (question.empty() && units.has_vt)
    question =
      localization::question_of_strain(cloth, {cloth.rest, {}}, file, mesh.positions, units);
  if (!question.empty())
    throw meshes::BadInput(question);
  return cloth;
}

std::unique_ptr<LaidGarment> laid(const HomogenizedCell &cell, ClothMesh cloth,
                                  const meshes::Grain &grain, const long max_triangles)
{
  check_size(cell, meshes::signed_areas(cloth.rest).sum() / cell.lattice.area(), max_triangles);
  meshes::FineClothOptions options;
  options.grains     = {grain};
  auto garment       = std::make_unique<LaidGarment>();
  garment->fine      = meshes::fine_cloth(cell.mesh, cell.lattice, cloth, options);
  garment->coarse    = std::move(cloth);
  garment->triangles = garment->fine.sewn_triangles();
  return garment;
}

meshes::Grain grain_of(const py::object &origin, const double angle)
{
  return {*Taken<Eigen::RowVector2d>(origin, "origin"), angle * std::acos(-1.) / 180.};
}

std::unique_ptr<LaidGarment> laid_on_arrays(const HomogenizedCell &cell, const py::object &rest,
                                            const py::object &triangles, const py::object &origin,
                                            const double angle, const long max_triangles)
{
  ClothMesh cloth           = cloth_of(rest, triangles, py::none());
  const meshes::Grain grain = grain_of(origin, angle);
  const py::gil_scoped_release others_run;
  return laid(cell, std::move(cloth), grain, max_triangles);
}
} // namespace

meshes::ClothMesh cloth_of(const py::object &rest, const py::object &triangles,
                           const py::object &positions)
{
  ClothMesh mesh;
  mesh.rest.vertices  = *Taken<meshes::Points>(rest, "rest");
  mesh.rest.triangles = *Taken<meshes::Triangles>(triangles, "triangles");
  mesh.rest.material  = Eigen::VectorXi::Zero(mesh.rest.n_triangles());
  mesh.triangles      = mesh.rest.triangles;
  mesh.positions      = meshes::SpacePoints::Zero(mesh.rest.n_vertices(), 3);
  if (positions.is_none())
    mesh.positions.leftCols<2>() = mesh.rest.vertices;
  else
    mesh.positions = *Taken<meshes::SpacePoints>(positions, "positions");
  if (mesh.positions.rows() != mesh.rest.n_vertices())
    throw meshes::BadInput("positions: found " + std::to_string(mesh.positions.rows()) +
                           " rows; expected " + std::to_string(mesh.rest.n_vertices()) +
                           ", one per row of `rest`");
  const std::vector<std::string> faults = meshes::faults_of(mesh.rest, "rest mesh");
  if (!faults.empty())
    throw meshes::BadInput(faults);
  return mesh;
}

void declare_garment(py::module_ &module)
{
  using Garment    = LaidGarment;
  const auto field = [](auto member)
  {
    return [member](const py::object &self)
    { return view(member(self.cast<const Garment &>()), self); };
  };
  py::class_<Garment>(module, "Garment",
                      "Cells laid over the panels of a coarse cloth of any shape, cut along their "
                      "outlines: what Upsampler takes where there is no Sheet.")
    .def(py::init(
           [](const HomogenizedCell &cell, const fs::path &file, const double unit,
              const double vt_unit, const bool flat, const bool accept_strain,
              const py::object &origin, const double angle, const long max_triangles)
           {
             check_unit("unit", unit);
             check_unit("vt_unit", vt_unit);
             const meshes::Grain grain = grain_of(origin, angle);
             const py::gil_scoped_release others_run;
             return laid(cell, cloth_in(cell, file, {unit, vt_unit, flat, accept_strain}), grain,
                         max_triangles);
           }),
         py::arg("cell"), py::arg("file"), py::kw_only(), py::arg("unit") = 1.,
         py::arg("vt_unit") = 1., py::arg("flat") = false, py::arg("accept_strain") = false,
         py::arg("origin") = py::make_tuple(0., 0.), py::arg("angle") = 0.,
         py::arg("max_triangles") = most_triangles,
         "file: an OBJ whose `vt` are the panels at rest, or which is flat where it has none; or a "
         "flat PLY. unit: metres per unit of its positions; vt_unit: metres per unit of `vt`. "
         "flat: take the rest state from the positions of a flat mesh although it has `vt`. "
         "origin (2,) [m]: a rest point that is a corner of a cell; angle [degrees] of the cells "
         "to the first rest axis. Raises BadInput with what is wrong with the file, where the fine "
         "mesh would have more than max_triangles, and, unless accept_strain, where the mean "
         "strain of its positions is above 50 %, the mean compression above 30 %, or a triangle "
         "longer than a hundred cells, which mostly mean units that differ.")
    .def(py::init(&laid_on_arrays), py::arg("cell"), py::arg("rest"), py::arg("triangles"),
         py::kw_only(), py::arg("origin") = py::make_tuple(0., 0.), py::arg("angle") = 0.,
         py::arg("max_triangles") = most_triangles,
         "rest (n, 2) [m] and triangles (m, 3): a flat mesh, counterclockwise.")
    .def_property_readonly(
      "vertices", field([](const Garment &its) -> auto & { return its.fine.rest.vertices; }),
      "(n, 2) float64 of the fine mesh at rest [m], not copied")
    .def_property_readonly("triangles",
                           field([](const Garment &its) -> auto & { return its.triangles; }),
                           "(m, 3) int32 of the fine mesh, closed along seams, not copied")
    .def_property_readonly(
      "material", field([](const Garment &its) -> auto & { return its.fine.rest.material; }),
      "(m,) int32, phase of each fine triangle, not copied")
    .def_property_readonly("coarse_positions",
                           field([](const Garment &its) -> auto & { return its.coarse.positions; }),
                           "(k, 3) float64 where the coarse cloth is in the file [m], not copied")
    .def_property_readonly("coarse_triangles",
                           field([](const Garment &its) -> auto & { return its.coarse.triangles; }),
                           "(l, 3) int32 between coarse positions, not copied")
    .def("__repr__",
         [](const Garment &its)
         {
           return "<homespun.Garment of " + std::to_string(its.coarse.n_vertices()) +
                  " coarse vertices: " + std::to_string(its.coarse.n_triangles()) +
                  " coarse triangles, " + std::to_string(its.triangles.rows()) + " fine>";
         });
  module.def(
    "read_positions",
    [](const fs::path &file)
    {
      const meshes::SpacePoints positions = [&]()
      {
        const py::gil_scoped_release others_run;
        return meshes::read_polygons(file).positions;
      }();
      return copy_of(positions);
    },
    py::arg("file"),
    "(n, 3) float64: the vertices of an OBJ or PLY file in its order and unit, such as a frame of "
    "a simulation.");
}
} // namespace homespun::python
