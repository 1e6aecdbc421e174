// SPDX-License-Identifier: MIT
// Ellipticity of a state of a membrane: whether every plane wave in it costs energy. With the
// tangent A = dP/dF and unit vectors n (rest) and a (motion),
//   Q_ik(n) = A_ijkl n_j n_l,    least = min over n of the least eigenvalue of Q(n)
//                                      = min over n and a of (a n):A:(a n).
// A state with least > 0 is strongly elliptic (Legendre and Hadamard). Where least < 0 the energy
// falls along folds of any fineness: there it has no minimiser, and what a solver, a mesh or the
// number of ranks makes of it is no reference.
//
// In the plane, on F = diag(l1, l2), with T the Biot stress, S the second Piola stress and C an
// orthotropic stiffness along the axes, the waves along one axis that move along the other have
//   biot, a along 1, n along 2   (4 C66 l1² − T1 l1 + T2 (l2 + 2 l1)) / (l1 + l2)²
//   green, a along 2, n along 1  S1 + C66 l2²
// so that biot is lost in tension at T1 = 4 C66 l1 under T2 = 0: a cloth that is stiff along its
// yarns and soft in shear loses it at a strain of (4 G/E) / (1 − 4 G/E). Tests hold both against a
// search of all directions.
#pragma once

#include "meshes/plain/triangle_mesh.h"
#include "verification/law/laws.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace homespun::verification
{
/// The plane wave that costs least.
struct LeastWave
{
  double stiffness = 0.;  ///< (a n):A:(a n) [N/m]; not positive: the state is not elliptic
  Eigen::Vector2d normal; ///< n at rest, unit length
  Eigen::Vector2d motion; ///< a, unit length
};

/// The least wave of a tangent. Of det Q(n), a trigonometric polynomial of degree two in twice the
/// angle of n, there are at most two minima; 36 directions find them, and each is refined to
/// round-off.
/// @param tangent dP/dF (4,4) [N/m], F11, F12, F21, F22
LeastWave least_wave(const Eigen::Matrix4d &tangent);

/// Whether (a n):A:(a n) is certainly above a bound for all unit n and a, told without a search:
/// det(Q(n) − bound) = d0 + d1 cos(t − t1) + d2 cos(2 t − t2), t twice the angle of n, bends by no
/// more than d1 + 4 d2, so that 36 values show it to be positive; next to rest of an isotropic
/// phase d1 and d2 are of the order of the strain. False where it is not so, and where this does
/// not tell.
/// @param tangent as above
/// @param bound [N/m]
bool every_wave_is_above(const Eigen::Matrix4d &tangent, double bound);

/// The least wave of a stiffness under a law, as a part of the one at rest: 1 at rest, whatever the
/// unit; not positive where ellipticity is lost. Not finite where the law is not.
class EllipticityOfLaw
{
public:
  /// @param C membrane stiffness (3,3) [N/m], Voigt 11, 22, 12 with engineering shear
  EllipticityOfLaw(Law law, const Eigen::Matrix3d &C);

  /// @param F deformation gradient (2,2)
  double at(const Eigen::Matrix2d &F) const;

  /// at(F), or nothing where that is certainly above a bound that is not negative: no search is
  /// made then.
  std::optional<double> at_unless_above(const Eigen::Matrix2d &F, double bound) const;

private:
  Law law;
  LawOfPhase phase;
  double at_rest;
};

/// The triangles of one phase in one state.
struct PhaseEllipticity
{
  int n_triangles = 0;
  int n_lost      = 0;  ///< of them not elliptic: least is not positive
  double least    = 1.; ///< as a part of the value at rest, of the worst triangle
};

/// Several phases as one.
PhaseEllipticity together(const std::vector<PhaseEllipticity> &phases);

/// Of each phase of a mesh whose triangles deform evenly.
/// @param rest rest.material being the phase of each triangle
/// @param stiffness_of_phase (3,3) [N/m]
/// @param positions (n,2) [m]
std::vector<PhaseEllipticity>
ellipticity_of_phases(const meshes::TriangleMesh &rest,
                      const std::vector<Eigen::Matrix3d> &stiffness_of_phase, Law law,
                      const meshes::Points &positions);
} // namespace homespun::verification
