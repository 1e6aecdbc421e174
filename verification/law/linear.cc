// SPDX-License-Identifier: MIT
// The law `linear`: W = ½ e:C:e, e = sym(F − I), which changes under rotations and is no law of a
// sheet in space.
#include "verification/law/law_at_a_point.h"

namespace homespun::verification
{
namespace
{
Response linear_in_plane(const PhaseStiffness &phase, const Eigen::Matrix2d &F)
{
  const Eigen::Matrix3d &C = phase.C;
  const Eigen::Vector3d strain(F(0, 0) - 1., F(1, 1) - 1., F(0, 1) + F(1, 0));
  Eigen::Matrix<double, 3, 4> B; // strain by F11, F12, F21, F22
  B << 1., 0., 0., 0.,           //
    0., 0., 0., 1.,              //
    0., 1., 1., 0.;
  const Eigen::Vector3d force = C * strain;
  return {0.5 * strain.dot(force), B.transpose() * force, B.transpose() * C * B};
}
} // namespace

const LawAtAPoint linear_law{linear_in_plane, nullptr};
} // namespace homespun::verification
