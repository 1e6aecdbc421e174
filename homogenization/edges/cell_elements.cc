// SPDX-License-Identifier: MIT
#include "homogenization/edges/cell_elements.h"

#include "homogenization/algebra/cholesky_factor.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/triangle_kinematics.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCore>

#include <array>
#include <cmath>
#include <map>
#include <sstream>

namespace homespun::homogenization
{
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

constexpr int edge_of_shape[3][2] = {{0, 1}, {1, 2}, {2, 0}};

/// Refuses cells that make no straight edges.
void require_parallelogram(const UnitCell &cell, const meshes::Lattice &lattice,
                           const Eigen::RowVector2d &origin)
{
  const double slack = 2. * meshes::image_tolerance;
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d f = lattice.fractional(cell.mesh.vertices.row(v) - origin);
    if (f.minCoeff() >= -slack && f.maxCoeff() <= 1. + slack)
      continue;
    std::ostringstream text;
    text << cell.file << ": vertex " << v << " at (" << cell.mesh.vertices.row(v)
         << ") m lies outside the parallelogram of the lattice vectors at (" << origin
         << ") m; expected all inside: the edges of this cell are no lattice lines, and have no "
            "edge terms";
    throw meshes::BadInput(text.str());
  }
}
} // namespace

CellElements::CellElements(const UnitCell &cell, const unsigned int order)
    : cell(cell)
    , stiffness(cell.stiffness_of_phase())
    , origin(cell.mesh.vertices.row(meshes::anchor_vertex(cell.mesh, cell.lattice)))
{
  require_parallelogram(cell, cell.lattice, origin);
  const meshes::TriangleMesh &mesh = cell.mesh;
  nodes.resize(mesh.n_triangles(), order == 1 ? 3 : 6);
  nodes.leftCols<3>()                 = mesh.triangles;
  std::vector<Eigen::RowVector2d> all = {};
  for (int v = 0; v < mesh.n_vertices(); ++v)
    all.emplace_back(mesh.vertices.row(v));
  std::map<std::array<int, 2>, int> middle;
  if (order == 2)
    for (int t = 0; t < mesh.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
      {
        const int i = mesh.triangles(t, edge_of_shape[k][0]),
                  j = mesh.triangles(t, edge_of_shape[k][1]);
        const auto [place, is_new] =
          middle.insert({{std::min(i, j), std::max(i, j)}, static_cast<int>(all.size())});
        if (is_new)
          all.emplace_back(0.5 * (mesh.vertices.row(i) + mesh.vertices.row(j)));
        nodes(t, 3 + k) = place->second;
      }
  points.resize(static_cast<Eigen::Index>(all.size()), 2);
  for (std::size_t n = 0; n < all.size(); ++n)
    points.row(static_cast<Eigen::Index>(n)) = all[n];

  const meshes::ImageClasses images = meshes::match_images(points, cell.lattice);
  class_of.assign(all.size(), -1);
  for (std::size_t n = 0; n < all.size(); ++n)
  {
    int &of_first = class_of[static_cast<std::size_t>(images.representative[n])];
    if (of_first < 0)
      of_first = n_classes++;
    class_of[n] = of_first;
  }
}

const Eigen::Matrix3d &CellElements::stiffness_of(const int triangle) const
{
  return stiffness[static_cast<std::size_t>(cell.mesh.material(triangle))];
}

Eigen::RowVector2d CellElements::fraction(const Eigen::RowVector2d &point) const
{
  return cell.lattice.fractional(point - origin);
}

std::vector<ElementPoint> CellElements::points_of(const int triangle) const
{
  const meshes::TriangleGeometry geometry =
    meshes::triangle_geometry(meshes::sides_of_triangle<2>(nodes.row(triangle).head<3>(), points));
  const Eigen::Matrix<double, 2, 3> slopes = geometry.shape_gradients.transpose();

  std::vector<ElementPoint> result;
  const int n = n_shapes();
  for (const Barycentric &b : quadrature(n == 3 ? 1 : 2))
  {
    Eigen::Matrix<double, 2, Eigen::Dynamic> gradients(2, n);
    Eigen::VectorXd values(n);
    for (int k = 0; k < 3; ++k)
    {
      values(k)        = n == 3 ? b.at(k) : b.at(k) * (2. * b.at(k) - 1.);
      gradients.col(k) = (n == 3 ? 1. : 4. * b.at(k) - 1.) * slopes.col(k);
    }
    for (int k = 3; k < n; ++k)
    {
      const int i = edge_of_shape[k - 3][0], j = edge_of_shape[k - 3][1];
      values(k)        = 4. * b.at(i) * b.at(j);
      gradients.col(k) = 4. * (b.at(i) * slopes.col(j) + b.at(j) * slopes.col(i));
    }
    ElementPoint point;
    point.strains.setZero(3, 2 * n);
    for (int k = 0; k < n; ++k)
    {
      point.strains(0, 2 * k) = point.strains(2, 2 * k + 1) = gradients(0, k);
      point.strains(1, 2 * k + 1) = point.strains(2, 2 * k) = gradients(1, k);
    }
    point.values = values;
    point.weight = b.weight * geometry.area;
    result.push_back(point);
  }
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
      const int i = nodes(t, edge_of_shape[k][0]), j = nodes(t, edge_of_shape[k][1]);
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
/// DoFs of a triangle among the classes.
std::vector<int> class_dofs(const CellElements &elements, const int triangle)
{
  std::vector<int> dofs;
  for (int k = 0; k < elements.n_shapes(); ++k)
    for (int c = 0; c < 2; ++c)
      dofs.push_back(2 * elements.class_of[static_cast<std::size_t>(elements.nodes(triangle, k))] +
                     c);
  return dofs;
}

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
  const int n = 2 * elements.n_classes - 2; // the last class is held
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(n + 2, 3);
  Eigen::Matrix3d mean  = Eigen::Matrix3d::Zero();
  for (int t = 0; t < elements.n_triangles(); ++t)
  {
    const std::vector<int> dofs = class_dofs(elements, t);
    const Eigen::Matrix3d &c    = elements.stiffness_of(t);
    for (const ElementPoint &point : elements.points_of(t))
    {
      const Eigen::MatrixXd rows   = point.weight * point.strains.transpose() * c;
      const Eigen::MatrixXd matrix = rows * point.strains;
      mean += point.weight * c;
      for (std::size_t i = 0; i < dofs.size(); ++i)
      {
        loads.row(dofs[i]) -= rows.row(static_cast<Eigen::Index>(i));
        for (std::size_t j = 0; j < dofs.size(); ++j)
          if (dofs[i] >= dofs[j] && dofs[i] < n)
            entries.emplace_back(
              dofs[i], dofs[j], matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
      }
    }
  }
  Eigen::SparseMatrix<double> lower(n, n);
  lower.setFromTriplets(entries.begin(), entries.end());
  const CholeskyFactor factor(lower, elements.cell.file + ": cell problem");
  const Eigen::MatrixXd right = loads.topRows(n);
  Eigen::MatrixXd w           = factor.solve(right);
  for (int pass = 0; pass < 2; ++pass)
    w += factor.solve(right - lower.selfadjointView<Eigen::Lower>() * w);

  ElementCellProblem problem;
  problem.w.setZero(n + 2, 3);
  problem.w.topRows(n) = w;
  // <c e_a> + <c eps(w_a)>, the second from the loads: they are −integral of B^T c.
  problem.stiffness = (mean - loads.transpose() * problem.w) / elements.cell.lattice.area();
  problem.stiffness = 0.5 * (problem.stiffness + problem.stiffness.transpose()).eval();
  take_mean_off(elements, problem.w);
  return problem;
}
} // namespace homespun::homogenization
