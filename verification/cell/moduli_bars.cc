// SPDX-License-Identifier: MIT
#include "verification/cell/moduli_bars.h"

#include "homogenization/bracket/loewner.h"

#include <cmath>

namespace homespun::verification
{
Eigen::Matrix3d compliance_bars(const Eigen::Matrix3d &lower, const Eigen::Matrix3d &upper)
{
  const homogenization::RoundedInverse most  = homogenization::inverse_of(lower),
                                       least = homogenization::inverse_of(upper);
  const Eigen::Vector3d root =
    (most.value / (1. - most.round_off) - least.value / (1. + least.round_off))
      .diagonal()
      .cwiseMax(0.)
      .cwiseSqrt();
  return root * root.transpose();
}

homogenization::EngineeringConstants bars_of_moduli(const Eigen::Matrix3d &S,
                                                    const Eigen::Matrix3d &bars)
{
  // 1/S_ii and S_12/S_ii over all S within their bars.
  const auto least = [&](const int i) { return bars(i, i) < S(i, i) ? S(i, i) - bars(i, i) : 0.; };
  const auto of_modulus = [&](const int i) { return bars(i, i) / (S(i, i) * least(i)); };
  const auto of_ratio   = [&](const int i)
  { return (bars(0, 1) + std::abs(S(0, 1) / S(i, i)) * bars(i, i)) / least(i); };
  return {of_modulus(0), of_modulus(1), of_modulus(2), of_ratio(0), of_ratio(1)};
}
} // namespace homespun::verification
