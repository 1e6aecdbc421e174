// SPDX-License-Identifier: MIT
// The least of the eigenvalues of K(k) v = beta K0(k) v over waves, between two sides.
#pragma once

#include "verification/periodic/bloch_pencil.h"

#include <optional>
#include <vector>

namespace homespun::verification
{
/// A least eigenvalue and where it was found.
struct Margin
{
  double beta = 0.; ///< the quotient of `mode`, no less than the least eigenvalue [-]
  /// No wave that was asked is below: inertia by Cholesky factors, up to their rounding.
  double lower = 0.;
  Wave wave;
  Mode mode; ///< empty where no field was found, only the inertia of fields inside the cell
};

/// A stiffness against that at rest. Keeps the last elimination.
class MarginSearch
{
public:
  /// How close the two sides come, relative to 1 + |beta|: the stiffnesses differ by that much more
  /// than by their rounding, and a value is known to more digits than any mesh gives.
  static constexpr double closeness = 1e-9;

  MarginSearch(const BlochPencil &pencil, const CellAssembly::Sparse &stiffness);

  /// Whether every eigenvalue of a wave is above beta: inertia of K(k) − beta K0(k).
  bool is_above(const Wave &wave, double beta);

  /// An upper side that costs little: the best of two plain fields of each wave.
  Margin start(const std::vector<Wave> &waves) const;

  /// Brings an upper side down to the least eigenvalue of some waves, if that is lower:
  /// beta becomes the quotient of the field that shows K − beta K0 to be indefinite, until no wave
  /// shows one (Dinkelbach's method, which converges from above and faster than linearly).
  /// @return the side that was given where no wave is lower; `lower` is that of these waves
  /// @throws NotConverged where the two sides do not meet
  Margin lowered(Margin from, const std::vector<Wave> &waves);

private:
  const BlochPencil::Shifted *shifted(double beta);
  Eigen::MatrixXcd of_wave(const Eigen::MatrixXd &schur, const BlochPencil::Ties &ties) const;
  /// The field of least quotient of S by S at rest, by Lanczos's method.
  Mode lowest(const BlochPencil::Shifted &at, const BlochPencil::Ties &ties) const;

  const BlochPencil &pencil;
  const CellAssembly::Sparse stiffness;
  const SplitStiffness parts;
  std::optional<BlochPencil::Shifted> last;
  std::optional<double> last_beta;
};
} // namespace homespun::verification
