// SPDX-License-Identifier: MIT
// Where the vertices of a cell lie in a coarse mesh that is the lattice of a sheet, or that lattice
// with each side cut in half: the same in every cell. Halved, the two triangles of a cell are cut
// into four by the middles of their sides, and stand for these with six nodes. Private to
// upsampler.
#pragma once

#include "meshes/plain/sheet.h"
#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <array>

namespace homespun::localization
{
/// How often a coarse mesh cuts the sides of the cells of a sheet: it is meshes::coarse_sheet()
/// with 1 or 2 quads per side of a cell; 0 where it is neither.
int quads_per_cell(const meshes::Sheet &sheet, const meshes::TriangleMesh &coarse);

/// The two triangles of a cell: below and above the diagonal from its origin.
enum class Half
{
  below,
  above
};

/// Coarse vertices at the corners of a triangle of cell (i, j), and of two quads per side those at
/// the middles of its sides 01, 12, 02.
/// @param quads per side of a cell, 1 or 2
/// @param n1 cells of the sheet along axis 1
std::array<int, 6> nodes_of_triangle(int quads, int n1, int i, int j, Half half);

/// Barycentric coordinates of a vertex of cell (0,0) in the triangle of that cell that holds it.
Eigen::Vector3d weights_in_cell(const meshes::Sheet &sheet, int vertex);

/// What the middles of the sides 01, 12, 02 of a triangle contribute at a point of it: functions
/// that are 1 at one of them, 0 at all other nodes, and linear between.
Eigen::Vector3d hats(const Eigen::Vector3d &weights);
} // namespace homespun::localization
