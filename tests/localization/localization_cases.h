// SPDX-License-Identifier: MIT
// Cells, coarse meshes and motions that the localization tests share.
#pragma once

#include "localization/upsampler.h"
#include "meshes/plain/singular_values.h"
#include "tests/meshes/plain/plain_cell.h"

#include <Eigen/Geometry>

#include <cmath>
#include <random>

namespace homespun::tests
{
/// A cell with a smooth periodic chi, zero at its lattice points, different in every column.
inline meshes::HomogenizedCell smooth_cell(const meshes::Lattice &lattice, const int n1,
                                           const int n2)
{
  meshes::HomogenizedCell cell = plain_cell(lattice, n1, n2);
  const double size            = 0.02 * std::sqrt(lattice.area());
  const Eigen::Matrix<double, 1, 6> sines =
    (Eigen::Matrix<double, 1, 6>() << 1., -0.4, 0.3, 1.2, -0.7, 0.9).finished();
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d f = 2. * M_PI * lattice.fractional(cell.mesh.vertices.row(v));
    for (int k = 0; k < 6; ++k)
      cell.chi(v, k) = size * (sines(k) * std::sin(f(0) + k) + std::cos(2. * f(1) - k) +
                               sines(5 - k) * std::sin(f(0) - f(1)));
  }
  cell.chi.rowwise() -= Eigen::Matrix<double, 1, 6>(cell.chi.row(0));
  return cell;
}

/// A cell, its sheet and the sheet's own coarse mesh.
struct Cloth
{
  Cloth(const meshes::HomogenizedCell &cell, const int n1, const int n2)
      : cell(cell)
      , sheet(meshes::tile(cell.mesh, cell.lattice, n1, n2))
      , coarse(meshes::coarse_sheet(sheet.origin, sheet.lattice.vectors, n1, n2))
  {
  }

  meshes::HomogenizedCell cell;
  meshes::Sheet sheet;
  meshes::TriangleMesh coarse;
};

inline Cloth skewed_cloth()
{
  return {smooth_cell(skewed_lattice(), 7, 6), 4, 3};
}

/// Rest positions under one deformation gradient, shape (dim,2).
template <int dim>
localization::Positions<dim> affine_motion(const meshes::Points &rest,
                                           const Eigen::Matrix<double, dim, 2> &F)
{
  return (rest * F.transpose()).rowwise() + Eigen::Matrix<double, 1, dim>::Constant(0.007);
}

/// A motion with strains of about 10 % that varies over the sheet; in space also bent.
template <int dim>
localization::Positions<dim> wavy_motion(const meshes::Points &rest)
{
  localization::Positions<dim> x = localization::Positions<dim>::Zero(rest.rows(), dim);
  for (Eigen::Index v = 0; v < rest.rows(); ++v)
  {
    const double X = rest(v, 0), Y = rest(v, 1);
    x(v, 0) = 1.1 * X + 0.05 * Y + 1.5 * X * Y + 0.02;
    x(v, 1) = 0.95 * Y - 2. * X * X + 0.4 * X;
    if constexpr (dim == 3)
      x(v, 2) = 0.004 * std::sin(150. * X + 90. * Y);
  }
  return x;
}

template <int dim>
Eigen::Matrix<double, dim, 2> some_stretch()
{
  Eigen::Matrix<double, dim, 2> F = Eigen::Matrix<double, dim, 2>::Zero();
  F.template topRows<2>() << 1.15, 0.2, -0.1, 0.9;
  if constexpr (dim == 3)
    F.row(2) << 0.3, -0.4;
  return F;
}

/// U − I in Voigt form and R of a deformation gradient, by singular values and no closed form.
template <int dim>
localization::Frame<dim> frame_by_svd(const Eigen::Matrix<double, dim, 2> &F)
{
  const meshes::SingularValues svd =
    meshes::singular_values(F, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::Matrix2d V = svd.V, U = V * svd.values.asDiagonal() * V.transpose();
  localization::Frame<dim> frame;
  frame.strain << U(0, 0) - 1., U(1, 1) - 1., 2. * U(0, 1);
  frame.lift = svd.U * V.transpose();
  return frame;
}

template <int dim>
typename localization::Upsampler<dim, double>::Fine
upsampled(const Cloth &cloth, const localization::Positions<dim> &current,
          const localization::UpsamplerOptions &options = {})
{
  const localization::Upsampler<dim, double> upsampler(cloth.cell, cloth.coarse, cloth.sheet,
                                                       options);
  typename localization::Upsampler<dim, double>::Fine fine;
  upsampler.upsample(current, fine);
  return fine;
}
} // namespace homespun::tests
