// SPDX-License-Identifier: MIT
#include "verification/upsample/upsampled_cloth.h"

#include "localization/garment/placed_garment.h"
#include "meshes/cloth/cloth_faults.h"
#include "meshes/cloth/seams.h"
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
  int n1, n2, quads;         ///< of the coarse mesh along a cell's side; 0: it is in no such order
  Eigen::RowVector2d corner; ///< of the sheet [m]
  meshes::TriangleMesh rest;
};

/// The sheet that a coarse mesh covers, its vertices where whole cells have them; nothing where it
/// covers none.
std::optional<WholeCells> whole_cells(const meshes::Lattice &lattice, const ClothMesh &cloth,
                                      const meshes::Grain &grain)
{
  if (grain.angle != 0. || cloth.rest.n_vertices() != cloth.n_vertices() ||
      cloth.rest.triangles != cloth.triangles)
    return {};
  WholeCells whole = {0, 0, 0, {}, cloth.rest};
  // In cells along a1 and a2 from the lattice point that is given.
  meshes::Points cells(whole.rest.n_vertices(), 2);
  for (int v = 0; v < cells.rows(); ++v)
    cells.row(v) = lattice.fractional(whole.rest.vertices.row(v) - grain.origin);
  const Eigen::RowVector2d low  = cells.colwise().minCoeff().array().round(),
                           high = cells.colwise().maxCoeff().array().round();
  const auto beside             = [&](const Eigen::Array2d &line) // of each vertex
  { return (cells.array().rowwise() - line.transpose()).abs() <= meshes::outline_tolerance; };
  const double n_cells = (high - low).prod();
  if (!(n_cells >= 1.) || !((high - low).maxCoeff() < 1e4) ||
      (cells.rowwise() - low).minCoeff() < -meshes::outline_tolerance ||
      (cells.rowwise() - high).maxCoeff() > meshes::outline_tolerance ||
      std::abs(signed_areas(whole.rest).sum() / lattice.area() - n_cells) >
        4. * meshes::outline_tolerance * (high - low).sum())
    return {};
  for (const Eigen::RowVector2d &line : {low, high})
    cells = beside(line.array()).select(line.replicate(cells.rows(), 1), cells);
  whole.n1     = static_cast<int>(high(0) - low(0));
  whole.n2     = static_cast<int>(high(1) - low(1));
  whole.corner = grain.origin + low * lattice.vectors;
  for (const int quads : {1, 2}) // of the sides of a cell
  {
    meshes::TriangleMesh in_order = meshes::coarse_sheet(whole.corner, lattice.vectors / quads,
                                                         quads * whole.n1, quads * whole.n2);
    in_order.material             = whole.rest.material;
    if (whole.rest.triangles == in_order.triangles &&
        whole.rest.vertices.rows() == in_order.vertices.rows() &&
        (whole.rest.vertices - in_order.vertices).cwiseAbs().maxCoeff() <=
          meshes::outline_tolerance * std::sqrt(lattice.area()))
    {
      whole.quads = quads;
      whole.rest  = in_order;
      return whole;
    }
  }
  if (!meshes::cloth_faults(cloth, "").empty())
    return {};
  whole.rest.vertices = (cells * lattice.vectors).rowwise() + grain.origin;
  return whole;
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
  given.is_sheet   = whole.has_value();
  this->method     = on_given(method, cell, given);
  if (whole)
  {
    const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, whole->n1, whole->n2);
    coarse.rest               = whole->rest;
    triangles                 = sheet.mesh.triangles;
    look = meshes::ClothLook::of(sheet.mesh.vertices, triangles, sheet.mesh.material);
    meshes::TriangleMesh over_sheet = whole->rest;
    if (const int quads = whole->quads; quads > 0)
      over_sheet = meshes::coarse_sheet(sheet.origin, sheet.lattice.vectors / quads,
                                        quads * whole->n1, quads * whole->n2);
    else
      over_sheet.vertices.rowwise() += sheet.origin - whole->corner;
    upsampler   = std::make_unique<Upsampler>(cell, over_sheet, sheet, this->method.options);
    description = "a sheet of " + std::to_string(whole->n1) + " x " + std::to_string(whole->n2) +
                  " cells, " + std::to_string(rest.n_triangles()) + " coarse triangles" +
                  (upsampler->is_aligned() ? " on their lattice" : "");
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
  const int n_panels           = meshes::panels_of(rest).count;
  description = std::to_string(n_panels) + (n_panels == 1 ? " panel" : " panels") + ", " +
                std::to_string(rest.n_triangles()) + " coarse triangles, cells cut along outlines";
  triangles = fine.sewn_triangles();
  look      = meshes::ClothLook::of(fine.rest.vertices, fine.rest.triangles, fine.rest.material);
  coarse_triangle = fine.coarse_triangle;
  upsampler       = std::make_unique<Upsampler>(
    localization::placed_garment(cell, coarse, fine, this->method.options));
}
} // namespace homespun::verification
