// SPDX-License-Identifier: MIT
// The elastic energy of a displacement in linear theory, from the positions alone: the upper side
// of the energy of a sheet. Written apart from the references, whose positions it judges.
#pragma once

#include "meshes/plain/sheet.h"
#include "verification/reference/loads.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::verification
{
/// Of a displacement u that is linear in each triangle, with eps = sym grad u and sigma = C : eps.
struct DisplacementEnergy
{
  double energy    = 0.; ///< J = 1/2 integral eps : sigma [J]
  double round_off = 0.; ///< bound on what rounded positions do to it [J]

  /// Half the work of sigma on the affine displacement a that has the same prescribed values,
  /// 1/2 integral eps(a) : sigma [J]. At the minimum over the displacements of this mesh it equals
  /// the energy (Clapeyron): u − a vanishes where the sheet is held, and sigma does no work on it.
  double affine_work          = 0.;
  double round_off_of_work    = 0.; ///< of energy − affine_work [J]
  double force_size           = 0.; ///< norm of the element forces before they cancel [N]
  double distance_from_affine = 0.; ///< |u − a|, norm over the vertices [m]

  /// How far energy and affine_work may lie apart where the forces on free vertices are at most
  /// this part of force_size, by Cauchy and Schwarz: half of forces . (u − a) [J].
  double largest_misfit(const double relative_residual) const
  {
    return 0.5 * relative_residual * force_size * distance_from_affine + round_off_of_work;
  }
};

/// By the principle of minimum potential energy no displacement with the prescribed values has less
/// energy than the solution: J is an upper bound of the exact energy.
/// @param stiffness_of_phase (3,3) [N/m]
/// @param load of a sheet
/// @param positions (n,2) at the vertices of the sheet [m]
DisplacementEnergy displacement_energy(const meshes::Sheet &sheet,
                                       const std::vector<Eigen::Matrix3d> &stiffness_of_phase,
                                       const Load &load, double strain,
                                       const meshes::Points &positions);

/// The strain (11, 22, 2 x 12) of the affine displacement that has the prescribed values of a load.
Eigen::Vector3d affine_strain(const meshes::Sheet &sheet, const Load &load, double strain);
} // namespace homespun::verification
