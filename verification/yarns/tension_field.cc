// SPDX-License-Identifier: MIT
#include "verification/yarns/tension_field.h"

#include "meshes/plain/symmetric_eigen.h"
#include "verification/yarns/yarn_law.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using meshes::YarnAxes;

namespace
{
/// Of a metric at rest, which is taut: its stiffness is that of the yarns.
constexpr double round_off = 1e-14;

/// A symmetric product a b^T + b a^T as a strain: 11, 22 and twice 12 of half of it.
Vector3d strain_of(const Vector2d &a, const Vector2d &b)
{
  return {a(0) * b(0), a(1) * b(1), a(0) * b(1) + a(1) * b(0)};
}

/// The law of yarns at a metric in their own axes.
MetricResponse yarns_at(const Eigen::Matrix3d &C, const Matrix2d &metric)
{
  const double l1 = std::sqrt(metric(0, 0)), along = metric(0, 1) / l1;
  const double across = std::sqrt(std::max(metric(1, 1) - along * along, 0.));
  return response_in_axes(C, {l1, 0., 0.}, {along, across, 0.});
}

/// Where Newton's method begins. Small wrinkles: W ≈ ½ a² m·S m + ⅛ a⁴ (m m):H:(m m) along the
/// direction m of the largest pressure. A cloth that is much too short somewhere: up to its length.
Vector2d first_guess(const Matrix2d &metric, const MetricResponse &flat)
{
  const auto stretches = meshes::symmetric_eigen<2>(metric);
  const double missing = 1. - stretches.values(0);
  if (missing > 0.1)
    return std::sqrt(missing) * stretches.vectors.col(0);
  const auto stress    = meshes::symmetric_eigen<2>(symmetric(flat.force));
  const Vector2d m     = stress.vectors.col(0);
  const Vector3d along = strain_of(m, m);
  const double rise    = along.dot(flat.stiffness * along);
  return std::sqrt(rise > 0. ? std::min(-2. * stress.values(0) / rise, 0.1) : 0.1) * m;
}

/// A wrinkle, and the law of yarns at the metric that it makes whole.
struct Wrinkle
{
  Vector2d w;
  MetricResponse response;
};

/// The wrinkle of least energy, by Newton's method on the gradient S w.
Wrinkle least_wrinkle(const Eigen::Matrix3d &C, const Matrix2d &metric, const MetricResponse &flat)
{
  constexpr int most_steps = 100;
  const double size        = C.cwiseAbs().maxCoeff();
  const auto at       = [&](const Vector2d &w) { return yarns_at(C, metric + w * w.transpose()); };
  Vector2d w          = first_guess(metric, flat);
  MetricResponse here = at(w);
  for (int newton = 0; newton < most_steps; ++newton)
  {
    const Matrix2d S        = symmetric(here.force);
    const Vector2d gradient = S * w;
    Eigen::Matrix<double, 3, 2> B; // of E by w
    B << w(0), 0., 0., w(1), w(1), w(0);
    const auto curvature    = meshes::symmetric_eigen<2>(B.transpose() * here.stiffness * B + S);
    const Vector2d positive = curvature.values.cwiseAbs().cwiseMax(1e-12 * size * w.squaredNorm());
    const Vector2d step =
      -curvature.vectors * (curvature.vectors.transpose() * gradient).cwiseQuotient(positive);
    if (!(step.norm() > 1e-15 * w.norm()))
      break;
    // Near the minimum the energy has no digits left to tell: the gradient has.
    const bool is_near = -gradient.dot(step) <= 1e-10 * here.energy;
    bool is_taken      = false;
    for (double length = 1.; length > (is_near ? 0.5 : 1e-12) && !is_taken; length *= 0.5)
    {
      const Vector2d trial       = w + length * step;
      const MetricResponse there = at(trial);
      is_taken = is_near ? (symmetric(there.force) * trial).norm() < 0.5 * gradient.norm()
                         : there.energy <= here.energy + 1e-4 * length * gradient.dot(step);
      if (is_taken)
      {
        w    = trial;
        here = there;
      }
    }
    if (!is_taken)
      break;
  }
  return {w, here};
}

/// In the axes of the yarns.
/// @param C stiffness in them (3,3) [N/m]
TensionField in_axes(const Eigen::Matrix3d &C, const Matrix2d &metric)
{
  const auto stretches = meshes::symmetric_eigen<2>(metric);
  if (stretches.values(1) < 1. - round_off)
    return {ClothState::slack, {0., Vector3d::Zero(), Eigen::Matrix3d::Zero()}};
  const double size         = C.cwiseAbs().maxCoeff();
  const MetricResponse flat = yarns_at(C, metric);
  const bool is_line        = stretches.values(0) <= 1e-12 * stretches.values(1);
  if (!is_line && meshes::symmetric_eigen<2>(symmetric(flat.force)).values(0) >= -1e-13 * size)
    return {ClothState::taut, flat};
  const auto [w, there] = least_wrinkle(C, metric, flat);
  const Vector2d m      = w.normalized(), t(-m(1), m(0));
  const double pull     = std::max(t.dot(symmetric(there.force) * t), 0.);
  Eigen::Matrix<double, 3, 2> V;
  V << strain_of(m, m), 2. * w.norm() * strain_of(m, t);
  const Eigen::Matrix<double, 3, 2> HV = there.stiffness * V;
  Matrix2d M                           = V.transpose() * HV;
  M(1, 1) += 4. * pull;
  const Vector3d force = pull * Vector3d(t(0) * t(0), t(1) * t(1), t(0) * t(1));
  return {ClothState::wrinkled,
          {there.energy, force, there.stiffness - HV * M.inverse() * HV.transpose()}};
}
} // namespace

TensionField tension_field(const YarnAxes &yarns, const Matrix2d &C)
{
  TensionField field = in_axes(yarns.C, yarns.axes.transpose() * C * yarns.axes);
  const auto &turns  = yarns.turns;
  field.response     = {field.response.energy, turns.transpose() * field.response.force,
                        turns.transpose() * field.response.stiffness * turns};
  return field;
}

Response tension_response(const YarnAxes &yarns, const Matrix2d &F)
{
  const MetricResponse metric = tension_field(yarns, F.transpose() * F).response;
  const Matrix2d S = symmetric(metric.force), P = F * S;
  return {
    metric.energy, {P(0, 0), P(0, 1), P(1, 0), P(1, 1)}, tangent_of<2>(F, metric.stiffness, S)};
}

ClothState cloth_state(const Eigen::Matrix3d &stiffness, const Matrix2d &F)
{
  const YarnAxes yarns = meshes::yarn_axes(stiffness);
  return yarns.are_there ? tension_field(yarns, F.transpose() * F).state : ClothState::taut;
}
} // namespace homespun::verification
