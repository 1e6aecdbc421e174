// SPDX-License-Identifier: MIT
#include "verification/bend/bent_cloth.h"

#include "homogenization/edges/cell_elements.h"
#include "meshes/plain/index.h"
#include "verification/record/timing.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace homespun::verification
{
using meshes::at;

namespace
{
ClothStiffness stiffness_of_phases(const BendingCell &cell)
{
  return {cell.cell.stiffness_of_phase(), cell.bending_stiffness_of_phase};
}

/// C^H and D^H.
ClothStiffness homogenized_stiffness(const BendingCell &cell)
{
  return {{homogenization::solve_cell(homogenization::CellElements(cell.cell, 2)).stiffness},
          {cell.solved.stiffness}};
}

/// A homogenized cloth at its vertices, what the cell adds along its normals.
BentState upsampled(const MicroDeflection &of_cell, const Micro micro, const ClothSheet &cloth)
{
  const ClothSurface surface = cloth.surface();
  BentState state(cloth.mesh.n_vertices(), 6);
  state << cloth.mesh.positions, surface.normals;
  for (int v = 0; micro != Micro::none && v < cloth.mesh.n_vertices(); ++v)
  {
    const Eigen::Vector3d w3 = of_cell.deflection(micro, v, surface.curvature.row(v).transpose());
    const Eigen::RowVector3d normal = surface.normals.row(v),
                             t1     = surface.tangents[0].row(v) + w3(1) * normal,
                             t2     = surface.tangents[1].row(v) + w3(2) * normal;
    state.row(v) << cloth.mesh.positions.row(v) + w3(0) * normal, t1.cross(t2).normalized();
  }
  return state;
}

/// Two flat triangles per cell through a homogenized cloth.
BentState flat(const meshes::Sheet &sheet, const ClothSheet &cloth)
{
  const int n = sheet.n1;
  Eigen::MatrixX3d corners((n + 1) * (n + 1), 3); // of coarse_mesh()
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d place = n * sheet.fraction(sheet.mesh.vertices.row(v)),
                             next  = place.array().round();
    if ((place - next).norm() < 2. * n * meshes::image_tolerance)
      corners.row(static_cast<int>(next(1)) * (n + 1) + static_cast<int>(next(0))) =
        cloth.mesh.positions.row(v);
  }
  BentState state = flat_triangles(sheet, corners);
  state.rightCols<3>().rowwise().normalize();
  return state;
}

BentState state_of(const ClothSheet &cloth)
{
  BentState state(cloth.mesh.n_vertices(), 6);
  state << cloth.mesh.positions, cloth.surface().normals;
  return state;
}
} // namespace

std::string why_no_large_turns(const homogenization::UnitCell &cell, const BendingLoad &load)
{
  const double area = cell.lattice.area();
  if (meshes::signed_areas(cell.mesh).sum() < (1. - 1e-6) * area)
    return "the cell has holes, which the triangles of the homogenized sheet do not fill";
  if (load.by == BentBy::moment)
    return "a moment on an edge is no dead load";
  if (std::count(load.is_clamped.begin(), load.is_clamped.end(), true) > 1)
    return "clamps that keep their distance stretch the sheet";
  return {};
}

BentCloth::BentCloth(const BendingCell &cell, const BendingLoad &load, const int n)
    : sheet(meshes::tile(cell.cell.mesh, cell.cell.lattice, n, n))
    , resolved(sheet, sheet.mesh.material, stiffness_of_phases(cell), load)
    , homogenized(sheet, Eigen::VectorXi::Zero(sheet.mesh.n_triangles()),
                  homogenized_stiffness(cell), load)
    , turned(homogenized)
    , cell(cell)
    , of_cell(cell, load, sheet)
{
}

BentByTurns BentCloth::at(const double pressure)
{
  BentByTurns bent;
  std::vector<std::pair<std::size_t, BentState>> states;
  bent.seconds = seconds_of(
    [&]()
    {
      homogenized.bend(pressure);
      bent.curvature                      = homogenized.mean_curvature();
      std::vector<const ClothSheet *> all = {&homogenized};
      if (cell.known.edges)
      {
        // K of the sheet that is not turned, as in linear theory; times by how much the turn has
        // changed the moment of the clamp, since the lever arms have.
        const Eigen::VectorXd curvatures = homogenized.curvature_of_clamps();
        turned.mesh.positions            = homogenized.mesh.positions;
        for (const ClothSheet *const last : {&homogenized, &turned})
        {
          const double change = last->moment_of_clamps() / homogenized.moment_of_clamps();
          turned.turn_clamps(*cell.known.edges, change * curvatures);
          turned.bend(pressure);
        }
        all.push_back(&turned);
      }
      for (std::size_t k = 0; k < all.size(); ++k)
      {
        states.emplace_back(2 * k, upsampled(of_cell, Micro::none, *all[k]));
        states.emplace_back(2 * k + 1,
                            upsampled(of_cell, k == 0 ? Micro::cell : Micro::edges, *all[k]));
      }
      states.emplace_back(bending_methods.size() - 1, flat(sheet, homogenized));
    });
  BentState reference;
  bent.seconds_reference = seconds_of(
    [&]()
    {
      resolved.bend(pressure);
      reference = state_of(resolved);
    });
  bent.deflection = reference.col(2).cwiseAbs().mean();
  for (const auto &[method, state] : states)
    bent.error_of_method[method] = state - reference;
  return bent;
}
} // namespace homespun::verification
