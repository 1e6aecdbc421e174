// SPDX-License-Identifier: MIT
#include "verification/converge/bent_sheet.h"

#include "meshes/plain/index.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
using homogenization::ThinPlate;
using meshes::at;

namespace
{
/// A point in a triangle of coarse_sheet().
struct CoarsePoint
{
  int triangle;
  Eigen::Vector3d barycentric;
};

/// @param fraction on the sheet @param n quads along a side
CoarsePoint coarse_point(const Eigen::RowVector2d &fraction, const int n)
{
  const Eigen::RowVector2d place = fraction * n;
  const int i                    = std::clamp(static_cast<int>(place(0)), 0, n - 1),
            j                    = std::clamp(static_cast<int>(place(1)), 0, n - 1);
  const double f = place(0) - i, g = place(1) - j;
  if (f >= g) // below the diagonal: corners (0,0), (1,0), (1,1)
    return {2 * (j * n + i), {1. - f, f - g, g}};
  return {2 * (j * n + i) + 1, {1. - g, f, g - f}}; // corners (0,0), (1,1), (0,1)
}

/// Deflections at the vertices of a sheet and their gradients, (n,3) in w, w,1, w,2.
using Surface = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// A homogenized deflection on the fine vertices, with w3 of the cell or without.
Surface upsampled(const BendingCell &cell, const meshes::Sheet &sheet, const ThinPlate &coarse,
                  const Eigen::VectorXd &deflection, const bool with_fluctuation)
{
  const int n = static_cast<int>(std::lround(std::sqrt(coarse.mesh.triangles.size() / 2.)));
  Surface surface(sheet.mesh.n_vertices(), 3);
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
  {
    const CoarsePoint point        = coarse_point(sheet.fraction(sheet.mesh.vertices.row(v)), n);
    const ThinPlate::Values values = coarse.values(point.triangle, point.barycentric, deflection);
    surface.row(v)                 = values.head<3>().transpose();
    if (!with_fluctuation)
      continue;
    const int of_cell           = cell.torus.vertex_of_original[at(sheet.cell_vertex(v))];
    const Eigen::Vector3d kappa = values.tail<3>();
    surface.row(v) += (cell.solved.deflection.middleRows<3>(3 * of_cell) * kappa).transpose();
  }
  return surface;
}

BendingError error_of(const Surface &surface, const Surface &reference, const double curvature,
                      const double side)
{
  const Surface difference = surface - reference;
  return {difference.col(0).cwiseAbs().mean() / (curvature * side * side),
          difference.rightCols<2>().rowwise().norm().mean() / (curvature * side)};
}

/// The errors of the homogenized plate on a mesh of n_quads x n_quads quads.
std::array<BendingError, bending_methods.size()>
errors_on(const BendingCell &cell, const BendingLoad &load, const meshes::Sheet &sheet,
          const int n_quads, const Surface &reference)
{
  const PlateSheet coarse(
    sheet, meshes::coarse_sheet(sheet.origin, sheet.sides() / n_quads, n_quads, n_quads),
    {cell.solved.stiffness});
  // A pressure acts on the material, not on holes.
  const double covered     = meshes::signed_areas(cell.cell.mesh).sum() / cell.cell.lattice.area();
  const Eigen::VectorXd w0 = coarse.deflection(load, covered);
  const double curvature = coarse.mean_curvature(w0), side = std::sqrt(cell.cell.lattice.area());
  std::vector<Eigen::VectorXd> deflections = {w0};
  if (cell.known.edges)
    deflections.push_back(w0 + coarse.correction(load, *cell.known.edges, w0));
  std::array<BendingError, bending_methods.size()> errors = {};
  for (std::size_t k = 0; k < deflections.size(); ++k)
    for (const bool with_fluctuation : {false, true})
      errors[2 * k + (with_fluctuation ? 1 : 0)] =
        error_of(upsampled(cell, sheet, coarse.plate, deflections[k], with_fluctuation), reference,
                 curvature, side);
  return errors;
}
} // namespace

BendingCell::BendingCell(const homogenization::UnitCell &cell)
    : cell(cell)
    , bending_stiffness_of_phase(cell.bending_stiffness_of_phase())
    , torus(homogenization::glued(cell.mesh, cell.lattice))
    , solved(homogenization::solve_plate_cell(torus, bending_stiffness_of_phase))
    , known(known_edges_of_plate(cell))
{
}

bool BendingCell::is_of_one_material() const
{
  // The slopes across the sides of the mesh.
  return solved.deflection.bottomRows(torus.n_edges()).cwiseAbs().maxCoeff() <
         1e-9 * std::sqrt(cell.lattice.area());
}

BentSheetErrors bending_errors(const BendingCell &cell, const BendingLoad &load, const int n,
                               const int quads_per_cell)
{
  const meshes::Sheet sheet = meshes::tile(cell.cell.mesh, cell.cell.lattice, n, n);
  const PlateSheet fine(sheet, sheet.mesh, cell.bending_stiffness_of_phase);
  const Eigen::VectorXd resolved = fine.deflection(load, 1.);
  Surface reference(sheet.mesh.n_vertices(), 3);
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
    reference.row(v) = resolved.segment<3>(3 * v).transpose();

  BentSheetErrors errors;
  errors.n_dofs = static_cast<unsigned long>(fine.plate.n_dofs());
  double before = 0.;
  for (const int n_quads : {n * quads_per_cell / 2, n * quads_per_cell})
  {
    errors.of_method     = errors_on(cell, load, sheet, n_quads, reference);
    const double now     = errors.of_method[cell.known.edges ? 3 : 1].position;
    errors.of_macro_mesh = std::abs(now - before);
    before               = now;
  }
  return errors;
}
} // namespace homespun::verification
