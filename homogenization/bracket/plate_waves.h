// SPDX-License-Identifier: MIT
// Waves out of plane of an infinite sheet that is pressed in its plane: where it wrinkles. A sheet
// of length L that is pulled by T across the waves holds them like a foundation, K = T (pi/L)^2,
// and under the compression s, its membrane stress s N with N of the cell, a wave needs
//   min over w of integral (kappa(w).D.kappa(w) + K w^2) − s integral −N_ij w,i w,j < 0,
// w = v(x) exp(i k.x) with v of the cell's period (Floquet and Bloch). Of D^H alone, for k along
// the compression: s(k) = D^H_nn k^2 + K / k^2, least at k^4 = K / D^H_nn, 2 sqrt(K D^H_nn). Source
// of the foundation: E. Cerda and L. Mahadevan, Geometry and physics of wrinkling, Phys. Rev. Lett.
// 90 (2003).
#pragma once

#include "homogenization/bracket/plate.h"
#include "homogenization/cell/torus_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::homogenization
{
/// Where a pressed sheet begins to wrinkle.
struct WrinkleOnset
{
  double wavenumber;  ///< |k| [1/m]
  double compression; ///< s [N/m]
};

class PlateWaves
{
public:
  /// @param bending_stiffness_of_material D [N m]
  /// @param stress N in each triangle per unit compression (3,m), 11, 22, 12 [-]
  PlateWaves(const TorusMesh &mesh,
             const std::vector<Eigen::Matrix3d> &bending_stiffness_of_material,
             const Eigen::Matrix3Xd &stress);

  /// The compression at which waves of a wave vector begin.
  /// @param foundation K, on the material [N/m^3]
  /// @throws NotConverged where no compression makes them
  double compression(const Eigen::Vector2d &wave_vector, double foundation) const;

  /// The least of all compressions for wave vectors along a direction, from half of a length to
  /// twice it.
  /// @param direction of length 1
  /// @throws NotConverged where the least one lies at an end of that range, or as compression()
  WrinkleOnset onset(const Eigen::Vector2d &direction, double wavenumber, double foundation) const;

private:
  using Element = Eigen::Matrix<double, 12, 12>;

  /// A triangle's quadratic forms, and where its degrees of freedom lie, seen from where each was
  /// met first.
  struct Triangle
  {
    std::array<int, 12> dofs;
    Eigen::Matrix<double, 12, 2> offset; ///< [m]
    /// |rows times values|^2 is the energy of bending. The product of the rows has entries whose
    /// rounding is that energy's, in waves of many triangles.
    Eigen::Matrix<double, 36, 12> rows;
    Element deflection, pressed_slopes; ///< of w^2 and −N_ij w,i w,j
  };

  /// integral kappa.D.kappa + K w^2, of values w without exp(i k.x) of where each was met first.
  double energy(const Eigen::VectorXcd &wave, const Eigen::Vector2d &wave_vector,
                double foundation) const;

  std::vector<Triangle> triangles;
  int n_dofs = 0;
};

/// The stress of a cell under uniaxial compression of 1, mean −n (x) n: (3,m), means of the
/// triangles.
/// @param stiffness_of_material C [N/m]
/// @throws as CompatibleStrain
Eigen::Matrix3Xd stress_of_compression(const TorusMesh &mesh,
                                       const std::vector<Eigen::Matrix3d> &stiffness_of_material,
                                       const Eigen::Vector2d &direction);
} // namespace homespun::homogenization
