// SPDX-License-Identifier: MIT
#include "verification/bend/micro_deflection.h"

#include "homogenization/edges/cell_elements.h"
#include "meshes/plain/index.h"

namespace homespun::verification
{
using meshes::at;

MicroDeflection::MicroDeflection(const BendingCell &cell, const BendingLoad &load,
                                 const meshes::Sheet &sheet)
    : cell(cell)
    , load(load)
    , sheet(sheet)
{
  const meshes::Points &vertices = cell.cell.mesh.vertices;
  const Eigen::MatrixX2d fractions =
    (vertices.rowwise() - sheet.origin) * cell.cell.lattice.vectors.inverse();
  for (int axis = 0; axis < 2; ++axis)
  {
    on_far_side[at(axis)].assign(at(cell.torus.n_vertices), -1);
    for (int v = 0; v < cell.cell.mesh.n_vertices(); ++v)
      if (fractions(v, axis) > 1. - 2. * meshes::image_tolerance)
        on_far_side[at(axis)][at(cell.torus.vertex_of_original[at(v)])] = v;
  }
}

Eigen::Vector3d MicroDeflection::layers_at(const int vertex, const Eigen::Vector3d &curvature) const
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int side = 0; side < meshes::CellEdges::n_sides; ++side)
  {
    const homogenization::PlateEdge &edge = cell.known.edges->sides[at(side)];
    const int axis                        = meshes::axis_of_side(side);
    const int place                       = sheet.cell(vertex, axis);
    int its = sheet.cell_vertex(vertex), k = place;
    if (meshes::is_far_side(side))
    {
      k = (axis == 0 ? sheet.n1 : sheet.n2) - 1 - place;
      if (k < 0) // it closes the sheet, and belongs to the last cell
      {
        k   = 0;
        its = on_far_side[at(axis)][at(cell.torus.vertex_of_original[at(its)])];
      }
    }
    if (k >= edge.n_cells)
      continue;
    const auto &modes = load.is_clamped[at(side)] ? edge.clamped : edge.free;
    const auto row    = modes.row(k * cell.cell.mesh.n_vertices() + its);
    for (int a = 0; a < 3; ++a)
      sum += curvature(a) * row.segment<3>(3 * a).transpose();
  }
  return sum;
}

Eigen::Vector3d MicroDeflection::deflection(const Micro micro, const int vertex,
                                            const Eigen::Vector3d &curvature) const
{
  if (micro == Micro::none)
    return Eigen::Vector3d::Zero();
  const int glued    = cell.torus.vertex_of_original[at(sheet.cell_vertex(vertex))];
  Eigen::Vector3d w3 = cell.solved.deflection.middleRows<3>(3 * glued) * curvature;
  if (micro == Micro::edges && cell.known.edges)
    w3 += layers_at(vertex, curvature);
  return w3;
}
} // namespace homespun::verification
