// SPDX-License-Identifier: MIT
// One panel of a fine cloth: the sheet of cells that covers it, cut along its outline. Private to
// fine_cloth.
//
// Coordinates are local: they count from a lattice point next to the panel, so that no digits are
// lost where the rest coordinates are large.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "meshes/cloth/seams.h"
#include "meshes/garment/cut_mesh.h"
#include "meshes/garment/fine_cloth_options.h"
#include "meshes/plain/index.h"
#include "meshes/plain/point_location.h"
#include "meshes/plain/sheet.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

namespace homespun::meshes
{
struct FinePanel
{
  int index = 0;
  Grain grain;
  Eigen::RowVector2d base;                 ///< local zero in rest coordinates [m]
  std::vector<int> triangles;              ///< of the coarse cloth
  std::vector<Side> outline;               ///< open sides at rest; the edges of `cut`
  double area = 0.;                        ///< [m^2]
  std::unique_ptr<PointLocation> location; ///< in the coarse triangles, local coordinates
  Sheet sheet;                             ///< vertices in local coordinates
  std::vector<int> whole;                  ///< triangles of the sheet away from the outline, inside
  std::vector<int>
    cut_vertex; ///< (vertices of the sheet) vertex of `cut`, −1: not near the outline
  std::vector<int> sheet_vertex; ///< of the first vertices of `cut`
  std::unique_ptr<CutMesh> cut;  ///< what is near the outline, on both sides of it

  /// The vertex of `cut` of a corner, see KeptTriangle; −1: it is away from the outline.
  int cut_vertex_of(int corner) const;
};

/// A triangle that stays in the fine cloth.
struct KeptTriangle
{
  std::array<int, 3>
    corners;  ///< vertices of the sheet; beyond their number, those of `cut` that were made
  int parent; ///< triangle of the sheet
};

/// Covers the panels and cuts along their outlines; both sides are still there.
/// @throws BadInput where a panel spans too many cells, or its outline is at odds with itself
std::vector<FinePanel> fine_panels(const TriangleMesh &cell_mesh, const Lattice &lattice,
                                   const ClothMesh &cloth, const Panels &membership,
                                   const std::vector<Grain> &grains);

/// What stays of a panel.
struct KeptTriangles
{
  std::vector<KeptTriangle> triangles;
  int n_cut     = 0; ///< triangles of the sheet that the outline crosses
  int n_slivers = 0; ///< pieces left out for being too small
};
KeptTriangles kept_triangles(const FinePanel &panel, Outline outline, double cell_area);

/// Triangles around a vertex of the outline that reach each other without crossing it share a
/// vertex, others do not: loops that touch and slits come apart.
/// @return for each triangle and corner the number of its fan around that vertex, from 0
std::vector<std::array<int, 3>> fans_of(const FinePanel &panel,
                                        const std::vector<KeptTriangle> &kept);
} // namespace homespun::meshes
