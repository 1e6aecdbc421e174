// SPDX-License-Identifier: MIT
// Modes of a cell that are fitted to its fluctuations over a box of macro strains, beside the
// characteristic displacements at rest, which follow an effective strain:
//
//   w(E) = −sum_a e_a(E) chi_a − sum_k c_k(E) m_k
//   e_a = E_a + sum_j B_ja f_j(E),   c_k = sum_j A_jk f_j(E)
//   f_j = E_a s_1^p s_2^q s_3^r,   1 <= p + q + r <= 2,
//   s_1 = E11/(e_1 + |E11|),  s_2 = E22/(e_2 + |E22|),  s_3 = gamma12/e_3
//
// The m_k are orthogonal to the chi_a in the mean over the cell, so that e is how much of each chi
// there is; what follows chi, as slip and layers of clamped edges do, follows e. All f_j are zero
// at rest with their first derivatives. s_1 and s_2 saturate beyond the strains at which the
// tension of yarns outweighs their shear stiffness: a weave follows its first modes at rest up to
// there and others beyond, which no polynomial does. Where shear is as stiff as extension they are
// nearly E11/e_1 and E22/e_2, and the f_j of second and third order.
#pragma once

#include <Eigen/Core>

#include <array>

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
  Eigen::Matrix<double, n_functions, 3> of_strain =
    Eigen::Matrix<double, n_functions, 3>::Zero(); ///< B [-]

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

/// The nine numbers of a strain, e and then c_k; beyond the box what e adds to E, and c_k, are
/// those of the nearest strain of it.
class FittedResponse
{
public:
  static constexpr int width = 8, size = 3 + FittedModes::n_modes;
  using Pack = Eigen::Array<double, width, 1>;

  FittedResponse() = default;
  explicit FittedResponse(const FittedModes &fitted);

  /// Of `width` strains abreast: a number takes as many multiply-adds as there are functions, 243
  /// for a strain, in whole registers.
  std::array<Pack, size> at(const std::array<Pack, 3> &strains) const;

  /// Of one.
  Eigen::Matrix<double, 1, size> at(const Eigen::Vector3d &strain) const;

private:
  Eigen::Vector3d low, high, knees;
  Eigen::Matrix<double, FittedModes::n_functions, size, Eigen::RowMajor> of_functions;
};

/// What layers at free edges follow: a component of e between zero and that of E. They are those of
/// the stress at small strain, which e does not enlarge: in a weave that is pulled, the share of
/// chi across is many times the strain across.
inline FittedResponse::Pack strain_of_free_edges(const FittedResponse::Pack &effective,
                                                 const FittedResponse::Pack &strain)
{
  return effective.max(strain.min(0.)).min(strain.max(0.));
}
} // namespace homespun::meshes
