// SPDX-License-Identifier: MIT
#include "verification/bend/bent_sheet.h"

#include "meshes/plain/index.h"
#include "verification/bend/micro_deflection.h"
#include "verification/record/timing.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace homespun::verification
{
using homogenization::ThinPlate;
using meshes::at;

namespace
{
/// Of a deflection w: the normal of small slopes is (−w,1, −w,2, 1).
void set_state(BentState &state, const int v, const Eigen::Vector3d &w_and_gradient)
{
  state.row(v) << 0., 0., w_and_gradient(0), -w_and_gradient(1), -w_and_gradient(2), 0.;
}

/// A point in a triangle of coarse_sheet().
struct CoarsePoint
{
  int triangle;
  Eigen::Vector3d barycentric;
};

/// The triangles that hold a point: where some meet all of them, first the one below the diagonal
/// of the quad at its upper right; rounding must not choose.
/// @param fraction on the sheet @param n quads along a side
std::vector<CoarsePoint> coarse_points(const Eigen::RowVector2d &fraction, const int n)
{
  constexpr double snap          = ThinPlate::snap;
  const Eigen::RowVector2d place = fraction * n;
  const auto quads               = [&](const int axis)
  {
    const auto quad = [&](const double at)
    { return std::clamp(static_cast<int>(std::floor(at)), 0, n - 1); };
    std::vector<int> all = {quad(place(axis) + snap)};
    if (const int other = quad(place(axis) - snap); other != all.front())
      all.push_back(other);
    return all;
  };
  std::vector<CoarsePoint> points;
  for (const int j : quads(1))
    for (const int i : quads(0))
    {
      const double f = place(0) - i, g = place(1) - j;
      if (f + snap >= g) // below the diagonal: corners (0,0), (1,0), (1,1)
        points.push_back({2 * (j * n + i), {1. - f, f - g, g}});
      if (g + snap >= f) // corners (0,0), (1,1), (0,1)
        points.push_back({2 * (j * n + i) + 1, {1. - g, f, g - f}});
    }
  return points;
}

/// The homogenized plate of a sheet on a mesh of n x n quads.
struct MacroPlate
{
  MacroPlate(const BendingCell &cell, const meshes::Sheet &sheet, const int n)
      : sheet(sheet)
      , n(n)
      , plate(sheet, meshes::coarse_sheet(sheet.origin, sheet.sides() / n, n, n),
              {cell.solved.stiffness})
  {
  }

  /// Where triangles meet the mean of theirs, which are of one size.
  ThinPlate::Values values(const Eigen::RowVector2d &fraction, const Eigen::VectorXd &w) const
  {
    const std::vector<CoarsePoint> points = coarse_points(fraction, n);
    ThinPlate::Values sum                 = ThinPlate::Values::Zero();
    for (const CoarsePoint &point : points)
      sum += plate.plate.values(point.triangle, point.barycentric, w);
    return sum / static_cast<double>(points.size());
  }

  const meshes::Sheet &sheet;
  const int n;
  const PlateSheet plate;
};

/// A homogenized deflection on the fine vertices.
BentState upsampled(const MicroDeflection &of_cell, const Micro micro, const MacroPlate &macro,
                    const Eigen::VectorXd &w)
{
  const meshes::Sheet &sheet = macro.sheet;
  BentState state(sheet.mesh.n_vertices(), 6);
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
  {
    const ThinPlate::Values values = macro.values(sheet.fraction(sheet.mesh.vertices.row(v)), w);
    set_state(state, v, values.head<3>() + of_cell.deflection(micro, v, values.tail<3>()));
  }
  return state;
}

/// Two flat triangles per cell through a homogenized deflection.
BentState flat(const MacroPlate &macro, const Eigen::VectorXd &w)
{
  const meshes::Points corners = coarse_mesh(macro.sheet).vertices;
  Eigen::MatrixX3d raised(corners.rows(), 3);
  for (int v = 0; v < static_cast<int>(corners.rows()); ++v)
    raised.row(v) << corners.row(v), macro.values(macro.sheet.fraction(corners.row(v)), w)(0);
  BentState state = flat_triangles(macro.sheet, raised);
  for (int v = 0; v < static_cast<int>(state.rows()); ++v)
    set_state(state, v, {state(v, 2), -state(v, 3) / state(v, 5), -state(v, 4) / state(v, 5)});
  return state;
}
} // namespace

bool has_edges(const std::string &method)
{
  return method == "affine+edges" || method == "full";
}

Eigen::VectorXd position_errors(const BentState &difference)
{
  return difference.leftCols<3>().rowwise().norm();
}

Eigen::VectorXd normal_errors(const BentState &difference)
{
  return difference.rightCols<3>().rowwise().norm();
}

BendingError mean_of(const BentState &difference)
{
  return {position_errors(difference).mean(), normal_errors(difference).mean()};
}

meshes::TriangleMesh coarse_mesh(const meshes::Sheet &sheet)
{
  return meshes::coarse_sheet(sheet.origin, sheet.lattice.vectors, sheet.n1, sheet.n2);
}

BentState flat_triangles(const meshes::Sheet &sheet, const Eigen::MatrixX3d &corners)
{
  const meshes::TriangleMesh coarse = coarse_mesh(sheet);
  BentState state(sheet.mesh.n_vertices(), 6);
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
  {
    const CoarsePoint point =
      coarse_points(sheet.fraction(sheet.mesh.vertices.row(v)), sheet.n1).front();
    Eigen::Matrix3d its;
    for (int k = 0; k < 3; ++k)
      its.row(k) = corners.row(coarse.triangles(point.triangle, k));
    const Eigen::RowVector3d a = its.row(1) - its.row(0), b = its.row(2) - its.row(0);
    state.row(v) << point.barycentric.transpose() * its, a.cross(b);
  }
  return state;
}

int macro_quads_per_cell(const int n_cells)
{
  return 2 * ((80 + 2 * n_cells - 1) / (2 * n_cells));
}

BentSheet::BentSheet(const BendingCell &cell, const BendingLoad &load, const int n,
                     const int quads_per_cell)
    : sheet(meshes::tile(cell.cell.mesh, cell.cell.lattice, n, n))
{
  BentState reference(sheet.mesh.n_vertices(), 6);
  seconds_reference = seconds_of(
    [&]()
    {
      const PlateSheet fine(sheet, sheet.mesh, cell.bending_stiffness_of_phase);
      const Eigen::VectorXd resolved = fine.deflection(load, 1.);
      n_dofs                         = static_cast<unsigned long>(fine.plate.n_dofs());
      for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
        set_state(reference, v, resolved.segment<3>(3 * v));
    });
  // A pressure acts on the material, not on holes.
  const double covered = meshes::signed_areas(cell.cell.mesh).sum() / cell.cell.lattice.area();
  const MicroDeflection of_cell(cell, load, sheet);
  const auto upsample = [&](const int n_quads)
  {
    const MacroPlate macro(cell, sheet, n_quads);
    n_macro_triangles               = 2 * n_quads * n_quads;
    const Eigen::VectorXd w0        = macro.plate.deflection(load, covered);
    const double curvature          = macro.plate.mean_curvature(w0);
    std::vector<Eigen::VectorXd> ws = {w0};
    if (cell.known.edges)
      ws.push_back(w0 + macro.plate.correction(load, *cell.known.edges, w0));
    std::vector<std::pair<std::size_t, BentState>> states;
    for (std::size_t k = 0; k < ws.size(); ++k)
    {
      states.emplace_back(2 * k, upsampled(of_cell, Micro::none, macro, ws[k]));
      states.emplace_back(2 * k + 1,
                          upsampled(of_cell, k == 0 ? Micro::cell : Micro::edges, macro, ws[k]));
    }
    states.emplace_back(bending_methods.size() - 1, flat(macro, w0));
    for (const auto &[method, state] : states)
    {
      const BentState error     = (state - reference) / curvature;
      const BendingError before = error_of_method[method].size() > 0
                                    ? mean_of(error_of_method[method])
                                    : BendingError(),
                         now    = mean_of(error);
      of_macro_mesh[method]     = {std::abs(now.position - before.position),
                                   std::abs(now.normal - before.normal)};
      error_of_method[method]   = error;
    }
    unit_load  = 1. / curvature;
    deflection = reference.col(2).cwiseAbs().mean() / curvature;
  };
  seconds = seconds_of(
    [&]()
    {
      for (const int n_quads : {n * quads_per_cell / 2, n * quads_per_cell})
        upsample(n_quads);
    });
}
} // namespace homespun::verification
