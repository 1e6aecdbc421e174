// SPDX-License-Identifier: MIT
#include "verification/law/space_laws.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <cmath>

namespace homespun::verification
{
namespace
{
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
  const MetricResponse metric = LawOfPhase(law, C).by_metric(F);
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
