// SPDX-License-Identifier: MIT
#include "verification/upsample/upsampled_cloth.h"

#include "localization/garment/garment_panels.h"
#include "localization/garment/placed_garment.h"
#include "meshes/plain/point_location.h"
#include "meshes/plain/sheet.h"

#include <cmath>
#include <optional>

namespace homespun::verification
{
using meshes::ClothMesh;
using meshes::HomogenizedCell;

namespace
{
/// A sheet of whole cells, and its coarse mesh.
struct WholeCells
{
  int n1, n2, quads; ///< of the coarse mesh along a cell's side
  meshes::TriangleMesh rest;
};

/// The sheet whose coarse mesh a cloth is, in the order of meshes::coarse_sheet(), its vertices
/// where whole cells have them; nothing where it is none.
std::optional<WholeCells> whole_cells(const meshes::Lattice &lattice, const ClothMesh &cloth,
                                      const meshes::Grain &grain)
{
  if (grain.angle != 0. || cloth.rest.n_vertices() != cloth.n_vertices() ||
      cloth.rest.triangles != cloth.triangles)
    return {};
  // In cells along a1 and a2 from the lattice point that is given.
  meshes::Points cells(cloth.rest.n_vertices(), 2);
  for (int v = 0; v < cells.rows(); ++v)
    cells.row(v) = lattice.fractional(cloth.rest.vertices.row(v) - grain.origin);
  const Eigen::RowVector2d low = cells.colwise().minCoeff().array().round(),
                           n   = cells.colwise().maxCoeff().array().round() - low.array();
  if (!(n.minCoeff() >= 1.) || !(n.maxCoeff() < 1e4))
    return {};
  for (const int quads : {1, 2}) // of the sides of a cell
  {
    if (cloth.n_triangles() != 2. * quads * quads * n(0) * n(1))
      continue;
    WholeCells whole = {static_cast<int>(n(0)), static_cast<int>(n(1)), quads, {}};
    whole.rest = meshes::coarse_sheet(grain.origin + low * lattice.vectors, lattice.vectors / quads,
                                      quads * whole.n1, quads * whole.n2);
    whole.rest.material = cloth.rest.material;
    if (cloth.rest.triangles == whole.rest.triangles &&
        cloth.rest.vertices.rows() == whole.rest.vertices.rows() &&
        (cloth.rest.vertices - whole.rest.vertices).cwiseAbs().maxCoeff() <=
          meshes::outline_tolerance * std::sqrt(lattice.area()))
      return whole;
  }
  return {};
}
} // namespace

UpsampledCloth::UpsampledCloth(const HomogenizedCell &cell, const ClothMesh &rest,
                               const meshes::Grain &grain, const localization::Method &method,
                               localization::GivenCloth given)
    : method{method, {}, {}, {}}
    , coarse(rest)
{
  using Upsampler  = localization::Upsampler<3, float>;
  const auto whole = whole_cells(cell.lattice, rest, grain);
  if (whole)
  {
    this->method              = on_given(method, cell, given);
    const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, whole->n1, whole->n2);
    coarse.rest               = whole->rest;
    triangles                 = sheet.mesh.triangles;
    look = meshes::ClothLook::of(sheet.mesh.vertices, triangles, sheet.mesh.material);
    const meshes::TriangleMesh over_sheet =
      meshes::coarse_sheet(sheet.origin, sheet.lattice.vectors / whole->quads,
                           whole->quads * whole->n1, whole->quads * whole->n2);
    upsampler   = std::make_unique<Upsampler>(cell, over_sheet, sheet, this->method.options);
    description = "a sheet of " + std::to_string(whole->n1) + " x " + std::to_string(whole->n2) +
                  " cells, " + std::to_string(rest.n_triangles()) +
                  " coarse triangles on their lattice";
    // A vertex on an edge belongs to the triangle that the up-sampler takes.
    const meshes::PointLocation location(over_sheet);
    const Eigen::RowVector2d towards =
      1e-5 * Eigen::RowVector2d(2. / 3., 1. / 3.) * sheet.lattice.vectors;
    coarse_triangle.resize(sheet.mesh.n_vertices());
    for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
      coarse_triangle(v) = location.locate(sheet.mesh.vertices.row(v), towards).triangle;
    return;
  }
  meshes::FineClothOptions options;
  options.grains               = {grain};
  const meshes::FineCloth fine = meshes::fine_cloth(cell.mesh, cell.lattice, rest, options);
  given.panels                 = localization::garment_panels(rest, fine);
  this->method                 = on_given(method, cell, given);
  const std::size_t n_panels   = given.panels.size();
  description = std::to_string(n_panels) + (n_panels == 1 ? " panel" : " panels") + ", " +
                std::to_string(rest.n_triangles()) + " coarse triangles, cells cut along outlines";
  triangles = fine.sewn_triangles();
  look      = meshes::ClothLook::of(fine.rest.vertices, fine.rest.triangles, fine.rest.material);
  coarse_triangle = fine.coarse_triangle;
  upsampler       = std::make_unique<Upsampler>(
    localization::placed_garment(cell, coarse, fine, this->method.options));
}
} // namespace homespun::verification
