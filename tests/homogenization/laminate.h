// SPDX-License-Identifier: MIT
// The closed form of a laminate.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include <vector>

namespace homespun::tests
{
/// The stiffness of a laminate of any anisotropic layers stacked along axis 2. Across the layers the
/// strain 11 and the stresses 22, 12 are continuous; with a = (22, 12) and b = 11,
///   C_aa = <c_aa^-1>^-1,  C_ba = <c_ba c_aa^-1> C_aa,
///   C_bb = <c_bb − c_ba c_aa^-1 c_ab> + C_ba C_aa^-1 C_ab.
inline Eigen::Matrix3d laminate(const std::vector<Eigen::Matrix3d> &layers,
                                const std::vector<double> &fractions)
{
  Eigen::Matrix2d mean_inverse  = Eigen::Matrix2d::Zero();
  Eigen::RowVector2d mean_ratio = Eigen::RowVector2d::Zero();
  double mean_rest              = 0.;
  for (std::size_t k = 0; k < layers.size(); ++k)
  {
    const Eigen::Matrix2d inverse = layers[k].bottomRightCorner<2, 2>().inverse();
    const Eigen::RowVector2d c_ba = layers[k].block<1, 2>(0, 1);
    mean_inverse += fractions[k] * inverse;
    mean_ratio += fractions[k] * c_ba * inverse;
    mean_rest += fractions[k] * (layers[k](0, 0) - c_ba * inverse * c_ba.transpose());
  }
  Eigen::Matrix3d C;
  const Eigen::Matrix2d C_aa    = mean_inverse.inverse();
  const Eigen::RowVector2d C_ba = mean_ratio * C_aa;
  C.bottomRightCorner<2, 2>()   = C_aa;
  C.block<1, 2>(0, 1)           = C_ba;
  C.block<2, 1>(1, 0)           = C_ba.transpose();
  C(0, 0)                       = mean_rest + C_ba * mean_ratio.transpose();
  return C;
}
} // namespace homespun::tests
