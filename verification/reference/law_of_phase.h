// SPDX-License-Identifier: MIT
// A law of one phase: response() of laws.h with what does not depend on the deformation found once.
// The axes of yarns take longer to find than their law takes to answer.
#pragma once

#include "meshes/plain/yarn_axes.h"
#include "verification/reference/laws.h"

#include <Eigen/Core>

namespace homespun::verification
{
class LawOfPhase
{
public:
  /// @param stiffness (3,3) [N/m]
  LawOfPhase(Law law, const Eigen::Matrix3d &stiffness);

  /// As response(), whose remarks hold.
  /// @param F deformation gradient (2,2)
  Response response(const Eigen::Matrix2d &F) const;

  const Eigen::Matrix3d &stiffness() const
  {
    return C;
  }

private:
  Law law;
  Eigen::Matrix3d C;
  meshes::YarnAxes yarns; ///< there under a law of yarns alone
};
} // namespace homespun::verification
