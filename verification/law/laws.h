// SPDX-License-Identifier: MIT
// The membrane laws of the fine-scale references, in the plane, as functions of the deformation
// gradient F. Written apart from the coarse cloth's element, which one of them must equal.
#pragma once

#include "meshes/plain/law.h"
#include "verification/law/law_at_a_point.h"

#include <Eigen/Core>

namespace homespun::verification
{
using meshes::all_laws;
using meshes::Law;
using meshes::law_of;
using meshes::name_of;

/// Whether a law is one of yarns: it needs axes.
inline bool is_of_yarns(const Law law)
{
  return meshes::properties_of(law).has_yarns;
}

/// The response of a law at a deformation gradient; what is special of a law is said in its file.
/// @param C membrane stiffness (3,3) [N/m], Voigt 11, 22, 12 with engineering shear
/// @param F deformation gradient (2,2)
Response response(Law law, const Eigen::Matrix3d &C, const Eigen::Matrix2d &F);

/// A law of one phase: response() with what does not depend on the deformation found once. The axes
/// of yarns take longer to find than their law takes to answer.
class LawOfPhase
{
public:
  /// @param stiffness (3,3) [N/m]
  LawOfPhase(Law law, const Eigen::Matrix3d &stiffness);

  /// As response(), whose remarks hold.
  /// @param F deformation gradient (2,2)
  Response response(const Eigen::Matrix2d &F) const
  {
    return law->in_plane(phase, F);
  }

  /// The same as a function of the metric, of a sheet in space, which the law must be one of.
  /// @param F (3,2)
  MetricResponse by_metric(const SpaceGradient &F) const;

  const Eigen::Matrix3d &stiffness() const
  {
    return phase.C;
  }

private:
  const LawAtAPoint *law;
  PhaseStiffness phase;
};

/// The tangent with its negative eigenvalues set to zero, for Newton steps away from stability.
Eigen::Matrix4d positive_part(const Eigen::Matrix4d &tangent);
} // namespace homespun::verification
