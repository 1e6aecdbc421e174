// SPDX-License-Identifier: MIT
#include "homogenization/bracket/plate_waves.h"

#include "homogenization/bracket/compatible_strain.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/index.h"

#include <Eigen/Cholesky>
#include <Eigen/CholmodSupport>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SparseCore>

#include <boost/math/tools/minima.hpp>

#include <cmath>
#include <complex>
#include <limits>

namespace homespun::homogenization
{
using meshes::at;

PlateWaves::PlateWaves(const TorusMesh &mesh,
                       const std::vector<Eigen::Matrix3d> &bending_stiffness_of_material,
                       const Eigen::Matrix3Xd &stress)
{
  const ThinPlate plate(PlateMesh(mesh), bending_stiffness_of_material);
  n_dofs                                  = plate.n_dofs();
  const std::vector<WeightedPoint> points = points_of_pieces(4), // of products of cubics
    points_of_energy                      = points_of_pieces(2);
  std::vector<Eigen::Vector2d> first(at(n_dofs),
                                     Eigen::Vector2d::Constant(std::nan(""))); // place met first
  for (int t = 0; t < static_cast<int>(plate.mesh.triangles.size()); ++t)
  {
    const PlateTriangle &its = plate.mesh.triangles[at(t)];
    const Eigen::Matrix3d &D = bending_stiffness_of_material[at(its.material)];
    Eigen::Matrix2d N;
    N << stress(0, t), stress(2, t), stress(2, t), stress(1, t);
    Triangle triangle;
    triangle.dofs = plate.dofs_of(t);
    for (int k = 0; k < 12; ++k)
    {
      const Eigen::Vector2d place =
        k < 9 ? its.corners[at(k / 3)]
              : Eigen::Vector2d(0.5 * (its.corners[at(k - 9)] + its.corners[at((k - 8) % 3)]));
      Eigen::Vector2d &seen = first[at(triangle.dofs[at(k)])];
      if (std::isnan(seen(0)))
        seen = place;
      triangle.offset.row(k) = (place - seen).transpose();
    }
    triangle.deflection.setZero();
    triangle.pressed_slopes.setZero();
    Eigen::Matrix2d legs;
    legs << its.corners[1] - its.corners[0], its.corners[2] - its.corners[0];
    const double area = 0.5 * legs.determinant();
    for (const auto &[point, part] : points)
    {
      const ThinPlate::Shapes rows              = plate.shapes(t, point.in_triangle);
      const Eigen::Matrix<double, 2, 12> slopes = rows.middleRows<2>(1);
      triangle.deflection.noalias() += part * area * rows.row(0).transpose() * rows.row(0);
      triangle.pressed_slopes.noalias() -= part * area * slopes.transpose() * N * slopes;
    }
    const Eigen::Matrix3d root = Eigen::LLT<Eigen::Matrix3d>(D).matrixU();
    for (int q = 0; q < 12; ++q)
    {
      const auto &[point, part] = points_of_energy[at(q)];
      triangle.rows.middleRows<3>(3 * q) =
        std::sqrt(part * area) * root * plate.shapes(t, point.in_triangle).bottomRows<3>();
    }
    triangles.push_back(triangle);
  }
}

double PlateWaves::energy(const Eigen::VectorXcd &wave, const Eigen::Vector2d &wave_vector,
                          const double foundation) const
{
  double sum = 0.;
  for (const Triangle &triangle : triangles)
  {
    Eigen::Matrix<std::complex<double>, 12, 1> local;
    for (int k = 0; k < 12; ++k)
      local(k) =
        std::polar(1., triangle.offset.row(k).dot(wave_vector)) * wave(triangle.dofs[at(k)]);
    sum += (triangle.rows * local).squaredNorm() +
           foundation * std::real(local.dot(triangle.deflection * local));
  }
  return sum;
}

double PlateWaves::compression(const Eigen::Vector2d &wave_vector, const double foundation) const
{
  using Complex = std::complex<double>;
  using Matrix  = Eigen::SparseMatrix<Complex>;
  std::vector<Eigen::Triplet<Complex>> of_stiffness, of_slopes;
  Eigen::VectorXcd w = Eigen::VectorXcd::Zero(n_dofs); // begins with exp(i k.x) itself
  for (const Triangle &triangle : triangles)
  {
    Eigen::Matrix<Complex, 12, 1> phase;
    for (int k = 0; k < 12; ++k)
      phase(k) = std::polar(1., triangle.offset.row(k).dot(wave_vector));
    const Element stiffness =
      triangle.rows.transpose() * triangle.rows + foundation * triangle.deflection;
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j)
      {
        const int row = triangle.dofs[at(i)], column = triangle.dofs[at(j)];
        const Complex turned = std::conj(phase(i)) * phase(j);
        of_stiffness.emplace_back(row, column, turned * stiffness(i, j));
        of_slopes.emplace_back(row, column, turned * triangle.pressed_slopes(i, j));
      }
    for (int k = 0; k < 9; k += 3)
      w(triangle.dofs[at(k)]) = 1.;
  }
  Matrix stiffness(n_dofs, n_dofs), slopes(n_dofs, n_dofs);
  stiffness.setFromTriplets(of_stiffness.begin(), of_stiffness.end());
  slopes.setFromTriplets(of_slopes.begin(), of_slopes.end());
  const Eigen::CholmodSupernodalLLT<Matrix> factor(stiffness);
  // Lanczos's method for the largest 1/s: near the edge of the zone two waves are nearly alike.
  std::vector<Eigen::VectorXcd> basis, weighted; // orthonormal in the stiffness, and times it
  Eigen::MatrixXcd projected(0, 0);
  std::vector<double> history;
  while (history.size() < 60 && factor.info() == Eigen::Success)
  {
    for (int twice = 0; twice < 2; ++twice)
      for (std::size_t i = 0; i < basis.size(); ++i)
        w -= basis[i] * weighted[i].dot(w);
    basis.emplace_back(w / std::sqrt(std::real(w.dot(stiffness * w))));
    weighted.emplace_back(stiffness * basis.back());
    const Eigen::VectorXcd pressed = slopes * basis.back();
    const auto n                   = static_cast<Eigen::Index>(basis.size());
    projected.conservativeResize(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
    {
      projected(i, n - 1) = basis[at(static_cast<int>(i))].dot(pressed);
      projected(n - 1, i) = std::conj(projected(i, n - 1));
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> waves(projected);
    Eigen::VectorXcd wave = Eigen::VectorXcd::Zero(n_dofs);
    for (Eigen::Index i = 0; i < n; ++i)
      wave += waves.eigenvectors()(i, n - 1) * basis[at(static_cast<int>(i))];
    const double quotient =
      std::real(wave.dot(slopes * wave)) / energy(wave, wave_vector, foundation);
    if (!history.empty() && quotient > 0. && std::abs(quotient - history.back()) < 1e-12 * quotient)
      return 1. / quotient;
    history.push_back(quotient);
    w = factor.solve(pressed);
  }
  throw meshes::NotConverged("waves of a pressed sheet: 1/compression [m/N]", history);
}

WrinkleOnset PlateWaves::onset(const Eigen::Vector2d &direction, const double wavenumber,
                               const double foundation) const
{
  const double shortest = 0.5 * wavenumber, longest = 2. * wavenumber;
  const auto [k, compression] = boost::math::tools::brent_find_minima(
    [&](const double length) { return this->compression(length * direction, foundation); },
    shortest, longest, std::numeric_limits<double>::digits / 3);
  if (k < 1.01 * shortest || k > 0.99 * longest)
    throw meshes::NotConverged("waves of a pressed sheet: the first to begin is not among those "
                               "half to twice as long as that of D^H",
                               {});
  return {k, compression};
}

Eigen::Matrix3Xd stress_of_compression(const TorusMesh &mesh,
                                       const std::vector<Eigen::Matrix3d> &stiffness_of_material,
                                       const Eigen::Vector2d &direction)
{
  const CompatibleStrain solved(mesh, stiffness_of_material, 2);
  const Eigen::Vector3d mean(direction(0) * direction(0), direction(1) * direction(1),
                             direction(0) * direction(1));
  const Eigen::Vector3d strain = -(solved.stiffness.inverse() * mean);
  Eigen::Matrix3Xd stress(3, mesh.n_triangles());
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const FieldOfLoads fields = solved.strain(t);
    Eigen::Matrix3d of_loads  = Eigen::Matrix3d::Zero();
    for (int q = 0; q < n_field_points; ++q)
      of_loads += fields.middleRows<3>(3 * q) / n_field_points;
    stress.col(t) = stiffness_of_material[at(mesh.triangles[at(t)].material)] * (of_loads * strain);
  }
  return stress;
}
} // namespace homespun::homogenization
