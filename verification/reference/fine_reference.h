// SPDX-License-Identifier: MIT
// The resolved solution that an up-sampled cloth is held against: every triangle of the sheet, or
// of one cell of an infinite cloth, with its own stiffness. Newton's method with line search, load
// stepping with warm start, a preconditioner kept between steps.
#pragma once

#include "meshes/plain/sheet.h"
#include "verification/law/laws.h"
#include "verification/newton/arc_length.h"
#include "verification/reference/known_field.h"
#include "verification/reference/load_forces.h"
#include "verification/reference/loads.h"

#include <mpi.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace homespun::verification
{
/// One solved strain level.
struct ReferenceStep
{
  double strain = 0.;
  bool reached  = false;         ///< false: no equilibrium found, `why` says where it stopped
  std::string why;               ///< reason where it was not reached
  double stopped_at = 0.;        ///< where it was not reached: strain of the last equilibrium
  meshes::Points positions;      ///< (n,2) at the vertices of the sheet, on every rank [m]; of the
                                 ///< last equilibrium where it was not reached, none without one
  unsigned int n_newton    = 0;  ///< Newton steps
  unsigned int n_linear    = 0;  ///< iterations of conjugate gradients, all Newton steps
  double relative_residual = 0.; ///< |forces on free nodes| / size of the element forces
  double energy = 0.; ///< of the level, in all elements; less the work of a body force [J]
  LoadForces forces;  ///< of the clamps, and the mean stress, from the elements themselves
  unsigned int n_indefinite = 0; ///< triangles whose tangent has a negative eigenvalue, at the last
                                 ///< assembly of the exact tangent
  bool is_at_round_off =
    false; ///< that is more than the tolerance, but rounding alone makes as much
  unsigned int n_inverted = 0;  ///< triangles with det F <= 0, under biot and green
  double seconds          = 0.; ///< wall time of this level, slowest rank
};

/// What the second variation of the energy says of an equilibrium.
enum class Stability
{
  every_triangle, ///< no triangle has a tangent with a negative eigenvalue: stable
  stable,         ///< some have; the tangent of the sheet is positive definite
  left,           ///< it was not: the state was left along its mode, and a stable one was found
  unstable,       ///< it is not, and no stable state was found along its mode
  unknown         ///< conjugate gradients gave no answer
};

/// As in levels.csv: "every triangle", "stable", "left", "unstable", "unknown".
std::string name_of(Stability stability);

/// What a reader has to know of a level that ended at round-off: empty unless it left more than a
/// millionth of the forces.
std::string note_of_round_off(const ReferenceStep &step);

/// The equilibria beyond the level solved last, followed by their arc length.
struct ReferencePath
{
  FollowedPath path;
  meshes::Points
    positions; ///< (n,2) of the equilibrium at the largest strain, none without one [m]
};

struct ReferenceOptions
{
  unsigned int order  = 1; ///< P1 or P2
  unsigned int refine = 0; ///< uniform refinements of the sheet's mesh
  double tolerance =
    1e-9; ///< of |residual| relative to the size of the element forces; no smaller than round-off
};

/// A resolved sheet under one load and one law, brought from strain to strain.
class FineReference
{
public:
  /// @param sheet n1 x n2 cells; of periodic loads what repeats, mostly one cell
  /// @param stiffness_of_phase (3,3) [N/m]
  FineReference(const meshes::Sheet &sheet, std::vector<Eigen::Matrix3d> stiffness_of_phase,
                const ReferenceOptions &options, MPI_Comm communicator);
  ~FineReference();

  /// Force per rest area [N/m^2] at a rest point and a strain. The loads of a study have none; a
  /// solution that is prescribed (manufactured.h) needs one.
  using BodyForce =
    std::function<Eigen::RowVector2d(const Eigen::RowVector2d &rest_point, double strain)>;

  /// Takes up a load and a law, and forgets earlier levels. The first call for a load lays out the
  /// matrix.
  void start(const Load &load, Law law, BodyForce body_force = {});

  /// Solves at a strain, from the levels solved before: u(s) is extrapolated, u/s linear in s. A
  /// step that does not converge is cut in two, up to three times; after that the level counts as
  /// not reached, and the ones solved before stay. Under green a state with an inverted triangle
  /// (det F <= 0) has infinite energy, because that law would reward it; under biot it is allowed
  /// (its energy is that of the coarse cloth, smooth through the collapse) and counted.
  ReferenceStep advance(double strain);

  /// How far the level solved last is from a known displacement, in the interior of the elements
  /// too; of periodic loads from a known fluctuation, up to a constant.
  FieldDistance distance_from(const KnownField &known) const;

  /// The last level once more from where it stands, to a smaller tolerance; later levels start from
  /// the result.
  /// @param tolerance of |residual| relative to the size of the element forces
  ReferenceStep tighten(double tolerance);

  /// Whether the level solved last is a minimum of the energy, asked only where some triangle's
  /// tangent has a negative eigenvalue. Conjugate gradients solve for a random force to 1e-6 of it:
  /// a mode of negative curvature whose share of the force is larger than that would keep its part
  /// of the residual, so they end without meeting one only if there is none, but for a chance of
  /// about 1e-6 sqrt(n) for n unknowns. A direction of negative curvature that they meet is
  /// followed to a lower energy, and the equilibrium sought from there, up to three times.
  /// @param step the level as advance() returned it; gets the new positions where it was left
  Stability stabilize(ReferenceStep &step);

  /// What the last equilibrium before a level that was not reached is. Nothing goes on from it.
  /// @return `unknown` where there is none
  Stability stability_of_last(const ReferenceStep &stopped);

  /// Follows the equilibria from the level solved last by their arc length, round a limit point if
  /// there is one. Nothing goes on from it. On one rank, by factors of the tangent; of a load with
  /// free sides, and under `linear`, nothing is followed.
  /// @param first_step of the strain
  ReferencePath follow(double goal, double first_step);

  unsigned long n_dofs() const;

private:
  class Solver; ///< with the finite elements, of which users of this header see nothing
  const std::unique_ptr<Solver> solver;
};
} // namespace homespun::verification
