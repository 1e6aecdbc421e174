// SPDX-License-Identifier: MIT
#include "homogenization/edges/cell_elements.h"

#include "homogenization/bracket/compatible_strain.h"
#include "homogenization/bracket/displacement_shapes.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/index.h"
#include "meshes/plain/triangle_kinematics.h"

#include <array>
#include <cmath>
#include <map>
#include <sstream>

namespace homespun::homogenization
{
using meshes::at;

namespace
{
/// Barycentric coordinates and weight of a point of quadrature; weights add up to one.
struct Barycentric
{
  Eigen::Vector3d at;
  double weight;
};

/// Exact to degree 1 (one point) or 4 (six points; Strang and Fix 1973).
std::vector<Barycentric> quadrature(const unsigned int order)
{
  if (order == 1)
    return {{Eigen::Vector3d::Constant(1. / 3.), 1.}};
  std::vector<Barycentric> points;
  const std::array<std::array<double, 2>, 2> orbits = {
    {{0.445948490915965, 0.223381589678011}, {0.091576213509771, 0.109951743655322}}};
  for (const auto &[a, weight] : orbits)
    for (int k = 0; k < 3; ++k)
    {
      Eigen::Vector3d at = Eigen::Vector3d::Constant(a);
      at(k)              = 1. - 2. * a;
      points.push_back({at, weight});
    }
  return points;
}

template <int n_shapes>
ElementPoint element_point(const meshes::TriangleGeometry &geometry, const Barycentric &of)
{
  return {strain_displacement<n_shapes>(geometry.shape_gradients, of.at),
          shape_values<n_shapes>(of.at), of.weight * geometry.area};
}

/// The corner of a triangle of a mesh with which it begins on the torus.
int first_corner(const meshes::TriangleMesh &mesh, const int triangle, const TorusTriangle &its)
{
  int first        = 0;
  const auto apart = [&](const int k)
  { return (mesh.vertices.row(mesh.triangles(triangle, k)).transpose() - its.corner).norm(); };
  for (int k = 1; k < 3; ++k)
    if (apart(k) < apart(first))
      first = k;
  return first;
}

/// The corner of a cell; where it has none, a force on an edge would be that of its material alone.
Eigen::RowVector2d corner_of(const UnitCell &cell)
try
{
  return meshes::corner_of_parallelogram(cell.mesh, cell.lattice);
}
catch (const meshes::BadInput &bad)
{
  throw meshes::BadInput(cell.file + ": " + bad.what());
}
} // namespace

CellElements::CellElements(const UnitCell &cell, const unsigned int order)
    : cell(cell)
    , torus(glued(cell.mesh, cell.lattice))
    , class_of(torus.vertex_of_original)
    , n_classes(torus.n_vertices + (order == 2 ? torus.n_edges() : 0))
    , stiffness_of_phase(cell.stiffness_of_phase())
    , origin(corner_of(cell))
{
  const meshes::TriangleMesh &mesh = cell.mesh;
  nodes.resize(mesh.n_triangles(), order == 1 ? 3 : 6);
  std::vector<Eigen::RowVector2d> middles;
  std::map<std::array<int, 2>, int> middle; // of two vertices -> node
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const TorusTriangle &its = torus.triangles[at(t)];
    const int first          = first_corner(mesh, t, its);
    for (int k = 0; k < 3; ++k)
      nodes(t, k) = mesh.triangles(t, (first + k) % 3);
    for (int k = 0; k < (order == 2 ? 3 : 0); ++k)
    {
      const int i = nodes(t, k), j = nodes(t, (k + 1) % 3);
      const auto [place, is_new] =
        middle.insert({{std::min(i, j), std::max(i, j)}, static_cast<int>(class_of.size())});
      if (is_new)
      {
        middles.emplace_back(0.5 * (mesh.vertices.row(i) + mesh.vertices.row(j)));
        class_of.push_back(torus.n_vertices + its.edges[at(k)]);
      }
      nodes(t, 3 + k) = place->second;
    }
  }
  points.resize(static_cast<Eigen::Index>(class_of.size()), 2);
  points.topRows(mesh.n_vertices()) = mesh.vertices;
  for (std::size_t k = 0; k < middles.size(); ++k)
    points.row(mesh.n_vertices() + static_cast<Eigen::Index>(k)) = middles[k];
}

const Eigen::Matrix3d &CellElements::stiffness_of(const int triangle) const
{
  return stiffness_of_phase[static_cast<std::size_t>(cell.mesh.material(triangle))];
}

Eigen::RowVector2d CellElements::fraction(const Eigen::RowVector2d &point) const
{
  return cell.lattice.fractional(point - origin);
}

std::vector<ElementPoint> CellElements::points_of(const int triangle) const
{
  const meshes::TriangleGeometry geometry =
    meshes::triangle_geometry(meshes::sides_of_triangle<2>(nodes.row(triangle).head<3>(), points));
  std::vector<ElementPoint> result;
  for (const Barycentric &b : quadrature(n_shapes() == 3 ? 1 : 2))
    result.push_back(n_shapes() == 3 ? element_point<3>(geometry, b)
                                     : element_point<6>(geometry, b));
  return result;
}

Eigen::VectorXd CellElements::lengths_on_edge(const int axis) const
{
  Eigen::VectorXd lengths = Eigen::VectorXd::Zero(n_classes);
  const auto is_on        = [&](const int node)
  { return std::abs(fraction(points.row(node))(axis)) <= 2. * meshes::image_tolerance; };
  for (int t = 0; t < n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int i = nodes(t, k), j = nodes(t, (k + 1) % 3);
      if (!is_on(i) || !is_on(j))
        continue;
      const double length = (points.row(j) - points.row(i)).norm();
      const double end    = n_shapes() == 3 ? 0.5 : 1. / 6.;
      for (const int node : {i, j})
        lengths(class_of[static_cast<std::size_t>(node)]) += end * length;
      if (n_shapes() == 6)
        lengths(class_of[static_cast<std::size_t>(nodes(t, 3 + k))]) += 2. / 3. * length;
    }
  return lengths;
}

namespace
{
/// Minus the mean of the values at the vertices, linear in the triangles.
void take_mean_off(const CellElements &elements, Eigen::MatrixXd &w)
{
  const Eigen::VectorXd areas      = meshes::signed_areas(elements.cell.mesh);
  Eigen::Matrix<double, 2, 3> mean = Eigen::Matrix<double, 2, 3>::Zero();
  for (int t = 0; t < elements.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      mean +=
        areas(t) / (3. * areas.sum()) *
        w.middleRows<2>(2 * elements.class_of[static_cast<std::size_t>(elements.nodes(t, k))]);
  for (int n = 0; n < elements.n_classes; ++n)
    w.middleRows<2>(2 * n) -= mean;
}
} // namespace

ElementCellProblem solve_cell(const CellElements &elements)
{
  const CompatibleStrain solved(elements.torus, elements.stiffness_of_phase,
                                elements.n_shapes() == 3 ? 1 : 2);
  ElementCellProblem problem{-solved.chi_at_nodes(), solved.stiffness};
  take_mean_off(elements, problem.w);
  return problem;
}
} // namespace homespun::homogenization
