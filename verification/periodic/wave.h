// SPDX-License-Identifier: MIT
// Waves of displacement in an infinite cloth of cells, and those that stand for all of them.
//
//   v(y + a_i) = exp(2 pi i k_i) v(y)    k in [0,1)^2, in the basis that is reciprocal to a1, a2
//
// k and k plus whole numbers are one wave, k and −k are conjugate: half of the zone is enough. The
// limit of long waves, k -> 0 along a direction n of the cloth, is no wave of its own but belongs
// to the infimum.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace homespun::verification
{
struct Wave
{
  enum class Kind
  {
    bloch,     ///< of a finite length
    long_limit ///< k -> 0 along a direction
  };

  Kind kind         = Kind::bloch;
  Eigen::Vector2d k = Eigen::Vector2d::Zero(); ///< of a finite wave [-]
  double angle      = 0.;                      ///< of the direction n of a long one [rad]

  bool is_long() const
  {
    return kind == Kind::long_limit;
  }

  /// "k = (1/2, 1/3)" or "long, at 30 degrees from axis 1".
  std::string text() const;
};

/// A wave of finite length.
Wave bloch_wave(double k1, double k2);

/// The limit of long waves along n = (cos, sin).
Wave long_wave(double angle);

/// 12 of them, every 15 degrees.
std::vector<Wave> long_waves();

/// Those, and 37 waves that divide the zone evenly, in eighths and in thirds, one of each k and −k.
std::vector<Wave> waves_of_the_zone();

/// The smallest supercell n1 x n2 in which a wave is periodic, with up to `most` cells along each
/// lattice vector; that nearest to the wave where none is.
Eigen::Vector2i supercell_of(const Wave &wave, int most);
} // namespace homespun::verification
