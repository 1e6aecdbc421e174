// SPDX-License-Identifier: MIT
// The sides of a drawn cell, matched: its lattice, its mesh with images exactly a lattice vector
// apart, and what of its outline has no image. A rim of a hole has none, and neither has a side
// that was not meshed like the opposite one: those two are told apart here.
#pragma once

#include "homogenization/cell/cell_keys.h"
#include "meshes/plain/lattice.h"
#include "meshes/plain/mesh_fault.h"
#include "meshes/plain/triangle_mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace homespun::homogenization
{
/// How far images may lie apart [m]: the tolerance that was given; else 1e-7 of the shorter lattice
/// vector, or four times the rounding, at most 1e-4 of it.
double image_gap(const SideRules &rules, const meshes::Lattice &lattice);

/// A cell whose sides are matched.
struct MatchedCell
{
  meshes::Lattice lattice;   ///< fitted to the images
  meshes::TriangleMesh mesh; ///< as it was where images agree to round-off; else each class of
                             ///< images at its mean
  std::vector<CurvedSide> curved_sides;
  double largest_move = 0.; ///< of a vertex [m]
  int moved_vertex    = -1; ///< the one that moved most
  bool cuts_holes     = false;
  /// Lattice offsets between edges of the outline that are images.
  std::vector<Eigen::RowVector2i> matched_offsets;
  std::vector<meshes::MeshFault> faults; ///< none: the cell is periodic
  /// Of another area, of which the drawing may be, too; of a cell with faults, under which it fits.
  std::vector<meshes::Lattice> alternatives;
};

/// Matches the sides of a cell by its lattice.
///
/// Between two matched points an edge of the outline without an image belongs to a rim of the glued
/// mesh. A rim that crosses a side is the rim of a hole where its mean width, its area over half of
/// its length, is at least half of its mean edge, and where it opens by more than 30 degrees at
/// each point in which it passes to the opposite side; else the sides are not meshed alike.
/// @param mesh sound, as placed_faults_of() has it [m]
/// @param name of the mesh, put before each message
MatchedCell match_sides(const meshes::TriangleMesh &mesh,
                        const std::vector<CurvedSide> &curved_sides, const meshes::Lattice &lattice,
                        const SideRules &rules, const std::string &name);
} // namespace homespun::homogenization
