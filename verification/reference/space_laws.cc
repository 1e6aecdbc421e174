// SPDX-License-Identifier: MIT
#include "verification/reference/space_laws.h"

#include "verification/yarns/metric_response.h"
#include "verification/yarns/yarn_law.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace homespun::verification
{
namespace
{
/// Turns a strain (E11, E22, 2 E12) into axes at an angle with the given cosine and sine.
Eigen::Matrix3d strain_rotation(const double c, const double s)
{
  Eigen::Matrix3d Q;
  Q << c * c, s * s, c * s, //
    s * s, c * c, -c * s,   //
    -2. * c * s, 2. * c * s, c * c - s * s;
  return Q;
}

MetricResponse green_response(const Eigen::Matrix3d &C, const SpaceGradient &F)
{
  const Eigen::Vector3d strain(0.5 * (F.col(0).squaredNorm() - 1.),
                               0.5 * (F.col(1).squaredNorm() - 1.), F.col(0).dot(F.col(1)));
  const Eigen::Vector3d force = C * strain;
  return {0.5 * strain.dot(force), force, C};
}

MetricResponse biot_response(const Eigen::Matrix3d &C, const SpaceGradient &F)
{
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

MetricResponse metric_response(const Law law, const Eigen::Matrix3d &C, const SpaceGradient &F)
{
  switch (law)
  {
  case Law::linear:
    break; // is no function of the metric
  case Law::green:
    return green_response(C, F);
  case Law::yarn:
    if (const meshes::YarnAxes yarns = meshes::yarn_axes(C); yarns.are_there)
      return yarn_metric_response(yarns, F * yarns.axes.col(0), F * yarns.axes.col(1));
    return biot_response(C, F);
  case Law::biot:
    return biot_response(C, F);
  }
  throw std::logic_error("the law " + name_of(law) + " is none of a sheet in space");
}

/// S without its compression.
Eigen::Matrix2d tension_of(const Eigen::Matrix2d &S)
{
  const double mean = 0.5 * (S(0, 0) + S(1, 1)), half = 0.5 * (S(0, 0) - S(1, 1));
  const double radius = std::hypot(half, S(0, 1));
  if (mean >= radius)
    return S;
  if (mean <= -radius)
    return Eigen::Matrix2d::Zero();
  // (mean + radius) times the projector on the first eigenvector.
  return 0.5 * (mean + radius) / radius * (S + (radius - mean) * Eigen::Matrix2d::Identity());
}

/// In the frame (t1, t2, n) of the sheet the tangent falls apart: a 4x4 block of motions in the
/// sheet's own plane and S for those along its normal. Each is made positive by itself.
SpaceTangent positive_tangent(const SpaceGradient &F, const Eigen::Matrix3d &H,
                              const Eigen::Matrix2d &S)
{
  const int longer    = F.col(0).squaredNorm() >= F.col(1).squaredNorm() ? 0 : 1;
  const double length = F.col(longer).norm();
  const Eigen::Vector3d t1 =
    length > 0. ? Eigen::Vector3d(F.col(longer) / length) : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d across = F.col(1 - longer) - t1.dot(F.col(1 - longer)) * t1;
  const double height          = across.norm();
  // Any plane through the line serves a triangle that has collapsed to it.
  const Eigen::Vector3d t2 =
    height > 1e-14 * length ? Eigen::Vector3d(across / height) : t1.unitOrthogonal();
  SpaceGradient frame;
  frame << t1, t2;
  const Eigen::Vector3d normal = t1.cross(t2);

  Eigen::Matrix4d in_plane = tangent_of<2>(frame.transpose() * F, H, S);
  if (Eigen::LLT<Eigen::Matrix4d>(in_plane).info() != Eigen::Success)
    in_plane = positive_part(in_plane);
  const Eigen::Matrix2d along = tension_of(S);

  SpaceTangent tangent;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
    {
      Eigen::Matrix2d block = normal(a) * normal(b) * along;
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
          block += frame(a, i) * frame(b, j) * in_plane.block<2, 2>(2 * i, 2 * j);
      tangent.block<2, 2>(2 * a, 2 * b) = block;
    }
  return tangent;
}
} // namespace

SpaceResponse space_response(const Law law, const Eigen::Matrix3d &C, const SpaceGradient &F,
                             const Tangent tangent)
{
  const MetricResponse metric = metric_response(law, C, F);
  const Eigen::Matrix2d S     = symmetric(metric.force);
  SpaceResponse response;
  response.energy = metric.energy;
  response.stress = F * S;
  if (tangent == Tangent::exact)
    response.tangent = tangent_of<3>(F, metric.stiffness, S);
  else if (tangent == Tangent::projected)
    response.tangent = positive_tangent(F, metric.stiffness, S);
  return response;
}
} // namespace homespun::verification
