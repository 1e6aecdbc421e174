// SPDX-License-Identifier: MIT
#include "verification/law/laws.h"

#include "meshes/plain/symmetric_eigen.h"

#include <stdexcept>

namespace homespun::verification
{
LawOfPhase::LawOfPhase(const Law law, const Eigen::Matrix3d &stiffness)
    : law(laws_at_a_point[static_cast<std::size_t>(law)])
    , phase{stiffness, {}}
{
  if (is_of_yarns(law))
    phase.yarns = meshes::yarn_axes(stiffness);
}

MetricResponse LawOfPhase::by_metric(const SpaceGradient &F) const
{
  if (law->by_metric == nullptr)
    throw std::logic_error("a law that is none of a sheet in space");
  return law->by_metric(phase, F);
}

Response response(const Law law, const Eigen::Matrix3d &C, const Eigen::Matrix2d &F)
{
  return LawOfPhase(law, C).response(F);
}

Eigen::Matrix4d positive_part(const Eigen::Matrix4d &tangent)
{
  return meshes::positive_part<4>(tangent);
}
} // namespace homespun::verification
