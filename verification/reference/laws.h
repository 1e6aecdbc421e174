// SPDX-License-Identifier: MIT
// The membrane laws of the fine-scale references, in the plane, as functions of the deformation
// gradient F. Written apart from the coarse cloth's element, which one of them must equal.
#pragma once

#include "meshes/plain/law.h"
#include "meshes/plain/yarn_axes.h"
#include "verification/yarns/response.h"

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

/// The response of a law at a deformation gradient.
///
/// biot: with a = F11 + F22, b = F21 − F12, r = |(a, b)| the rotation of the polar decomposition is
/// R = (a, −b; b, a)/r and U = R^T F. Where det F > 0 this U is sqrt(F^T F); where det F < 0 it has
/// a negative principal stretch, which costs energy, as in the coarse cloth. For r = 0 the energy
/// is infinite, which makes a line search step back.
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
  Response response(const Eigen::Matrix2d &F) const;

  const Eigen::Matrix3d &stiffness() const
  {
    return C;
  }

private:
  Law law;
  Eigen::Matrix3d C;
  meshes::YarnAxes yarns; ///< found under a law of yarns alone
};

/// The tangent with its negative eigenvalues set to zero, for Newton steps away from stability.
Eigen::Matrix4d positive_part(const Eigen::Matrix4d &tangent);
} // namespace homespun::verification
