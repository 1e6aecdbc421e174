// SPDX-License-Identifier: MIT
// Vibrations of a flat sheet by linear and quadratic triangles with consistent mass, assembled
// apart from the program: stiffness and density of each phase are all that it is told.
#pragma once

#include "meshes/plain/triangle_mesh.h"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>

#include <cmath>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace homespun::tests
{
/// Vibrations in the plane: K u = omega^2 M u of the DoFs 2 node + component, none of them held.
struct Pencil
{
  meshes::Points nodes;
  std::vector<bool> is_held;
  Eigen::SparseMatrix<double> stiffness, consistent;
  Eigen::VectorXd
    lumped; ///< (n nodes): the diagonal of M, scaled to the mass of each triangle [kg]
};

struct Vibration
{
  double squared = 0.; ///< omega^2 [1/s^2]
  meshes::Points mode;
};

/// Barycentric coordinates and weights, exact for polynomials of degree 4 (Dunavant 1985).
inline std::vector<std::pair<Eigen::RowVector3d, double>> points_of_degree_4()
{
  std::vector<std::pair<Eigen::RowVector3d, double>> points;
  for (const auto &[a, weight] : {std::pair(0.445948490915964886, 0.223381589678011466),
                                  std::pair(0.0915762135097707434, 0.109951743655321868)})
    for (int k = 0; k < 3; ++k)
    {
      Eigen::RowVector3d at = Eigen::RowVector3d::Constant(a);
      at(k)                 = 1. - 2. * a;
      points.emplace_back(at, weight);
    }
  return points;
}

/// Values (n) and derivatives by the barycentric coordinates (n,3) of the shapes of a triangle.
inline std::pair<Eigen::VectorXd, Eigen::MatrixXd> shapes_at(const Eigen::RowVector3d &b,
                                                             const int order)
{
  if (order == 1)
    return {b.transpose(), Eigen::Matrix3d::Identity()};
  Eigen::VectorXd values(6);
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(6, 3);
  for (int k = 0; k < 3; ++k)
  {
    const int next      = (k + 1) % 3;
    values(k)           = b(k) * (2. * b(k) - 1.);
    slopes(k, k)        = 4. * b(k) - 1.;
    values(3 + k)       = 4. * b(k) * b(next);
    slopes(3 + k, k)    = 4. * b(next);
    slopes(3 + k, next) = 4. * b(k);
  }
  return {values, slopes};
}

/// Nodes of each triangle; midpoints are appended to the vertices.
inline std::vector<std::vector<int>> numbered(const meshes::TriangleMesh &mesh, const int order,
                                              meshes::Points &nodes)
{
  nodes = mesh.vertices;
  std::map<std::pair<int, int>, int> middle_of;
  std::vector<std::vector<int>> all;
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    std::vector<int> its = {mesh.triangles(t, 0), mesh.triangles(t, 1), mesh.triangles(t, 2)};
    for (int k = 0; order == 2 && k < 3; ++k)
    {
      const std::pair<int, int> ends = std::minmax(its[k], its[(k + 1) % 3]);
      const auto [place, is_new] =
        middle_of.emplace(ends, mesh.n_vertices() + static_cast<int>(middle_of.size()));
      if (is_new)
      {
        nodes.conservativeResize(nodes.rows() + 1, 2);
        nodes.row(place->second) =
          0.5 * (mesh.vertices.row(ends.first) + mesh.vertices.row(ends.second));
      }
      its.push_back(place->second);
    }
    all.push_back(its);
  }
  return all;
}

/// @param stiffness, density per phase [N/m], [kg/m^2]
/// @param is_held of a point at rest
inline Pencil pencil_of(const meshes::TriangleMesh &mesh, const int order,
                        const std::vector<Eigen::Matrix3d> &stiffness,
                        const std::vector<double> &density,
                        const std::function<bool(const Eigen::RowVector2d &)> &is_held)
{
  Pencil pencil;
  const std::vector<std::vector<int>> nodes_of = numbered(mesh, order, pencil.nodes);
  const int n                                  = static_cast<int>(pencil.nodes.rows());
  for (int v = 0; v < n; ++v)
    pencil.is_held.push_back(is_held(pencil.nodes.row(v)));
  pencil.lumped.setZero(n);
  std::vector<Eigen::Triplet<double>> of_stiffness, of_mass;
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    Eigen::Matrix3d corners; // rows: 1, x, y
    for (int k = 0; k < 3; ++k)
      corners.col(k) << 1., mesh.vertices(mesh.triangles(t, k), 0),
        mesh.vertices(mesh.triangles(t, k), 1);
    const double area                             = 0.5 * corners.determinant();
    const Eigen::Matrix<double, 3, 2> of_position = corners.inverse().rightCols<2>();
    const std::vector<int> &its                   = nodes_of[static_cast<std::size_t>(t)];
    const auto phase                              = static_cast<std::size_t>(mesh.material(t));
    const Eigen::Index m                          = static_cast<Eigen::Index>(its.size());
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * m, 2 * m), M = Eigen::MatrixXd::Zero(m, m);
    for (const auto &[at, weight] : points_of_degree_4())
    {
      const auto [values, slopes]    = shapes_at(at, order);
      const Eigen::MatrixXd gradient = slopes * of_position;
      Eigen::MatrixXd B              = Eigen::MatrixXd::Zero(3, 2 * m);
      for (Eigen::Index a = 0; a < m; ++a)
      {
        B(0, 2 * a) = B(2, 2 * a + 1) = gradient(a, 0);
        B(1, 2 * a + 1) = B(2, 2 * a) = gradient(a, 1);
      }
      K += weight * area * B.transpose() * stiffness[phase] * B;
      M += weight * area * density[phase] * values * values.transpose();
    }
    for (Eigen::Index a = 0; a < m; ++a)
    {
      pencil.lumped(its[a]) += M(a, a) / M.trace() * area * density[phase];
      for (Eigen::Index b = 0; b < m; ++b)
        if (!pencil.is_held[its[a]] && !pencil.is_held[its[b]])
          for (int i = 0; i < 2; ++i)
          {
            of_mass.emplace_back(2 * its[a] + i, 2 * its[b] + i, M(a, b));
            for (int j = 0; j < 2; ++j)
              of_stiffness.emplace_back(2 * its[a] + i, 2 * its[b] + j, K(2 * a + i, 2 * b + j));
          }
    }
  }
  for (int v = 0; v < n; ++v) // a held node does not move, whatever its stiffness
    for (int i = 0; pencil.is_held[v] && i < 2; ++i)
      of_stiffness.emplace_back(2 * v + i, 2 * v + i, stiffness[0](0, 0));
  pencil.stiffness.resize(2 * n, 2 * n);
  pencil.stiffness.setFromTriplets(of_stiffness.begin(), of_stiffness.end());
  pencil.consistent.resize(2 * n, 2 * n);
  pencil.consistent.setFromTriplets(of_mass.begin(), of_mass.end());
  return pencil;
}

/// Inverse iteration.
/// @param solve K^-1 of forces, zero at held nodes
/// @param mass M of displacements
inline Vibration lowest(const std::function<meshes::Points(const meshes::Points &)> &solve,
                        const std::function<meshes::Points(const meshes::Points &)> &mass,
                        const meshes::Points &start)
{
  Vibration found;
  found.mode = start;
  for (double last = 0.; std::abs(found.squared - last) > 1e-13 * found.squared || last == 0.;)
  {
    last                       = found.squared;
    const meshes::Points force = mass(found.mode), next = solve(force);
    found.squared = next.cwiseProduct(force).sum() / next.cwiseProduct(mass(next)).sum();
    found.mode    = next / next.rowwise().norm().maxCoeff();
  }
  return found;
}

enum class Mass
{
  consistent,
  lumped
};

inline Vibration lowest(const Pencil &pencil, const Mass of)
{
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(pencil.stiffness);
  const auto flat = [](const meshes::Points &rows)
  { return Eigen::Map<const Eigen::VectorXd>(rows.data(), rows.size()); };
  const auto rows = [](const Eigen::VectorXd &values)
  { return meshes::Points(Eigen::Map<const meshes::Points>(values.data(), values.size() / 2, 2)); };
  const auto mass = [&](const meshes::Points &u)
  {
    meshes::Points forces = of == Mass::consistent ? rows(pencil.consistent * flat(u))
                                                   : meshes::Points(pencil.lumped.asDiagonal() * u);
    for (Eigen::Index v = 0; v < forces.rows(); ++v)
      if (pencil.is_held[static_cast<std::size_t>(v)])
        forces.row(v).setZero();
    return forces;
  };
  return lowest([&](const meshes::Points &f) { return rows(factor.solve(flat(f))); }, mass,
                meshes::Points::Ones(pencil.nodes.rows(), 2));
}
} // namespace homespun::tests
