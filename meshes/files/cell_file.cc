// SPDX-License-Identifier: MIT
#include "meshes/files/cell_file.h"

#include "meshes/files/cell_terms_file.h"
#include "meshes/files/hdf5_reader.h"
#include "meshes/files/hdf5_writer.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/symmetric_eigen.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace homespun::meshes
{
namespace
{
/// What a stiffness of strains or curvatures fulfils.
void add_faults_of(const Eigen::Matrix3d &stiffness, const std::string &name,
                   std::vector<std::string> &faults)
{
  if (!stiffness.allFinite())
  {
    faults.push_back(name + " holds values that are not finite");
    return;
  }
  const double scale = stiffness.cwiseAbs().maxCoeff();
  if ((stiffness - stiffness.transpose()).cwiseAbs().maxCoeff() > 1e-9 * scale)
    faults.push_back(name + " is not symmetric; expected an effective stiffness");
  else if (!(symmetric_eigen<3>(stiffness).values(0) > 0.))
    faults.push_back(name + " is not positive definite; expected an effective stiffness");
}

bool all_finite(const CellEdges &edges)
{
  return edges.bulk[0].allFinite() && edges.bulk[1].allFinite() &&
         std::all_of(edges.sides.begin(), edges.sides.end(),
                     [](const CellEdge &edge)
                     {
                       return edge.slip.allFinite() && edge.tension.allFinite() &&
                              edge.clamped.allFinite() && edge.free.allFinite();
                     });
}

/// What every cell fulfils, whoever made it.
std::vector<std::string> faults_of(const HomogenizedCell &cell, const std::string &path)
{
  std::vector<std::string> faults = faults_of(cell.mesh, path);
  const auto add = [&](const std::string &message) { faults.push_back(path + ": " + message); };
  if (cell.mesh.material.size() > 0 && (cell.mesh.material.minCoeff() < 0 ||
                                        cell.mesh.material.maxCoeff() >= cell.mesh.n_triangles()))
    add("/material goes from " + std::to_string(cell.mesh.material.minCoeff()) + " to " +
        std::to_string(cell.mesh.material.maxCoeff()) +
        "; expected phases from 0, no more than triangles");
  if (!cell.chi.allFinite())
    add("/chi holds values that are not finite");
  if (cell.chi.rows() != cell.mesh.n_vertices())
    add("/chi has " + std::to_string(cell.chi.rows()) + " rows for " +
        std::to_string(cell.mesh.n_vertices()) + " vertices");
  else if (cell.anchor < 0 || cell.anchor >= cell.mesh.n_vertices())
    add("attribute anchor of /chi is " + std::to_string(cell.anchor) + "; expected a vertex index");
  else if (cell.chi.row(cell.anchor).cwiseAbs().maxCoeff() >
           1e-12 * std::max(cell.chi.cwiseAbs().maxCoeff(), 1e-300))
    add("/chi is not zero at its anchor, vertex " + std::to_string(cell.anchor));
  add_faults_of(cell.stiffness, path + ": /C", faults);
  if (cell.bending)
  {
    add_faults_of(cell.bending->stiffness, path + ": /D", faults);
    if (!cell.bending->deflection.allFinite())
      add("/deflection holds values that are not finite");
    if (cell.bending->deflection.rows() != cell.mesh.n_vertices())
      add("/deflection has " + std::to_string(cell.bending->deflection.rows()) + " rows for " +
          std::to_string(cell.mesh.n_vertices()) + " vertices");
  }
  for (const auto &[law, second] : cell.second_order)
  {
    if (!second.energy.derivatives.allFinite())
      add("/W3/" + law + " holds values that are not finite");
    if (!second.chi.allFinite())
      add("/chi_quadratic/" + law + " holds values that are not finite");
    if (second.chi.rows() != cell.mesh.n_vertices())
      add("/chi_quadratic/" + law + " has " + std::to_string(second.chi.rows()) + " rows for " +
          std::to_string(cell.mesh.n_vertices()) + " vertices");
    else if (cell.anchor >= 0 && cell.anchor < cell.mesh.n_vertices() &&
             second.chi.row(cell.anchor).cwiseAbs().maxCoeff() >
               1e-12 * std::max(second.chi.cwiseAbs().maxCoeff(), 1e-300))
      add("/chi_quadratic/" + law + " is not zero at the anchor, vertex " +
          std::to_string(cell.anchor));
  }
  if (cell.edges && !all_finite(*cell.edges))
    add("/edges holds values that are not finite");
  if (!(cell.areal_density > 0.) || !(cell.areal_density < 1e300))
    add("/areal_density is " + std::to_string(cell.areal_density) +
        " kg/m^2; expected a positive number");
  if (!cell.lattice.vectors.allFinite() || !(cell.lattice.area() > 0.))
    add("/lattice spans no area; expected two independent vectors");
  return faults;
}

} // namespace

void write_cell(const HomogenizedCell &cell, const std::string &path)
{
  const std::vector<std::string> faults = faults_of(cell, path);
  if (!faults.empty())
    throw std::logic_error(BadInput(faults).what());

  Hdf5Writer file(path);
  const auto n = static_cast<unsigned long long>(cell.mesh.n_vertices());
  const auto m = static_cast<unsigned long long>(cell.mesh.n_triangles());
  file.write("/vertices", {n, 2}, cell.mesh.vertices.data(), "m");
  file.write("/triangles", {m, 3}, cell.mesh.triangles.data());
  file.write("/material", {m}, cell.mesh.material.data());
  const Eigen::Matrix<double, 2, 2, Eigen::RowMajor> lattice = cell.lattice.vectors;
  file.write("/lattice", {2, 2}, lattice.data(), "m");
  if (cell.lattice.cuts_holes)
    file.attribute("/lattice", "cuts_holes", 1);
  file.write("/chi", {n, 2, 3}, by_component(cell.chi).data(), "m");
  file.attribute("/chi", "anchor", cell.anchor);
  file.attribute(
    "/chi", "convention",
    "w = -(E11 chi_11 + E22 chi_22 + gamma12 chi_12), engineering shear; axes: vertex, component, "
    "load (11, 22, 12)");
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> stiffness = cell.stiffness;
  file.write("/C", {3, 3}, stiffness.data(), "N/m");
  file.attribute("/C", "convention", "Voigt 11, 22, 12 with engineering shear");
  file.write("/areal_density", {1}, &cell.areal_density, "kg/m^2");
  if (cell.bending)
  {
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> bending = cell.bending->stiffness;
    file.write("/D", {3, 3}, bending.data(), "N m");
    file.attribute("/D", "convention", "Voigt 11, 22, 12; curvatures kappa11, kappa22, 2 kappa12");
    file.write("/deflection", {n, 3}, cell.bending->deflection.data(), "m^2");
    file.attribute("/deflection", "convention",
                   "w3 = y.K.y/2 + K11 w_1 + K22 w_2 + 2 K12 w_3, kappa = +grad grad w3; axes: "
                   "vertex, macro curvature (11, 22, 12)");
  }
  write_terms(cell, file);
  file.attribute("/", "provenance", cell.provenance);
  if (!cell.place_of_cut.empty())
    file.attribute("/", "place_of_cut", cell.place_of_cut);
  file.finish();
}

HomogenizedCell read_cell(const std::string &path)
{
  const Hdf5Reader file(path, "a cell.h5: make it with `homespun homogenize`");
  const auto n = file.shape_of("/vertices", {Hdf5Reader::any, 2})[0],
             m = file.shape_of("/triangles", {Hdf5Reader::any, 3})[0];

  HomogenizedCell cell;
  const auto rows = static_cast<Eigen::Index>(n), triangles = static_cast<Eigen::Index>(m);
  const std::vector<double> vertices = file.numbers("/vertices", {n, 2}),
                            lattice  = file.numbers("/lattice", {2, 2}),
                            C        = file.numbers("/C", {3, 3});
  const std::vector<int> corners     = file.integers("/triangles", {m, 3}),
                         material    = file.integers("/material", {m});
  cell.mesh.vertices                 = Eigen::Map<const Points>(vertices.data(), rows, 2);
  cell.mesh.triangles                = Eigen::Map<const Triangles>(corners.data(), triangles, 3);
  cell.mesh.material = Eigen::Map<const Eigen::VectorXi>(material.data(), triangles);
  cell.lattice.vectors =
    Eigen::Map<const Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(lattice.data());
  cell.lattice.cuts_holes = file.integer_attribute("/lattice", "cuts_holes").value_or(0) != 0;
  cell.stiffness     = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(C.data());
  cell.areal_density = file.numbers("/areal_density", {1})[0];
  cell.chi           = by_mode<Chi>(file.numbers("/chi", {n, 2, 3}));
  if (file.has("/D"))
  {
    const std::vector<double> D          = file.numbers("/D", {3, 3}),
                              deflection = file.numbers("/deflection", {n, 3});
    cell.bending = {Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(D.data()),
                    Eigen::Map<const Deflection>(deflection.data(), rows, 3)};
  }
  read_terms(file, path, cell);
  const std::optional<int> anchor = file.integer_attribute("/chi", "anchor");
  if (!anchor)
    throw BadInput(path +
                   ": attribute anchor of /chi is missing; expected the vertex where chi is zero");
  cell.anchor                           = *anchor;
  cell.provenance                       = file.text_attribute("/", "provenance").value_or("");
  cell.place_of_cut                     = file.text_attribute("/", "place_of_cut").value_or("");
  const std::vector<std::string> faults = faults_of(cell, path);
  if (!faults.empty())
    throw BadInput(faults);
  return cell;
}
} // namespace homespun::meshes
