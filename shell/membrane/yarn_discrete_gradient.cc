// SPDX-License-Identifier: MIT
#include "shell/membrane/yarn_discrete_gradient.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>

namespace homespun::shell
{
namespace
{
/// A number and its derivative by E1, the metric at the end of the step.
struct Slope
{
  double value;
  Eigen::RowVector3d by_end = Eigen::RowVector3d::Zero();

  Slope operator*(const Slope &b) const
  {
    return {value * b.value, value * b.by_end + b.value * by_end};
  }
  Slope operator+(const Slope &b) const
  {
    return {value + b.value, by_end + b.by_end};
  }
  Slope operator*(const double factor) const
  {
    return {value * factor, by_end * factor};
  }
  Slope inverse() const
  {
    return {1. / value, -by_end / (value * value)};
  }
};

Slope mean(const double old, const Slope &now)
{
  return (Slope{old} + now) * 0.5;
}

/// A triangle's yarns at one end of the step.
struct End
{
  DeformationGradient<3> f; ///< columns f1, f2
  std::array<double, 2> l;  ///< stretches
  double g12, gamma, cosine;
};

End end_of(const RestTriangle &rest, const Eigen::Matrix3d &corners, const meshes::YarnAxes &yarns)
{
  End end;
  end.f             = deformation_gradient<3>(rest, corners) * yarns.axes;
  end.l             = {end.f.col(0).norm(), end.f.col(1).norm()};
  end.g12           = end.f.col(0).dot(end.f.col(1));
  const double area = end.f.col(0).cross(end.f.col(1)).norm();
  end.gamma         = std::atan2(end.g12, area);
  end.cosine        = area / (end.l[0] * end.l[1]);
  return end;
}

/// Δγ / Δsin γ of the step, gamma at its end being a function of E1.
Slope angle_per_sine(const double old, const Slope &gamma)
{
  const double half = 0.5 * (gamma.value - old), middle = 0.5 * (gamma.value + old);
  const double h2         = half * half;
  const bool is_small     = h2 < 1e-6; // the series is exact to round-off there
  const double sinc       = is_small ? 1. - h2 / 6. + h2 * h2 / 120. : std::sin(half) / half;
  const double log_slope  = is_small ? -half / 3. - half * h2 / 45.
                                     : std::cos(half) / std::sin(half) - 1. / half; // of log sinc
  const double value      = 1. / (std::cos(middle) * sinc);
  const double derivative = 0.5 * value * (std::tan(middle) - log_slope);
  return {value, derivative * gamma.by_end};
}

/// M, entry by entry, those that are not zero.
struct StrainOfMetric
{
  Slope m11, m22, m31, m32, m33;
};

StrainOfMetric strain_of_metric(const End &old, const End &now)
{
  std::array<Slope, 2> mean_length, mean_inverse, inverse; // l̄, mean of 1/l, 1/l at the end
  for (std::size_t i = 0; i < 2; ++i)
  {
    Slope length{now.l[i]};
    length.by_end(static_cast<Eigen::Index>(i)) = 1. / now.l[i];
    inverse[i]                                  = length.inverse();
    mean_length[i]                              = mean(old.l[i], length);
    mean_inverse[i]                             = mean(1. / old.l[i], inverse[i]);
  }
  const double J = now.cosine * now.l[0] * now.l[1];
  Slope gamma{now.gamma}, g12{now.g12};
  gamma.by_end << -now.g12 / (J * now.l[0] * now.l[0]), -now.g12 / (J * now.l[1] * now.l[1]),
    1. / J;
  g12.by_end(2)        = 1.;
  const Slope per_sine = angle_per_sine(old.gamma, gamma), mean_g12 = mean(old.g12, g12);
  const Slope along_area = mean(1. / (old.l[0] * old.l[1]), inverse[0] * inverse[1]);
  const auto by_length   = [&](const std::size_t i) // Δγ by ΔE_ii, through 1/l_i
  {
    return per_sine * mean_g12 * mean_inverse[1 - i] * inverse[i] * mean_length[i].inverse() *
           (-1. / old.l[i]);
  };
  return {mean_length[0].inverse(), mean_length[1].inverse(), by_length(0), by_length(1),
          per_sine * along_area};
}
} // namespace

TriangleStep yarn_triangle_step(const RestTriangle &rest, const Eigen::Matrix3d &old_corners,
                                const Eigen::Matrix3d &corners, const meshes::YarnAxes &yarns)
{
  const End old = end_of(rest, old_corners, yarns), now = end_of(rest, corners, yarns);
  const StrainOfMetric M = strain_of_metric(old, now);
  Eigen::Matrix3d matrix;
  matrix << M.m11.value, 0., 0., //
    0., M.m22.value, 0.,         //
    M.m31.value, M.m32.value, M.m33.value;
  const Eigen::Vector3d strain(0.5 * (old.l[0] + now.l[0]) - 1., 0.5 * (old.l[1] + now.l[1]) - 1.,
                               0.5 * (old.gamma + now.gamma));
  const Eigen::Vector3d T = yarns.C * strain, S = matrix.transpose() * T;

  // dS = M^T C ½ de1 + dM^T T̄.
  const double J = now.cosine * now.l[0] * now.l[1];
  Eigen::Matrix3d end_strain;          // de1 by E1
  end_strain << 1. / now.l[0], 0., 0., //
    0., 1. / now.l[1], 0.,             //
    -now.g12 / (J * now.l[0] * now.l[0]), -now.g12 / (J * now.l[1] * now.l[1]), 1. / J;
  Eigen::Matrix3d dS = 0.5 * matrix.transpose() * yarns.C * end_strain;
  dS.row(0) += T(0) * M.m11.by_end + T(2) * M.m31.by_end;
  dS.row(1) += T(1) * M.m22.by_end + T(2) * M.m32.by_end;
  dS.row(2) += T(2) * M.m33.by_end;

  Eigen::Matrix2d stress;
  stress << S(0), S(2), S(2), S(1);
  const Eigen::Matrix<double, 3, 2> hats = rest.shape_gradients * yarns.axes; // along the yarns
  return step_of_stress(rest.area, hats, 0.5 * (old.f + now.f), now.f, stress, dS);
}
} // namespace homespun::shell
