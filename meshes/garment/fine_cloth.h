// SPDX-License-Identifier: MIT
// The resolved cloth of any garment: a periodic cell tiled over every panel at rest, cut along the
// outlines of the panels, with the same points on both sides of every seam.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "meshes/garment/fine_cloth_options.h"
#include "meshes/plain/lattice.h"
#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::meshes
{
/// Vertex v is an image of a vertex of the cell, or was made where an outline crosses; in both
/// cases its place in the coarse cloth is known, on an outline to round-off.
///
/// Slits and loops that touch come apart: a vertex on two sides of one is two vertices here.
struct FineCloth
{
  TriangleMesh rest; ///< (n,2) [m] in the rest coordinates of the panels; materials of the cell
  Lattice lattice;   ///< of the cell
  std::vector<Grain> grains; ///< of each panel
  Outline outline = Outline::clipped;
  Eigen::VectorXi panel;       ///< (n)
  Eigen::VectorXi cell_vertex; ///< (n) vertex of the cell it is an image of; −1: it was made
  Eigen::VectorXi
    cell_triangle; ///< (n) if it was made: the triangle of the cell that holds it; else −1
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>
    cell_weights; ///< (n,3) barycentric coordinates in it: chi is interpolated with them
  Eigen::VectorXi coarse_triangle; ///< (n)
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>
    coarse_weights; ///< (n,3) barycentric coordinates in it, at rest
  Eigen::VectorXd
    seam_distance; ///< (n) [m] at rest, within the panel's plane; infinite beyond seam_reach
  Eigen::VectorXi same_in_space; ///< (n) first vertex that a seam sews to this one, else itself
  int n_cut        = 0;  ///< triangles of the tiling that an outline crosses: clipped, or left out
  int n_slivers    = 0;  ///< pieces below 1e-12 of the cell's area that were left out
  double area_lost = 0.; ///< what the panels have and fine cloth and its holes have not [m^2]

  int n_vertices() const
  {
    return rest.n_vertices();
  }

  /// Triangles by the first of all vertices that coincide in space: watertight along the seams.
  Triangles sewn_triangles() const;
};

/// Tiles a cell over all panels. Holes of the cell are holes of the fine cloth, cut like it.
///
/// Work and memory go with the panels' bounding boxes in lattice directions.
/// @param cell_mesh periodic modulo the lattice, its outline the parallelogram of the lattice
///   (tile())
/// @param cloth coarse cloth; its outlines are those of the panels
/// @throws BadInput where the cloth has faults, the number of grains is neither 1 nor that of the
///   panels, a panel overlaps itself at rest, or the cell cannot be tiled
FineCloth fine_cloth(const TriangleMesh &cell_mesh, const Lattice &lattice, const ClothMesh &cloth,
                     const FineClothOptions &options = {});
} // namespace homespun::meshes
