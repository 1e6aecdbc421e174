// SPDX-License-Identifier: MIT
// How far D^H holds: a cell that is rolled up. D^H lets each cell bend by ½ y.K.y beside a
// periodic deflection phi; on a sheet with the curvature K that deflection also stretches the
// sheet, by the strain of Föppl and von Kármán
//   eps(u) + e,   e = ½ grad phi (x) grad phi − phi K,   u periodic, its mean strain free,
// for K = n (x) n / R of a cylinder (other K have a Gauss curvature and are no periodic state). The
// energy per area is ½ D_eff(R)(n) / R^2 with
//   D^H_nn <= D_eff(R) <= min(D^H_nn + Q(n) / R^2, D_inf(n)):
// stretching costs energy; phi of D^H with its best u is one competitor, one that bends without
// stretching another (isometric_bending.h). Both are those of this mesh. The first is exact to
// order R^-4 where D^H itself is, the second in the limit of small R.
// Sources: S. Neukamm and H. Olbermann, Calc. Var. 53 (2015); K. D. Cherdantsev and
// M. I. Cherednichenko, Calc. Var. 54 (2015), on the limit of small R.
#pragma once

#include "homogenization/bracket/isometric_bending.h"
#include "homogenization/cell/torus_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::homogenization
{
/// e of a deflection, 11, 22, 2 12.
/// @param curvature K, 11, 22, 2 12 [1/m]
/// @param deflection phi [m] @param gradient of it [-]
Eigen::Vector3d strain_of_deflection(const Eigen::Vector3d &curvature, double deflection,
                                     const Eigen::Vector2d &gradient);

struct RolledCell
{
  /// Q(n) / D^H_nn for n = (cos angle, sin angle) [m^2].
  double stretching(double angle) const;

  /// D_inf(n) / D^H_nn, of a sheet rolled as tightly as one likes; the mean of D_nn over the cell
  /// in place of D_inf where the ruling is none of `isometric`.
  double stiffest(double angle) const;

  /// Upper bound on D_eff(R) / D^H_nn.
  double most(double angle, double radius) const;

  /// The radius from which on most() is at most 1 + tolerance [m]; 0 where it always is.
  double least_radius(double angle, double tolerance) const;

  /// A direction, in whole degrees from x, and its least_radius() [m].
  struct Roll
  {
    int degrees;
    double radius;
  };

  /// The one of which the largest radius is asked for.
  Roll worst(double tolerance) const;

  Eigen::Matrix3d stiffness;      ///< D^H of the mesh [N m]
  Eigen::Matrix3d mean_stiffness; ///< mean of D, holes counting as zero [N m]
  /// Q for the products 11, 22, 33, 12, 13, 23 of the entries of K [N m^3].
  Eigen::Matrix<double, 6, 6> membrane;
  std::vector<IsometricBending> isometric; ///< of short_rulings()
};

/// @param bending_stiffness_of_material D [N m]
/// @param membrane_stiffness_of_material C [N/m]
/// @throws NotConverged as solve_plate_cell()
RolledCell rolled_cell(const TorusMesh &mesh,
                       const std::vector<Eigen::Matrix3d> &bending_stiffness_of_material,
                       const std::vector<Eigen::Matrix3d> &membrane_stiffness_of_material);
} // namespace homespun::homogenization
