// SPDX-License-Identifier: MIT
// The lattice that repeats a unit cell, and the one question that periodicity asks of it: which
// points are images of each other? Everything periodic in homespun (constraints, tiled sheets,
// anchors) goes through match_images(), so that there is one tolerance and one place to be right.
#pragma once

#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace homespun::meshes
{
/// Two lattice vectors a1, a2; the cell repeats at x + n1 a1 + n2 a2.
struct Lattice
{
  Eigen::Matrix2d vectors = Eigen::Matrix2d::Identity(); ///< row 0: a1, row 1: a2 [m]
  /// Whether each line along a1 or along a2 meets a hole of the cell: what of its outline has no
  /// image is then the rim of one. Such a cell is periodic, but no sheet can be cut from its cloth.
  bool cuts_holes = false;

  /// |a1 x a2|, the area of the cell Y [m^2].
  double area() const;

  /// Coordinates (f1, f2) of a point, x = f1 a1 + f2 a2.
  Eigen::RowVector2d fractional(const Eigen::RowVector2d &point) const;

  /// The difference of two points, brought to its image nearest to zero in fractional coordinates.
  Eigen::RowVector2d shortest(const Eigen::RowVector2d &difference) const;
};

/// How far two lattice images may lie apart, as a part of the cell size sqrt(|Y|). Gmsh writes 16
/// digits, older tools 8: 1e-7 accepts both and still tells neighbours apart in a mesh with a
/// thousand vertices along a side.
constexpr double image_tolerance = 1e-7;

/// The classes of points that are images of each other.
struct ImageClasses
{
  std::vector<int> representative;              ///< (n) lowest index in the class
  Eigen::Matrix<int, Eigen::Dynamic, 2> offset; ///< (n,2) x − x_representative in lattice vectors
  std::vector<int> size;                        ///< (n) number of points in the class
};

/// Sorts points into classes modulo the lattice, x_i = x_r + n1 a1 + n2 a2 within the tolerance.
///
/// A hash over the torus, O(n). Every point is compared with its representative, never along a
/// chain, so that corners, which belong to two pairs of sides, end in one class.
/// @param points (n,2) [m]
/// @param relative_tolerance of the distance between images, in units of sqrt(|Y|)
ImageClasses match_images(const Points &points, const Lattice &lattice,
                          double relative_tolerance = image_tolerance);

/// The outer loop of a mesh: the boundary loop that encloses the largest area.
std::vector<int> outline(const TriangleMesh &mesh);

/// The sides of a cell: its outline; where that cuts holes, what of the boundary has images.
struct Sides
{
  std::vector<int> vertices;
  std::vector<std::array<int, 2>> edges; ///< directed, the mesh on their left
};

Sides sides_of(const TriangleMesh &mesh, const Lattice &lattice);

/// @throws BadInput where no sheet can be cut from the cloth of the cell, with the reason
void require_sheets(const Lattice &lattice);

/// The faults that make a cell mesh not periodic: vertices of the outline without an image (with
/// the nearest candidate and the gap), vertices anywhere that are closer than the tolerance and
/// count as one, an outline that does not enclose |Y|, triangles that overlap.
std::vector<std::string> periodicity_faults(const TriangleMesh &mesh, const Lattice &lattice,
                                            const std::string &name,
                                            double relative_tolerance = image_tolerance);

/// The same with their places.
std::vector<MeshFault> placed_periodicity_faults(const TriangleMesh &mesh, const Lattice &lattice,
                                                 const std::string &name,
                                                 double relative_tolerance = image_tolerance);

/// What to say of a vertex of the outline that has no periodic image: the nearest candidate, the
/// gap, the remedy.
/// @param loop vertices of the outline, or of a part of it
/// @param points (n,2) where they lie [m]
/// @param i its place in the loop
std::string text_of_unmatched(const std::vector<int> &loop, const Points &points,
                              const Lattice &lattice, Eigen::Index i, double relative_tolerance);

/// The vertex at which characteristic displacements are anchored: of all vertices the one with the
/// most images on the sides (the corners of a parallelogram), of those the one where both lattice
/// vectors begin, and where the outline is not their parallelogram the lowest-left.
int anchor_vertex(const TriangleMesh &mesh, const Lattice &lattice);

/// The corner at which a cell that makes sheets with straight edges begins [m].
/// @throws BadInput as require_sheets(), and where a vertex lies outside of the parallelogram of
/// the
///   lattice vectors there
Eigen::RowVector2d corner_of_parallelogram(const TriangleMesh &mesh, const Lattice &lattice);
} // namespace homespun::meshes
