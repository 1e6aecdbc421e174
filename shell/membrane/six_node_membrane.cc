// SPDX-License-Identifier: MIT
#include "shell/membrane/six_node_membrane.h"

#include "meshes/plain/errors.h"

#include <cmath>
#include <string>

namespace homespun::shell
{
namespace
{
/// Derivatives of the six functions by the barycentric coordinates, (6,3).
Eigen::Matrix<double, 6, 3> barycentric_gradients(const Eigen::RowVector3d &at)
{
  Eigen::Matrix<double, 6, 3> gradients = Eigen::Matrix<double, 6, 3>::Zero();
  for (int k = 0; k < 3; ++k)
  {
    const int next         = (k + 1) % 3;
    gradients(k, k)        = 4. * at(k) - 1.;
    gradients(3 + k, k)    = 4. * at(next);
    gradients(3 + k, next) = 4. * at(k);
  }
  return gradients;
}

/// The three points inside a triangle, each a sixth from two sides: exact for quadratics.
Eigen::RowVector3d point(const int q)
{
  Eigen::RowVector3d at = Eigen::RowVector3d::Constant(1. / 6.);
  at(q)                 = 2. / 3.;
  return at;
}

/// Adds what belongs to the corners of the points to the nodes: corners_of_points() transposed.
/// @param weights of each triangle, (9,6)
template <typename Weights, typename Rows>
void add_to_nodes(const SixNodeMembrane &membrane, const Rows &of_corners, const Weights &weights,
                  Rows &of_nodes)
{
  for (int t = 0; t < static_cast<int>(membrane.triangles.rows()); ++t)
  {
    const auto here = (weights(t).transpose() * of_corners.template middleRows<9>(9 * t)).eval();
    for (int k = 0; k < 6; ++k)
      of_nodes.row(membrane.triangles(t, k)) += here.row(k);
  }
}
} // namespace

template <int dim>
Positions<dim> corners_of_points(const SixNodeMembrane &membrane, const Positions<dim> &positions)
{
  const int n = static_cast<int>(membrane.triangles.rows());
  Positions<dim> corners(9 * n, dim);
  for (int t = 0; t < n; ++t)
  {
    Eigen::Matrix<double, 6, dim> nodes;
    for (int k = 0; k < 6; ++k)
      nodes.row(k) = positions.row(membrane.triangles(t, k));
    corners.template middleRows<9>(9 * t) = membrane.corners[static_cast<std::size_t>(t)] * nodes;
  }
  return corners;
}

SixNodeMesh six_node_mesh(const meshes::TriangleMesh &coarse, const int n1, const int n2)
{
  if (n1 % 2 != 0 || n2 % 2 != 0)
    throw meshes::BadInput("six-node triangles: two quads wide, they do not fill " +
                           std::to_string(n1) + " x " + std::to_string(n2) +
                           " quads; expected even numbers");
  SixNodeMesh mesh;
  mesh.nodes = coarse.vertices;
  mesh.triangles.resize(n1 * n2 / 2, 6);
  int t = 0;
  for (int j = 0; j < n2; j += 2)
    for (int i = 0; i < n1; i += 2)
    {
      const auto node = [&](const int x, const int y) { return (j + y) * (n1 + 1) + i + x; };
      mesh.triangles.row(t++) << node(0, 0), node(2, 0), node(2, 2), node(1, 0), node(2, 1),
        node(1, 1);
      mesh.triangles.row(t++) << node(0, 0), node(2, 2), node(0, 2), node(1, 1), node(1, 2),
        node(0, 1);
    }
  return mesh;
}

SixNodeMembrane six_node_membrane(const SixNodeMesh &mesh, const Eigen::Matrix3d &stiffness)
{
  const int n = static_cast<int>(mesh.triangles.rows());
  SixNodeMembrane result;
  result.vertices  = mesh.nodes;
  result.triangles = mesh.triangles;
  meshes::TriangleMesh points;
  points.triangles.resize(3 * n, 3);
  points.material = Eigen::VectorXi::Zero(3 * n);
  for (int t = 0; t < n; ++t)
  {
    Eigen::Matrix<double, 3, 2> vertices;
    for (int k = 0; k < 3; ++k)
      vertices.row(k) = mesh.nodes.row(mesh.triangles(t, k));
    const RestTriangle rest = rest_triangle(vertices);
    if (!(rest.area > 0.))
      throw meshes::BadInput("six-node triangle " + std::to_string(t) +
                             ": its area is not positive; expected counter-clockwise corners");
    const double side = std::sqrt(2. * rest.area / 3.); // half its square is the point's weight
    Eigen::Matrix<double, 9, 6> corners;
    for (int q = 0; q < 3; ++q)
    {
      const Eigen::Matrix<double, 6, 2> gradients =
        barycentric_gradients(point(q)) * rest.shape_gradients;
      for (int c = 0; c < 3; ++c)
      {
        corners.row(3 * q + c) = six_node_values(point(q));
        if (c > 0)
          corners.row(3 * q + c) += side * gradients.col(c - 1).transpose();
      }
      points.triangles.row(3 * t + q) << 9 * t + 3 * q, 9 * t + 3 * q + 1, 9 * t + 3 * q + 2;
    }
    result.corners.push_back(corners);
  }
  points.vertices = corners_of_points<2>(result, mesh.nodes);
  result.points   = membrane(points, {stiffness});
  return result;
}

template <int dim>
double membrane_energy(const SixNodeMembrane &membrane, const Positions<dim> &positions)
{
  return membrane_energy<dim>(membrane.points, corners_of_points<dim>(membrane, positions));
}

template <int dim>
MembraneGradient<dim> membrane_gradient(const SixNodeMembrane &membrane,
                                        const Positions<dim> &positions)
{
  const MembraneGradient<dim> at_points =
    membrane_gradient<dim>(membrane.points, corners_of_points<dim>(membrane, positions));
  MembraneGradient<dim> result;
  result.gradient.setZero(positions.rows(), dim);
  result.magnitude.setZero(positions.rows());
  result.round_off.setZero(positions.rows());
  result.energy_round_off = at_points.energy_round_off;
  const auto weights      = [&](const int t) -> const Eigen::Matrix<double, 9, 6> &
  { return membrane.corners[static_cast<std::size_t>(t)]; };
  const auto sizes = [&](const int t) { return weights(t).cwiseAbs().eval(); };
  add_to_nodes(membrane, at_points.gradient, weights, result.gradient);
  add_to_nodes(membrane, at_points.magnitude, sizes, result.magnitude);
  add_to_nodes(membrane, at_points.round_off, sizes, result.round_off);
  return result;
}

Positions<2> linear_membrane_gradient(const SixNodeMembrane &membrane,
                                      const Positions<2> &displacement)
{
  Positions<2> gradient = Positions<2>::Zero(displacement.rows(), 2);
  add_to_nodes(
    membrane,
    linear_membrane_gradient(membrane.points, corners_of_points<2>(membrane, displacement)),
    [&](const int t) -> const Eigen::Matrix<double, 9, 6> &
    { return membrane.corners[static_cast<std::size_t>(t)]; },
    gradient);
  return gradient;
}

void add_membrane_hessian(const SixNodeMembrane &membrane, const Positions<2> &positions,
                          const Hessian kind, PlaneMatrix &matrix)
{
  const Positions<2> corners = corners_of_points<2>(membrane, positions);
  for (int t = 0; t < static_cast<int>(membrane.triangles.rows()); ++t)
  {
    Eigen::Matrix<double, 12, 12> whole = Eigen::Matrix<double, 12, 12>::Zero();
    for (int q = 0; q < 3; ++q)
    {
      Eigen::Matrix<double, 6, 12> map = Eigen::Matrix<double, 6, 12>::Zero();
      for (int c = 0; c < 3; ++c)
        for (int k = 0; k < 6; ++k)
          for (int i = 0; i < 2; ++i)
            map(2 * c + i, 2 * k + i) = membrane.corners[static_cast<std::size_t>(t)](3 * q + c, k);
      whole.noalias() +=
        map.transpose() * membrane_hessian<2>(membrane.points, 3 * t + q, corners, kind) * map;
    }
    matrix.add(t, whole);
  }
}

Eigen::Matrix<double, 1, 6> six_node_values(const Eigen::RowVector3d &at)
{
  Eigen::Matrix<double, 1, 6> values;
  for (int k = 0; k < 3; ++k)
  {
    values(k)     = at(k) * (2. * at(k) - 1.);
    values(3 + k) = 4. * at(k) * at((k + 1) % 3);
  }
  return values;
}

template Positions<3> corners_of_points<3>(const SixNodeMembrane &, const Positions<3> &);
template Positions<2> corners_of_points<2>(const SixNodeMembrane &, const Positions<2> &);
template double membrane_energy<2>(const SixNodeMembrane &, const Positions<2> &);
template MembraneGradient<2> membrane_gradient<2>(const SixNodeMembrane &, const Positions<2> &);
} // namespace homespun::shell
