// SPDX-License-Identifier: MIT
// Modes of a cell that are fitted to its fluctuations over a box of macro strains, beside the
// characteristic displacements, which stay those at rest:
//
//   w(E) = −sum_a E_a chi_a − sum_k c_k(E) m_k,   c_k(E) = sum_j A_jk f_j(E)
//   f_j = E_a s_1^p s_2^q s_3^r,   1 <= p + q + r <= 2,
//   s_1 = E11/(e_1 + |E11|),  s_2 = E22/(e_2 + |E22|),  s_3 = gamma12/e_3
//
// All f_j are zero at rest with their first derivatives. s_1 and s_2 saturate beyond the strains at
// which the tension of yarns outweighs their shear stiffness: a weave follows its first modes at
// rest up to there and others beyond, which no polynomial does. Where shear is as stiff as
// extension they are nearly E11/e_1 and E22/e_2, and the f_j of second and third order.
#pragma once

#include <Eigen/Core>

namespace homespun::meshes
{
struct FittedModes
{
  static constexpr int n_modes = 6, n_functions = 27;

  Eigen::Vector3d low, high; ///< the box of macro strains 11, 22, 12
  Eigen::Vector3d knees;     ///< e_1, e_2, e_3 > 0 [-]
  /// m_k, column 2 k + c component c, shape (n,12), zero at the anchor [m]
  Eigen::Matrix<double, Eigen::Dynamic, 2 * n_modes, Eigen::RowMajor> modes;
  Eigen::Matrix<double, n_functions, n_modes> coefficients; ///< A [-]

  /// Whether a strain is in the box, but for rounding.
  bool holds(const Eigen::Vector3d &strain) const
  {
    const Eigen::Array3d slack = 1e-9 * (high - low).array();
    return (strain.array() >= low.array() - slack).all() &&
           (strain.array() <= high.array() + slack).all();
  }
};

/// f_j, j by a, then p, q, r.
Eigen::Matrix<double, 1, FittedModes::n_functions> fitted_functions(const Eigen::Vector3d &strain,
                                                                    const Eigen::Vector3d &knees);

/// c_k; beyond the box those at the nearest strain of it.
Eigen::Matrix<double, 1, FittedModes::n_modes> fitted_coefficients(const FittedModes &fitted,
                                                                   const Eigen::Vector3d &strain);
} // namespace homespun::meshes
