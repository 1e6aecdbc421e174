// SPDX-License-Identifier: MIT
#include "homogenization/bracket/plate_mesh.h"

#include "homogenization/bracket/airy_unknowns.h"
#include "meshes/plain/index.h"
#include "meshes/plain/triangle_sides.h"

namespace homespun::homogenization
{
using meshes::at;

PlateMesh::PlateMesh(const meshes::TriangleMesh &mesh)
    : n_vertices(mesh.n_vertices())
{
  const meshes::TriangleSides sides(mesh);
  normals.resize(at(sides.n()));
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    PlateTriangle triangle;
    for (int k = 0; k < 3; ++k)
    {
      triangle.vertices[at(k)] = mesh.triangles(t, k);
      triangle.sides[at(k)]    = sides.of_triangle(t, k);
      triangle.corners[at(k)]  = mesh.vertices.row(mesh.triangles(t, k)).transpose();
    }
    triangle.material = mesh.material.size() > 0 ? mesh.material(t) : 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Eigen::Vector2d along    = triangle.corners[(k + 1) % 3] - triangle.corners[k];
      normals[at(triangle.sides[k])] = edge_normal({0, 0, along});
    }
    triangles.push_back(triangle);
  }
}

PlateMesh::PlateMesh(const TorusMesh &mesh)
    : n_vertices(mesh.n_vertices)
{
  for (const TorusEdge &edge : mesh.edges)
    normals.push_back(edge_normal(edge));
  for (const TorusTriangle &glued : mesh.triangles)
  {
    PlateTriangle triangle{glued.vertices, glued.edges, glued.shape(mesh.edges), glued.material};
    for (Eigen::Vector2d &corner : triangle.corners)
      corner += glued.corner;
    triangles.push_back(triangle);
  }
}

std::vector<RimSide> PlateMesh::rim() const
{
  std::vector<int> n_triangles_of(normals.size(), 0);
  for (const PlateTriangle &triangle : triangles)
    for (const int side : triangle.sides)
      ++n_triangles_of[at(side)];
  std::vector<RimSide> rim;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (n_triangles_of[at(triangles[t].sides[at(k)])] == 1)
        rim.push_back({static_cast<int>(t), k});
  return rim;
}
} // namespace homespun::homogenization
