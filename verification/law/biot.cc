// SPDX-License-Identifier: MIT
// The law `biot`: W = ½ (U − I):C:(U − I).
//
// In the plane in closed form: with a = F11 + F22, b = F21 − F12, r = |(a, b)| the rotation of the
// polar decomposition is R = (a, −b; b, a)/r and U = R^T F. Where det F > 0 this U is sqrt(F^T F);
// where det F < 0 it has a negative principal stretch, which costs energy, as in the coarse cloth.
// For r = 0 the energy is infinite, which makes a line search step back.
//
// By the metric, from U U = F^T F in the frame of the principal stretches l1, l2,
//   dU_ij = 2 dE_ij / (l_i + l_j),   d²U_ij = −2 (dU dU)_ij / (l_i + l_j)   along straight E,
// and W follows by the chain rule. No difference l1 − l2 is divided by. Where a triangle has
// collapsed to a line or a point, W has no derivative; the smaller stretch is then taken as 1e-9 of
// the larger one (or of 1), which keeps all values finite.
#include "verification/law/law_at_a_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
namespace
{
using StrainDerivative = Eigen::Matrix<double, 3, 4>; // of the Voigt strain by F11, F12, F21, F22

Response biot_in_plane(const PhaseStiffness &phase, const Eigen::Matrix2d &F)
{
  const Eigen::Matrix3d &C = phase.C;
  const double a = F(0, 0) + F(1, 1), b = F(1, 0) - F(0, 1), r = std::sqrt(a * a + b * b);
  if (!(r > 0.))
    return {std::numeric_limits<double>::infinity(), Eigen::Vector4d::Zero(),
            Eigen::Matrix4d::Zero()};
  const double c = a / r, s = b / r;
  const double U11 = c * F(0, 0) + s * F(1, 0), U22 = c * F(1, 1) - s * F(0, 1);
  const double U12 = c * F(0, 1) + s * F(1, 1);
  const Eigen::Vector3d strain(U11 - 1., U22 - 1., 2. * U12);

  // The strain depends on F directly (L) and through the angle of the rotation (h, with dtheta =
  // t.dF).
  StrainDerivative L, L_angle;
  L << c, 0., s, 0., //
    0., -s, 0., c,   //
    -s, c, c, s;
  L_angle << -s, 0., c, 0., //
    0., -c, 0., -s,         //
    -c, -s, -s, c;
  const Eigen::Vector3d h(U12, -U12, U22 - U11);
  const Eigen::Vector3d h_angle(-U11, -U22, -2. * U12);
  const Eigen::Vector4d t       = Eigen::Vector4d(-s, -c, c, -s) / r;
  const Eigen::Vector4d d_trace = Eigen::Vector4d(c, -s, s, c); // dr/dF, r = tr U
  const StrainDerivative G      = L + h * t.transpose();

  const Eigen::Vector3d force = C * strain;
  Response result{0.5 * strain.dot(force), G.transpose() * force, G.transpose() * C * G};
  const Eigen::Vector4d mixed = L_angle.transpose() * force - force.dot(h) / r * d_trace;
  result.tangent += mixed * t.transpose() + t * mixed.transpose();
  result.tangent += force.dot(h_angle) * t * t.transpose();
  return result;
}

/// Turns a strain (E11, E22, 2 E12) into axes at an angle with the given cosine and sine.
Eigen::Matrix3d strain_rotation(const double c, const double s)
{
  Eigen::Matrix3d Q;
  Q << c * c, s * s, c * s, //
    s * s, c * c, -c * s,   //
    -2. * c * s, 2. * c * s, c * c - s * s;
  return Q;
}

MetricResponse biot_by_metric(const PhaseStiffness &phase, const SpaceGradient &F)
{
  const Eigen::Matrix3d &C = phase.C;
  // Principal stretches: F^T F = ½ trace ± (half difference along the angle 2 phi).
  const double g11 = F.col(0).squaredNorm(), g22 = F.col(1).squaredNorm();
  const double g12 = F.col(0).dot(F.col(1));
  const double phi = 0.5 * std::atan2(2. * g12, g11 - g22);
  const double c = std::cos(phi), s = std::sin(phi);
  // As norms of F's columns in the principal frame, which keep all digits of a small stretch.
  const double l1     = (c * F.col(0) + s * F.col(1)).norm();
  const double l2     = (c * F.col(1) - s * F.col(0)).norm();
  const double lowest = 1e-9 * (l1 > 0. ? l1 : 1.);
  const double d1 = std::max(l1, lowest), d2 = std::max(l2, lowest), sum = d1 + d2;

  const Eigen::Matrix3d Q = strain_rotation(c, s), back = strain_rotation(c, -s);
  const Eigen::Matrix3d turned = back.transpose() * C * back;
  const Eigen::Vector3d strain(l1 - 1., l2 - 1., 0.);
  const Eigen::Vector3d T = turned * strain;                             // dW/dU
  const Eigen::Vector3d L = Eigen::Vector3d(1. / d1, 1. / d2, 2. / sum); // dU/dE, diagonal
  const Eigen::Vector3d S(T(0) / d1, T(1) / d2, 2. * T(2) / sum);
  Eigen::Matrix3d H = L.asDiagonal() * turned * L.asDiagonal();
  // T : d²U = −S : (dU dU) with dU = (e1/l1, e2/l2) on the diagonal and gamma/(l1 + l2) beside it.
  H(0, 0) -= S(0) / (d1 * d1);
  H(1, 1) -= S(1) / (d2 * d2);
  H(2, 2) -= (S(0) + S(1)) / (sum * sum);
  const double mixed1 = S(2) / (d1 * sum), mixed2 = S(2) / (d2 * sum);
  H(0, 2) -= mixed1;
  H(2, 0) -= mixed1;
  H(1, 2) -= mixed2;
  H(2, 1) -= mixed2;
  return {0.5 * strain.dot(T), Q.transpose() * S, Q.transpose() * H * Q};
}
} // namespace

const LawAtAPoint biot_law{biot_in_plane, biot_by_metric};
} // namespace homespun::verification
