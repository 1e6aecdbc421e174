// SPDX-License-Identifier: MIT
// Stiffness, meshes and measures that the shell tests share.
#pragma once

#include "shell/solver/equilibrium.h"
#include "tests/meshes/plain/shapes.h"

#include <Eigen/Geometry>

#include <cmath>
#include <random>
#include <vector>

namespace homespun::tests
{
/// Symmetric positive definite with all couplings; ratio 1e4 between its stiffest and softest
/// strain.
inline Eigen::Matrix3d anisotropic()
{
  const Eigen::Matrix3d Q = (Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()) *
                             Eigen::AngleAxisd(0.9, Eigen::Vector3d::UnitZ()))
                              .toRotationMatrix();
  Eigen::Matrix3d D = Q * Eigen::Vector3d(1e4, 30., 1.).asDiagonal() * Q.transpose();
  return 0.5 * (D + D.transpose());
}

inline Eigen::Matrix3d isotropic(const double young, const double poisson)
{
  Eigen::Matrix3d D;
  D << 1., poisson, 0., poisson, 1., 0., 0., 0., 0.5 * (1. - poisson);
  return young / (1. - poisson * poisson) * D;
}

template <typename Matrix>
Matrix random_matrix(std::mt19937 &generator, const Eigen::Index rows = Matrix::RowsAtCompileTime,
                     const Eigen::Index cols = Matrix::ColsAtCompileTime)
{
  std::uniform_real_distribution<double> random(-1., 1.);
  Matrix matrix(rows, cols);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < cols; ++j)
      matrix(i, j) = random(generator);
  return matrix;
}

/// Any rotation of the plane or of space.
template <int dim>
Eigen::Matrix<double, dim, dim> rotation(const double angle)
{
  if constexpr (dim == 2)
    return Eigen::Rotation2Dd(angle).toRotationMatrix();
  else
    return Eigen::AngleAxisd(angle, Eigen::Vector3d(0.3, -0.7, 0.5).normalized())
      .toRotationMatrix();
}

/// Rest positions as current ones.
template <int dim>
shell::Positions<dim> embedded(const meshes::TriangleMesh &mesh)
{
  shell::Positions<dim> x  = shell::Positions<dim>::Zero(mesh.n_vertices(), dim);
  x.template leftCols<2>() = mesh.vertices;
  return x;
}

/// The Hessian of the energy of a membrane times a vector, triangle by triangle.
template <int dim>
shell::Positions<dim> hessian_times(const shell::Membrane &membrane, const shell::Positions<dim> &x,
                                    const shell::Positions<dim> &direction)
{
  shell::Positions<dim> result = shell::Positions<dim>::Zero(x.rows(), dim);
  for (int t = 0; t < static_cast<int>(membrane.triangles.rows()); ++t)
  {
    const auto H = shell::membrane_hessian<dim>(membrane, t, x, shell::Hessian::exact);
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
        result.row(membrane.triangles(t, k)) +=
          direction.row(membrane.triangles(t, l)) *
          H.template block<dim, dim>(dim * k, dim * l).transpose();
  }
  return result;
}

/// An irregular sheet of 2 n^2 triangles with sides of 1 cm.
inline meshes::TriangleMesh irregular_sheet(const int n, const double side = 0.01)
{
  const meshes::Lattice lattice = square_lattice(side);
  meshes::TriangleMesh mesh     = parallelogram(lattice, n, n);
  shake(mesh, lattice, 0.25 * side / n);
  return mesh;
}

/// Vertices on the outline of a square sheet.
inline std::vector<int> outline_of(const meshes::TriangleMesh &mesh)
{
  return meshes::boundary_loops(mesh).at(0);
}

/// Least-squares slope of log(value) over log(step).
inline double slope(const std::vector<double> &steps, const std::vector<double> &values)
{
  double sx = 0., sy = 0., sxx = 0., sxy = 0.;
  const auto n = static_cast<double>(steps.size());
  for (std::size_t k = 0; k < steps.size(); ++k)
  {
    const double x = std::log(steps[k]), y = std::log(values[k]);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// C^H of the cell plain-weave-straight, rounded: E/G = 1113 [N/m].
inline Eigen::Matrix3d plain_weave()
{
  Eigen::Matrix3d C;
  C << 90150., 2034., 0., 2034., 90150., 0., 0., 0., 81.;
  return C;
}
} // namespace homespun::tests
