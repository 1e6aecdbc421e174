// SPDX-License-Identifier: MIT
#include "verification/upsample/upsampled_cloth.h"

#include "localization/garment/placed_garment.h"
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
  int n1, n2, quads_per_cell;
  meshes::TriangleMesh rest;
};

/// The sheet that a coarse mesh is, its vertices where whole cells have them; nothing where it is
/// none.
std::optional<WholeCells> whole_cells(const meshes::Lattice &lattice, const ClothMesh &cloth,
                                      const meshes::Grain &grain)
{
  const meshes::TriangleMesh &rest = cloth.rest;
  if (grain.angle != 0. || rest.n_vertices() != cloth.n_vertices() ||
      rest.triangles != cloth.triangles)
    return {};
  // In cells along a1 and a2 from the lattice point that is given.
  meshes::Points cells(rest.n_vertices(), 2);
  for (int v = 0; v < rest.n_vertices(); ++v)
    cells.row(v) = lattice.fractional(rest.vertices.row(v) - grain.origin);
  const Eigen::RowVector2d low  = cells.colwise().minCoeff(),
                           size = cells.colwise().maxCoeff() - low;
  if (!(size.maxCoeff() < 1e4) || size.minCoeff() < 0.5)
    return {};
  const int n1    = static_cast<int>(std::lround(size(0))),
            n2    = static_cast<int>(std::lround(size(1)));
  const int quads = rest.n_triangles() == 8 * n1 * n2 ? 2 : 1;
  if ((quads * n1 + 1) * (quads * n2 + 1) != rest.n_vertices() ||
      2 * quads * quads * n1 * n2 != rest.n_triangles())
    return {};
  const Eigen::RowVector2d corner(std::round(low(0)), std::round(low(1)));
  meshes::TriangleMesh sheet = meshes::coarse_sheet(
    grain.origin + corner * lattice.vectors, lattice.vectors / quads, quads * n1, quads * n2);
  const double tolerance = meshes::outline_tolerance * std::sqrt(lattice.area());
  if (rest.triangles != sheet.triangles ||
      (rest.vertices - sheet.vertices).cwiseAbs().maxCoeff() > tolerance)
    return {};
  sheet.material.setZero(sheet.n_triangles());
  return WholeCells{n1, n2, quads, sheet};
}
} // namespace

UpsampledCloth::UpsampledCloth(const HomogenizedCell &cell, const ClothMesh &rest,
                               const meshes::Grain &grain, const localization::Method &method,
                               localization::GivenCloth given)
    : used(method)
    , coarse(rest)
{
  using Upsampler                            = localization::Upsampler<3, float>;
  const auto whole                           = whole_cells(cell.lattice, rest, grain);
  given.is_sheet                             = whole.has_value();
  const localization::GivenMethod its_method = on_given(method, cell, given);
  used                                       = its_method.used;
  left_out                                   = its_method.left_out;
  if (whole)
  {
    const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, whole->n1, whole->n2);
    coarse.rest               = whole->rest;
    description = "a sheet of " + std::to_string(whole->n1) + " x " + std::to_string(whole->n2) +
                  " cells, " + (whole->quads_per_cell == 1 ? "two" : "eight") +
                  " coarse triangles each";
    triangles       = sheet.mesh.triangles;
    look            = meshes::ClothLook::of(sheet.mesh.vertices, triangles, sheet.mesh.material);
    const int quads = whole->quads_per_cell;
    const meshes::TriangleMesh over_sheet = meshes::coarse_sheet(
      sheet.origin, sheet.lattice.vectors / quads, quads * whole->n1, quads * whole->n2);
    upsampler = std::make_unique<Upsampler>(cell, over_sheet, sheet, its_method.options);
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
    localization::placed_garment(cell, coarse, fine, its_method.options));
}
} // namespace homespun::verification
