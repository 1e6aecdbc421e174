// SPDX-License-Identifier: MIT
// Which lattices a drawing of a cell may have, by its outermost points or by its outline alone.
// None of them looks at holes: whoever asks tries whether sides match.
#pragma once

#include "meshes/plain/lattice.h"

#include <vector>

namespace homespun::meshes
{
/// A polygon around a drawing that tiles the plane by translations, and these.
struct Frame
{
  Lattice lattice; ///< a1 nearest to the x axis and along it, a1 x a2 > 0
  /// Translations of each side onto the opposite one, in lattice vectors: two or three.
  std::vector<Eigen::RowVector2i> pairs;
};

/// The convex hull, corners flatter than the tolerance left out, where it has four or six corners
/// and is centrally symmetric; then the bounding box.
/// @param tolerance [m]
std::vector<Frame> frames_of(const TriangleMesh &mesh, double tolerance);

/// The parallelogram that the hull becomes when its flattest corners are left out, where it is one
/// but for a twentieth of its size: what a drawing with a wrong point was meant to be.
/// @return none or one
std::vector<Frame> frame_meant(const TriangleMesh &mesh);

/// The lattices under which the outline as a whole matches, without a hole: those of its
/// factorizations A B A^-1 B^-1 and A B C A^-1 B^-1 C^-1 whose ends are corners (D. Beauquier and
/// M. Nivat, *On translating one polyomino to tile the plane*, Discrete Comput. Geom. 6, 1991).
/// Corners lie on corners, so that a brick bond of a rectangle is none of them.
/// @param tolerance [m]
/// @return each once, whatever its basis: shortest vectors, ordered as those of a Frame
std::vector<Lattice> lattices_of_outline(const TriangleMesh &mesh, double tolerance);

/// The shortest basis of a lattice (Lagrange, Gauss), ordered as that of a Frame.
Lattice reduced(const Lattice &lattice);

/// Whether two bases span the same lattice.
bool is_same_lattice(const Lattice &one, const Lattice &other);
} // namespace homespun::meshes
