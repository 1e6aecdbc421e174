// SPDX-License-Identifier: MIT
// Where the vertices of a cell lie in a coarse mesh that is the lattice of a sheet, or that lattice
// with each side cut in half: the same in every cell. Private to upsampler.
#pragma once

#include "meshes/plain/sheet.h"
#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::localization
{
/// How often a coarse mesh cuts the sides of the cells of a sheet: it is meshes::coarse_sheet()
/// with 1 or 2 quads per side of a cell; 0 where it is neither.
int quads_per_cell(const meshes::Sheet &sheet, const meshes::TriangleMesh &coarse);

/// A coarse triangle of a cell, and those vertices of the cell's block that lie in it.
struct CellTriangle
{
  meshes::QuadHalf in_cell;
  int begin, end;
};

/// The triangles of a cell in the order of its vertices: two, or of two quads per side eight.
std::vector<CellTriangle> triangles_of_cell(const meshes::Sheet &sheet, int quads);

/// The index in the coarse mesh of a triangle of cell (i, j).
/// @param n1 cells of the sheet along axis 1
int coarse_triangle(const meshes::QuadHalf &in_cell, int quads, int n1, int i, int j);

/// Barycentric coordinates of a vertex of cell (0,0) in a triangle of that cell.
Eigen::Vector3d weights_in(const meshes::QuadHalf &in_cell, int quads, const meshes::Sheet &sheet,
                           int vertex);
} // namespace homespun::localization
