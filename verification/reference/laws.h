// SPDX-License-Identifier: MIT
// The membrane laws of the fine-scale references, in the plane, as functions of the deformation
// gradient F. Written apart from the coarse cloth's element, which one of them must equal.
#pragma once

#include "meshes/plain/yarn_axes.h"
#include "verification/yarns/response.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace homespun::verification
{
/// linear: W = ½ e:C:e,            e = sym(F − I)
/// biot:   W = ½ (U−I):C:(U−I),    U = sqrt(F^T F)
/// green:  W = ½ E:C:E,            E = ½ (F^T F − I)  (St. Venant-Kirchhoff)
/// yarn:   W = ½ e:C:e,            e of the stretches of two yarns and their angle (yarn_law.h);
///         biot where C has no axes
enum class Law
{
  linear,
  biot,
  green,
  yarn
};

/// Whether a law is one of yarns: it needs axes.
inline bool is_of_yarns(const Law law)
{
  return law == Law::yarn;
}

/// Every law, in this order.
const std::vector<Law> &all_laws();

std::string name_of(Law law);

/// @throws BadInput naming what to take in its place, where a law of that name was removed
void refuse_removed_law(const std::string &name);

/// @throws BadInput listing the names, where it is none of them, or one that was removed
Law law_of(const std::string &name);

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
