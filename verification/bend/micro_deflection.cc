// SPDX-License-Identifier: MIT
#include "verification/bend/micro_deflection.h"

#include "homogenization/edges/cell_elements.h"
#include "meshes/plain/index.h"

#include <cmath>

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
    for (int end = 0; end < 2; ++end)
    {
      on_end[at(axis)][at(end)].assign(at(cell.torus.n_vertices), -1);
      for (int v = 0; v < cell.cell.mesh.n_vertices(); ++v)
        if (std::abs(fractions(v, axis) - end) < 2. * meshes::image_tolerance)
          on_end[at(axis)][at(end)][at(cell.torus.vertex_of_original[at(v)])] = v;
    }
}

Eigen::Vector3d MicroDeflection::layers_at(const int vertex, const Eigen::Vector3d &curvature) const
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const int drawn     = sheet.cell_vertex(vertex);
  const int glued     = cell.torus.vertex_of_original[at(drawn)];
  for (int side = 0; side < meshes::CellEdges::n_sides; ++side)
  {
    const homogenization::PlateEdge &edge = cell.known.edges->sides[at(side)];
    const int axis                        = meshes::axis_of_side(side);
    // On a line between cells a vertex is the first one of the next cell, whichever of its images
    // is drawn first; but what closes the sheet is the last one of the last cell.
    const int n = axis == 0 ? sheet.n1 : sheet.n2, place = sheet.cell(vertex, axis);
    const bool ends = meshes::is_far_side(side) && place == n;
    const int k     = ends ? 0 : meshes::is_far_side(side) ? n - 1 - place : place;
    if (k >= edge.n_cells)
      continue;
    const int image   = on_end[at(axis)][ends ? 1 : 0][at(glued)];
    const auto &modes = load.is_clamped[at(side)] ? edge.clamped : edge.free;
    const auto row    = modes.row(k * cell.cell.mesh.n_vertices() + (image < 0 ? drawn : image));
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
