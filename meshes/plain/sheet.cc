// SPDX-License-Identifier: MIT
#include "meshes/plain/sheet.h"

#include "meshes/plain/errors.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <vector>

namespace homespun::meshes
{
Eigen::RowVector2d Sheet::fraction(const Eigen::RowVector2d &point) const
{
  return lattice.fractional(point - origin).cwiseQuotient(Eigen::RowVector2d(n1, n2));
}

Eigen::Matrix2d Sheet::sides() const
{
  return Eigen::Vector2d(n1, n2).asDiagonal() * lattice.vectors;
}

namespace
{
/// The vertices of a cell as nodes of the lattice cell that holds them in [0,1)^2, plus whole
/// cells.
struct CellNodes
{
  std::vector<int> representatives; ///< of images, in the order of a sheet's block
  std::vector<int> place;           ///< (n) of the vertex's representative among them
  std::vector<int> whole1, whole2;  ///< (n) cells between the vertex and its node
  Points fraction;                  ///< (n,2) of the nodes
  std::array<int, 9> begin_of_eighth = {};
};

/// The eighth of a cell that holds a point, that below where it lies on a diagonal and that at its
/// upper right where it lies between two quads.
/// @param snap part of a cell's side by which a point may miss a line and be on it
std::size_t eighth_of(const Eigen::RowVector2d &fraction, const double snap)
{
  const int quad1 = fraction(0) + snap >= 0.5, quad2 = fraction(1) + snap >= 0.5;
  const bool is_above = fraction(1) - 0.5 * quad2 > fraction(0) - 0.5 * quad1 + snap;
  return static_cast<std::size_t>(std::find_if(eighths_of_cell.begin(), eighths_of_cell.end(),
                                               [&](const QuadHalf &half) {
                                                 return half.quad1 == quad1 &&
                                                        half.quad2 == quad2 &&
                                                        half.is_above == is_above;
                                               }) -
                                  eighths_of_cell.begin());
}

CellNodes nodes_of(const TriangleMesh &cell_mesh, const Lattice &lattice,
                   const Eigen::RowVector2d &origin)
{
  const auto n       = static_cast<std::size_t>(cell_mesh.n_vertices());
  const double snap  = 2. * image_tolerance;
  const auto classes = match_images(cell_mesh.vertices, lattice);
  CellNodes nodes    = {{},
                        std::vector<int>(n, -1),
                        std::vector<int>(n),
                        std::vector<int>(n),
                        Points(cell_mesh.n_vertices(), 2)};
  for (int v = 0; v < cell_mesh.n_vertices(); ++v)
  {
    const auto index           = static_cast<std::size_t>(v);
    const Eigen::RowVector2d f = lattice.fractional(cell_mesh.vertices.row(v) - origin);
    nodes.whole1[index]        = static_cast<int>(std::floor(f(0) + snap));
    nodes.whole2[index]        = static_cast<int>(std::floor(f(1) + snap));
    nodes.fraction.row(v) << f(0) - nodes.whole1[index], f(1) - nodes.whole2[index];
    if (classes.representative[index] == v)
      nodes.representatives.push_back(v);
  }
  std::vector<std::size_t> eighth(n);
  for (const int v : nodes.representatives)
  {
    eighth[static_cast<std::size_t>(v)] = eighth_of(nodes.fraction.row(v), snap);
    ++nodes.begin_of_eighth[eighth[static_cast<std::size_t>(v)] + 1];
  }
  std::partial_sum(nodes.begin_of_eighth.begin(), nodes.begin_of_eighth.end(),
                   nodes.begin_of_eighth.begin());
  std::vector<int> &representatives = nodes.representatives;
  std::stable_sort(
    representatives.begin(), representatives.end(),
    [&](const int a, const int b)
    { return eighth[static_cast<std::size_t>(a)] < eighth[static_cast<std::size_t>(b)]; });
  for (std::size_t k = 0; k < representatives.size(); ++k)
    nodes.place[static_cast<std::size_t>(representatives[k])] = static_cast<int>(k);
  for (std::size_t v = 0; v < n; ++v)
    nodes.place[v] = nodes.place[static_cast<std::size_t>(classes.representative[v])];
  return nodes;
}

/// @throws BadInput where a sheet would not fit into memory, or its numbers into int
void check_size(const TriangleMesh &cell_mesh, const int n1, const int n2)
{
  const double n_triangles = static_cast<double>(n1) * n2 * cell_mesh.n_triangles();
  if (n_triangles <= 5e8)
    return;
  std::ostringstream text;
  text << "a sheet of " << n1 << " x " << n2 << " cells has " << n_triangles
       << " triangles; expected at most 5e8: take fewer cells or a coarser cell";
  throw BadInput(text.str());
}
} // namespace

bool makes_sheets(const TriangleMesh &cell_mesh, const Lattice &lattice)
{
  try
  {
    corner_of_parallelogram(cell_mesh, lattice);
    return true;
  }
  catch (const BadInput &)
  {
    return false;
  }
}

Sheet tile(const TriangleMesh &cell_mesh, const Lattice &lattice, const int n1, const int n2)
{
  Sheet sheet;
  sheet.lattice         = lattice;
  sheet.origin          = corner_of_parallelogram(cell_mesh, lattice);
  sheet.n1              = n1;
  sheet.n2              = n2;
  const CellNodes nodes = nodes_of(cell_mesh, lattice, sheet.origin);
  sheet.n_per_cell      = static_cast<int>(nodes.representatives.size());
  sheet.begin_of_eighth = nodes.begin_of_eighth;
  check_size(cell_mesh, n1, n2);

  // Nodes of cells (0..n1-1, 0..n2-1) are numbered by blocks; those that close the sheet on demand.
  const int n_blocks = n1 * n2 * sheet.n_per_cell;
  std::vector<int> closing(static_cast<std::size_t>((n1 + 1) * (n2 + 1) * sheet.n_per_cell), -1);
  int n_nodes = n_blocks;
  sheet.mesh.triangles.resize(n1 * n2 * cell_mesh.n_triangles(), 3);
  sheet.mesh.material.resize(sheet.mesh.triangles.rows());
  std::vector<std::array<int, 3>> closing_nodes; // I, J, place
  const auto node_of = [&](const int i, const int j, const int v)
  {
    const auto index = static_cast<std::size_t>(v);
    const int I = i + nodes.whole1[index], J = j + nodes.whole2[index], place = nodes.place[index];
    if (I < n1 && J < n2)
      return (J * n1 + I) * sheet.n_per_cell + place;
    int &node = closing[static_cast<std::size_t>((J * (n1 + 1) + I) * sheet.n_per_cell + place)];
    if (node < 0)
    {
      node = n_nodes++;
      closing_nodes.push_back({I, J, place});
    }
    return node;
  };
  int triangle = 0;
  for (int j = 0; j < n2; ++j)
    for (int i = 0; i < n1; ++i)
      for (int t = 0; t < cell_mesh.n_triangles(); ++t, ++triangle)
      {
        for (int k = 0; k < 3; ++k)
          sheet.mesh.triangles(triangle, k) = node_of(i, j, cell_mesh.triangles(t, k));
        sheet.mesh.material(triangle) = cell_mesh.material(t);
      }

  sheet.mesh.vertices.resize(n_nodes, 2);
  sheet.cell_vertex.resize(n_nodes);
  sheet.cell.resize(n_nodes, 2);
  const auto put = [&](const int node, const int I, const int J, const int place)
  {
    const int v             = nodes.representatives[static_cast<std::size_t>(place)];
    sheet.cell_vertex(node) = v;
    sheet.cell.row(node) << I, J;
    sheet.mesh.vertices.row(node) =
      sheet.origin +
      Eigen::RowVector2d(nodes.fraction(v, 0) + I, nodes.fraction(v, 1) + J) * lattice.vectors;
  };
  for (int j = 0; j < n2; ++j)
    for (int i = 0; i < n1; ++i)
      for (int k = 0; k < sheet.n_per_cell; ++k)
        put((j * n1 + i) * sheet.n_per_cell + k, i, j, k);
  for (std::size_t k = 0; k < closing_nodes.size(); ++k)
    put(n_blocks + static_cast<int>(k), closing_nodes[k][0], closing_nodes[k][1],
        closing_nodes[k][2]);
  return sheet;
}

TriangleMesh coarse_sheet(const Eigen::RowVector2d &origin, const Eigen::Matrix2d &steps,
                          const int n1, const int n2)
{
  TriangleMesh mesh;
  mesh.vertices.resize((n1 + 1) * (n2 + 1), 2);
  for (int j = 0; j <= n2; ++j)
    for (int i = 0; i <= n1; ++i)
      mesh.vertices.row(j * (n1 + 1) + i) = origin + Eigen::RowVector2d(i, j) * steps;
  mesh.triangles.resize(2 * n1 * n2, 3);
  mesh.material.setZero(2 * n1 * n2);
  for (int j = 0; j < n2; ++j)
    for (int i = 0; i < n1; ++i)
    {
      const int corner = j * (n1 + 1) + i, above = corner + n1 + 1;
      mesh.triangles.row(2 * (j * n1 + i)) << corner, corner + 1, above + 1;
      mesh.triangles.row(2 * (j * n1 + i) + 1) << corner, above + 1, above;
    }
  return mesh;
}
} // namespace homespun::meshes
