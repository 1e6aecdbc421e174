// SPDX-License-Identifier: MIT
// The corotational energy of corotational_energy.h in space, of eight triangles at once: the same
// formulas with packs of numbers in place of numbers, one lane per triangle, so that one
// instruction does the work of as many triangles as a register holds. Where a triangle is collapsed
// (J <= 1e-14 tr C), or not finite, the functions of corotational_energy.h take over.
#pragma once

#include "shell/membrane/membrane.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace homespun::shell
{
/// Energies and derivatives of the triangles of a membrane, pack by pack.
class TrianglePacks
{
public:
  static constexpr int size = 8;
  using Pack                = Eigen::Array<double, size, 1>;

  /// @param membrane whose triangles and rest state are taken
  explicit TrianglePacks(const Membrane &membrane);

  /// The stiffness of each phase [N/m] from now on; at first those of the membrane.
  void set_stiffness(const std::vector<MembraneStiffness> &stiffness);

  /// The stiffness of each triangle from now on (m) [N/m].
  void set_stiffness_of_triangles(const std::vector<MembraneStiffness> &stiffness);

  /// Initial stresses T0 of the triangles from now on [N/m]: the energy is area (½ e·D·e + T0·e).
  /// @param stresses (m), or none, which is zero
  void set_initial_stress(const std::vector<Eigen::Vector3d> &stresses);

  /// Biot strains of the triangles, Voigt.
  /// @param positions (n,3) [m]
  /// @param all (m), resized
  void strains(const Positions<3> &positions, std::vector<Eigen::Vector3d> &all) const;

  /// Sum over all triangles [J].
  /// @param positions (n,3) [m]
  double energy(const Positions<3> &positions) const;

  /// What one pack adds to gradient and Hessian.
  struct Derivatives
  {
    /// Rows of the corners, component by component [N].
    std::array<std::array<Pack, 3>, 3> gradient;
    /// Blocks of the corners (0,0) (0,1) (0,2) (1,1) (1,2) (2,2), column by column [N/m].
    std::array<std::array<Pack, 9>, 6> blocks;

    TriangleDerivatives<3> of_lane(int lane) const;
  };

  int n_packs() const
  {
    return static_cast<int>(packs.size());
  }
  int n_triangles() const
  {
    return static_cast<int>(triangles.rows());
  }

  /// Calls take(t, TriangleDerivatives<3>) for each triangle in turn.
  /// @param positions (n,3) [m]
  template <typename Take>
  void derivatives(const Positions<3> &positions, const Hessian kind, const Take &take) const
  {
    Derivatives result;
    for (int p = 0; p < n_packs(); ++p)
    {
      const auto irregular = pack_derivatives(p, positions, kind, result);
      for (int lane = 0; lane < size && p * size + lane < n_triangles(); ++lane)
        take(p * size + lane, irregular[static_cast<std::size_t>(lane)]
                                ? scalar_derivatives(p * size + lane, positions, kind)
                                : result.of_lane(lane));
    }
  }

  std::size_t bytes() const;

private:
  using Lanes   = std::array<bool, size>;
  using Vector3 = std::array<Pack, 3>;

  /// What a pack keeps of its triangles at rest.
  struct Rest
  {
    Pack area, g1x, g1y, g2x, g2y; ///< [m^2], gradients of the hats of corners 1 and 2 [1/m]
    std::array<Pack, 6> D;         ///< 11, 22, 33, 12, 13, 23 [N/m]
    std::array<Pack, 6> inverse;
    Vector3 initial_stress; ///< T0 [N/m]
  };
  struct State;

  State state(int pack, const Positions<3> &positions) const;
  Lanes pack_derivatives(int pack, const Positions<3> &positions, Hessian kind,
                         Derivatives &result) const;
  TriangleDerivatives<3> scalar_derivatives(int t, const Positions<3> &positions,
                                            Hessian kind) const;
  double scalar_energy(int t, const Positions<3> &positions) const;
  Eigen::Matrix3d corners_of(int t, const Positions<3> &positions) const;

  meshes::Triangles triangles;
  std::vector<RestTriangle> rest_triangles;
  std::vector<int> phase;
  std::vector<MembraneStiffness> stiffness;
  std::vector<Eigen::Vector3d> initial_stress;
  std::vector<Rest> packs;
};
} // namespace homespun::shell
