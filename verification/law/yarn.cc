// SPDX-License-Identifier: MIT
// The law `yarn`: a cloth whose yarns are stretched and turned against each other.
//   e = (|f1| − 1, |f2| − 1, gamma),   W = ½ e·C·e,   f_i = F a_i,
// a1, a2 the axes of the yarns at rest (meshes/plain/yarn_axes.h), C the stiffness in them, gamma
// the angle by which the yarns have left the right angle: sin gamma = f1·f2 / (|f1| |f2|). It has
// the same C at small strain as the other laws, does not change under rotations, and a yarn that is
// pulled keeps its resistance to being turned: the plane wave along a1 that moves along a2 costs
// C66/l1² + T1/l1, positive in every tension and lost at T1 = −C66/l1, where a compressed yarn
// kinks. Compare ellipticity.h of the laws `biot` and `green`.
//
// It belongs to what has yarns. A stiffness that is alike in all directions has no axes; there the
// law is `biot`.
#include "verification/law/law_at_a_point.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
namespace
{
/// gamma is the signed angle, from −pi to pi, so that a triangle that is turned over costs energy,
/// as under biot. Of a yarn without length the energy is infinite, which makes a line search step
/// back.
Response yarn_in_plane(const PhaseStiffness &phase, const Eigen::Matrix2d &F)
{
  const meshes::YarnAxes &yarns = phase.yarns;
  if (!yarns.are_there)
    return biot_law.in_plane(phase, F);
  const Eigen::Vector2d f1 = F * yarns.axes.col(0), f2 = F * yarns.axes.col(1);
  const double l1 = f1.norm(), l2 = f2.norm();
  if (!(l1 > 0. && l2 > 0.))
    return {std::numeric_limits<double>::infinity(), Eigen::Vector4d::Zero(),
            Eigen::Matrix4d::Zero()};
  const Eigen::Vector2d t1 = f1 / l1, t2 = f2 / l2, n1(-t1(1), t1(0)), n2(-t2(1), t2(0));
  const double gamma = std::atan2(f1.dot(f2), f1(0) * f2(1) - f1(1) * f2(0));
  const Eigen::Vector3d strain(l1 - 1., l2 - 1., gamma);
  const Eigen::Vector3d T = yarns.C * strain;

  // By (f1, f2): each yarn's length grows along it, its angle across it; gamma is the first angle
  // less the second.
  Eigen::Matrix<double, 3, 4> B = Eigen::Matrix<double, 3, 4>::Zero();
  B.row(0).head<2>()            = t1;
  B.row(1).tail<2>()            = t2;
  B.row(2) << n1.transpose() / l1, -n2.transpose() / l2;
  Eigen::Matrix4d tangent = B.transpose() * yarns.C * B;
  const auto mixed        = [](const Eigen::Vector2d &t, const Eigen::Vector2d &n)
  { return Eigen::Matrix2d(t * n.transpose() + n * t.transpose()); };
  tangent.topLeftCorner<2, 2>() +=
    T(0) / l1 * n1 * n1.transpose() - T(2) / (l1 * l1) * mixed(t1, n1);
  tangent.bottomRightCorner<2, 2>() +=
    T(1) / l2 * n2 * n2.transpose() + T(2) / (l2 * l2) * mixed(t2, n2);

  // (f1, f2) by F11, F12, F21, F22.
  Eigen::Matrix4d G;
  for (int yarn = 0; yarn < 2; ++yarn)
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 4; ++j)
        G(2 * yarn + i, j) = j / 2 == i ? yarns.axes(j % 2, yarn) : 0.;
  return {0.5 * strain.dot(T), G.transpose() * (B.transpose() * T), G.transpose() * tangent * G};
}

/// By E in the axes of the yarns, of a sheet in space, where the area has no sign. Where yarns lie
/// along each other the angle has no derivative; the area ratio is then taken as 1e-9 of
/// |f1| |f2|, and a yarn's length as 1e-9 at least, which keeps all values finite.
/// @param C stiffness in the axes (3,3) [N/m]
MetricResponse response_in_axes(const Eigen::Matrix3d &C, const Eigen::Vector3d &f1,
                                const Eigen::Vector3d &f2)
{
  constexpr double least = 1e-9;
  const double length1 = f1.norm(), length2 = f2.norm();
  const double l1 = std::max(length1, least), l2 = std::max(length2, least);
  const double g11 = l1 * l1, g22 = l2 * l2, g12 = f1.dot(f2), area = f1.cross(f2).norm();
  const double J = std::max(area, least * l1 * l2), J3 = J * J * J;
  const Eigen::Vector3d strain(length1 - 1., length2 - 1., std::atan2(g12, area));
  const Eigen::Vector3d T = C * strain;
  Eigen::Matrix3d B;    // of the strain by E11, E22, 2 E12 in the axes
  B << 1. / l1, 0., 0., //
    0., 1. / l2, 0.,    //
    -g12 / (J * g11), -g12 / (J * g22), 1. / J;
  Eigen::Matrix3d H = B.transpose() * C * B;
  H(0, 0) -= T(0) / (g11 * l1);
  H(1, 1) -= T(1) / (g22 * l2);
  Eigen::Matrix3d angle; // second derivative of gamma
  angle << g12 * (g22 / (J3 * g11) + 2. / (J * g11 * g11)), g12 / J3, -g22 / J3, //
    g12 / J3, g12 * (g11 / (J3 * g22) + 2. / (J * g22 * g22)), -g11 / J3,        //
    -g22 / J3, -g11 / J3, g12 / J3;
  H += T(2) * angle;
  return {0.5 * strain.dot(T), B.transpose() * T, H};
}

MetricResponse yarn_by_metric(const PhaseStiffness &phase, const SpaceGradient &F)
{
  const meshes::YarnAxes &yarns = phase.yarns;
  if (!yarns.are_there)
    return biot_law.by_metric(phase, F);
  const MetricResponse in_axes =
    response_in_axes(yarns.C, F * yarns.axes.col(0), F * yarns.axes.col(1));
  return {in_axes.energy, yarns.turns.transpose() * in_axes.force,
          yarns.turns.transpose() * in_axes.stiffness * yarns.turns};
}
} // namespace

const LawAtAPoint yarn_law{yarn_in_plane, yarn_by_metric};
} // namespace homespun::verification
