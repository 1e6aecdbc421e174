// SPDX-License-Identifier: MIT
// A cubic form of a strain: the part of third order of an energy. Ten numbers.
#pragma once

#include <Eigen/Core>

#include <array>

namespace homespun::meshes
{
/// W3(E) = 1/6 sum_abc T_abc E_a E_b E_c, with E = (E11, E22, gamma12) and T symmetric.
struct CubicForm
{
  /// The indices a <= b <= c of the ten numbers; 0, 1, 2 stand for 11, 22, 12.
  static constexpr std::array<std::array<int, 3>, 10> indices = {{{0, 0, 0},
                                                                  {0, 0, 1},
                                                                  {0, 0, 2},
                                                                  {0, 1, 1},
                                                                  {0, 1, 2},
                                                                  {0, 2, 2},
                                                                  {1, 1, 1},
                                                                  {1, 1, 2},
                                                                  {1, 2, 2},
                                                                  {2, 2, 2}}};

  /// T_abc = d³W3 / dE_a dE_b dE_c, in the order of `indices` [N/m].
  Eigen::Matrix<double, 10, 1> derivatives = Eigen::Matrix<double, 10, 1>::Zero();

  /// The matrix T E: entry ab is sum_c T_abc E_c, the second derivative of W3 at E [N/m].
  Eigen::Matrix3d hessian(const Eigen::Vector3d &strain) const
  {
    const auto &T  = derivatives;
    const double x = strain(0), y = strain(1), z = strain(2);
    Eigen::Matrix3d sum;
    sum(0, 0) = T(0) * x + T(1) * y + T(2) * z;
    sum(0, 1) = T(1) * x + T(3) * y + T(4) * z;
    sum(0, 2) = T(2) * x + T(4) * y + T(5) * z;
    sum(1, 1) = T(3) * x + T(6) * y + T(7) * z;
    sum(1, 2) = T(4) * x + T(7) * y + T(8) * z;
    sum(2, 2) = T(5) * x + T(8) * y + T(9) * z;
    sum(1, 0) = sum(0, 1);
    sum(2, 0) = sum(0, 2);
    sum(2, 1) = sum(1, 2);
    return sum;
  }

  /// First derivative of W3: ½ (T E) E [N/m].
  Eigen::Vector3d gradient(const Eigen::Vector3d &strain) const
  {
    return 0.5 * (hessian(strain) * strain);
  }

  /// W3 = 1/6 E·(T E) E, per rest area [N/m].
  double value(const Eigen::Vector3d &strain) const
  {
    return gradient(strain).dot(strain) / 3.;
  }
};
} // namespace homespun::meshes
