// SPDX-License-Identifier: MIT
// Integrals of products of the fields of a cell problem, phase by phase: all that energies, and
// derivatives of an effective stiffness by what a phase is made of, need of the fields.
#pragma once

#include <Eigen/Core>

namespace homespun::homogenization
{
/// 1/|Y| integral f_ia f_jb over a phase, with the row 3 a + i and the column 3 b + j, for the
/// component i = 11, 22, 12 under the load a.
using FieldProducts = Eigen::Matrix<double, 9, 9>;

/// Adds weight f f^T of a field at a point, one load per column.
inline void add_products(const double weight, const Eigen::Matrix3d &field, FieldProducts &products)
{
  const Eigen::Map<const Eigen::Matrix<double, 9, 1>> f(field.data()); // load by load
  products.noalias() += weight * f * f.transpose();
}

/// The energies of a form: 1/|Y| integral f_a . form . f_b over the phase, for all loads a, b. With
/// the derivative of the phase's stiffness as the form it is that of the effective stiffness, since
/// at a minimum the fields' own change has none.
inline Eigen::Matrix3d energies_of(const Eigen::Matrix3d &form, const FieldProducts &products)
{
  Eigen::Matrix3d energies;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      energies(a, b) = form.cwiseProduct(products.block<3, 3>(3 * a, 3 * b)).sum();
  return energies;
}
} // namespace homespun::homogenization
