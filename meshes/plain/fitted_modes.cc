// SPDX-License-Identifier: MIT
#include "meshes/plain/fitted_modes.h"

#include <cmath>

namespace homespun::meshes
{
Eigen::Matrix<double, 1, FittedModes::n_functions> fitted_functions(const Eigen::Vector3d &strain,
                                                                    const Eigen::Vector3d &knees)
{
  Eigen::Matrix<double, 3, 3> power; // s_1, s_2, s_3, each to 0, 1, 2
  power.col(0).setOnes();
  power.col(1) << strain(0) / (knees(0) + std::abs(strain(0))),
    strain(1) / (knees(1) + std::abs(strain(1))), strain(2) / knees(2);
  power.col(2) = power.col(1).cwiseAbs2();
  Eigen::Matrix<double, 1, FittedModes::n_functions> values;
  int j = 0;
  for (int a = 0; a < 3; ++a)
    for (int p = 0; p <= 2; ++p)
      for (int q = 0; p + q <= 2; ++q)
        for (int r = p + q == 0 ? 1 : 0; p + q + r <= 2; ++r)
          values(j++) = strain(a) * power(0, p) * power(1, q) * power(2, r);
  return values;
}

namespace
{
auto functions_in_box(const FittedModes &fitted, const Eigen::Vector3d &strain)
{
  return fitted_functions(strain.cwiseMax(fitted.low).cwiseMin(fitted.high), fitted.knees);
}
} // namespace

Eigen::Vector3d effective_strain(const FittedModes &fitted, const Eigen::Vector3d &strain)
{
  return strain + (functions_in_box(fitted, strain) * fitted.of_strain).transpose();
}

FittedResponse::FittedResponse(const FittedModes &fitted)
    : low(fitted.low)
    , high(fitted.high)
    , knees(fitted.knees)
{
  of_functions << fitted.of_strain, fitted.coefficients;
}

Eigen::Matrix<double, 1, 3 + FittedModes::n_modes>
FittedResponse::at(const Eigen::Vector3d &strain) const
{
  const auto functions = fitted_functions(strain.cwiseMax(low).cwiseMin(high), knees);
  Eigen::Matrix<double, 1, 3 + FittedModes::n_modes> sum;
  sum << strain.transpose(), Eigen::Matrix<double, 1, FittedModes::n_modes>::Zero();
  for (int j = 0; j < FittedModes::n_functions; ++j)
    sum += functions(j) * of_functions.row(j);
  return sum;
}

Eigen::Vector3d strain_of_free_edges(const Eigen::Vector3d &effective,
                                     const Eigen::Vector3d &strain)
{
  return effective.cwiseMax(strain.cwiseMin(0.)).cwiseMin(strain.cwiseMax(0.));
}

Eigen::Matrix<double, 1, FittedModes::n_modes> fitted_coefficients(const FittedModes &fitted,
                                                                   const Eigen::Vector3d &strain)
{
  return functions_in_box(fitted, strain) * fitted.coefficients;
}
} // namespace homespun::meshes
