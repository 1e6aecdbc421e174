// SPDX-License-Identifier: MIT
#include "verification/cell/moduli_bars.h"

#include "homogenization/bracket/loewner.h"
#include "verification/record/claim.h"

#include <array>
#include <cmath>
#include <limits>

namespace homespun::verification
{
namespace
{
std::array<double, 5> moduli_of(const Eigen::Matrix3d &S)
{
  return {1. / S(0, 0), 1. / S(1, 1), 1. / S(2, 2), -S(0, 1) / S(0, 0), -S(0, 1) / S(1, 1)};
}

std::array<double, 5> as_array(const homogenization::EngineeringConstants &of)
{
  return {of.E1, of.E2, of.G12, of.nu12, of.nu21};
}
} // namespace

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

Verdict check_of_moduli(const std::string &name, const Eigen::Matrix3d &stiffness,
                        const Eigen::Matrix3d &lower, const Eigen::Matrix3d &upper)
{
  const homogenization::RoundedInverse inverse = homogenization::inverse_of(stiffness);
  const Eigen::Matrix3d bars = compliance_bars(lower, upper), &S = inverse.value;
  const std::array<double, 5> said = as_array(bars_of_moduli(S, bars)),
                              here = as_array(homogenization::engineering_constants(stiffness));
  const double round_off = 16. * std::numeric_limits<double>::epsilon() + inverse.round_off;
  double reach           = 0.;
  const auto ask         = [&](const Eigen::Matrix3d &compliance)
  {
    const std::array<double, 5> moduli = moduli_of(compliance);
    for (std::size_t k = 0; k < said.size(); ++k)
      if (const double distance = std::abs(moduli[k] - here[k]);
          distance > 0. && !std::isinf(said[k]))
        reach = larger(reach, distance / (said[k] + round_off * std::abs(here[k])));
  };
  for (int end = 0; end < 16; ++end)
  {
    const auto step = [&](const int bit, const int i, const int j)
    { return ((end >> bit) & 1) != 0 ? bars(i, j) : -bars(i, j); };
    Eigen::Matrix3d there = S;
    for (int i = 0; i < 3; ++i)
      there(i, i) += step(i, i, i);
    there(0, 1) += step(3, 0, 1);
    ask(there);
  }
  for (const Eigen::Matrix3d *const side : {&lower, &upper})
    ask(homogenization::inverse_of(*side).value);
  return at_most("bracket.moduli", {{"stiffness", name}}, reach, 1. + 1e-9);
}
} // namespace homespun::verification
