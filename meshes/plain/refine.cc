// SPDX-License-Identifier: MIT
#include "meshes/plain/refine.h"

#include "meshes/plain/triangle_sides.h"

namespace homespun::meshes
{
namespace
{
TriangleMesh refined_once(const TriangleMesh &mesh)
{
  const int n = mesh.n_vertices(), m = mesh.n_triangles();
  const TriangleSides sides(mesh);
  TriangleMesh fine;
  fine.vertices.resize(n + sides.n(), 2);
  fine.vertices.topRows(n) = mesh.vertices;
  fine.triangles.resize(4 * m, 3);
  fine.material.resize(4 * m);
  for (int t = 0; t < m; ++t)
  {
    const int a = mesh.triangles(t, 0), b = mesh.triangles(t, 1), c = mesh.triangles(t, 2);
    const int ab = n + sides.of_triangle(t, 0), bc = n + sides.of_triangle(t, 1),
              ca          = n + sides.of_triangle(t, 2);
    fine.vertices.row(ab) = 0.5 * (mesh.vertices.row(a) + mesh.vertices.row(b));
    fine.vertices.row(bc) = 0.5 * (mesh.vertices.row(b) + mesh.vertices.row(c));
    fine.vertices.row(ca) = 0.5 * (mesh.vertices.row(c) + mesh.vertices.row(a));
    fine.triangles.row(4 * t) << a, ab, ca;
    fine.triangles.row(4 * t + 1) << ab, b, bc;
    fine.triangles.row(4 * t + 2) << ca, bc, c;
    fine.triangles.row(4 * t + 3) << ab, bc, ca;
    fine.material.segment<4>(4 * t).setConstant(mesh.material(t));
  }
  return fine;
}
} // namespace

TriangleMesh refined(const TriangleMesh &mesh, const int times)
{
  TriangleMesh fine = mesh;
  for (int k = 0; k < times; ++k)
    fine = refined_once(fine);
  return fine;
}
} // namespace homespun::meshes
