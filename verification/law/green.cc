// SPDX-License-Identifier: MIT
// The law `green` (St. Venant-Kirchhoff): W = ½ E:C:E, S = C E, H = C.
#include "verification/law/law_at_a_point.h"

namespace homespun::verification
{
namespace
{
template <int dim>
MetricResponse green_response(const PhaseStiffness &phase, const Eigen::Matrix<double, dim, 2> &F)
{
  const Eigen::Vector3d strain(0.5 * (F.col(0).squaredNorm() - 1.),
                               0.5 * (F.col(1).squaredNorm() - 1.), F.col(0).dot(F.col(1)));
  const Eigen::Vector3d force = phase.C * strain;
  return {0.5 * strain.dot(force), force, phase.C};
}

Response green_in_plane(const PhaseStiffness &phase, const Eigen::Matrix2d &F)
{
  const MetricResponse metric = green_response<2>(phase, F);
  return {metric.energy, strain_derivative<2>(F).transpose() * metric.force,
          tangent_of<2>(F, metric.stiffness, symmetric(metric.force))};
}
} // namespace

const LawAtAPoint green_law{green_in_plane, green_response<3>};
} // namespace homespun::verification
