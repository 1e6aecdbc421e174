// SPDX-License-Identifier: MIT
#include "verification/periodic/wave.h"

#include "verification/record/number_text.h"

#include <cmath>

namespace homespun::verification
{
namespace
{
/// A number as a fraction with a small denominator, where it is one.
std::string fraction_text(const double value)
{
  for (const int below : {1, 2, 3, 4, 5, 6, 8, 16, 32, 64, 128, 256})
    if (const double above = value * below; std::abs(above - std::round(above)) < 1e-9)
    {
      const std::string text = std::to_string(std::lround(above));
      return below == 1 || above == 0. ? text : text + "/" + std::to_string(below);
    }
  return short_text(value);
}
} // namespace

std::string Wave::text() const
{
  return is_long() ? "long, at " + short_text(std::round(1800. * angle / M_PI) / 10.) +
                       " degrees from axis 1"
                   : "k = (" + fraction_text(k(0)) + ", " + fraction_text(k(1)) + ")";
}

Wave bloch_wave(const double k1, const double k2)
{
  Wave wave;
  wave.k = {k1, k2};
  return wave;
}

Wave long_wave(const double angle)
{
  Wave wave;
  wave.kind  = Wave::Kind::long_limit;
  wave.angle = angle;
  return wave;
}

std::vector<Wave> long_waves()
{
  constexpr int n_directions = 12;
  std::vector<Wave> waves;
  for (int j = 0; j < n_directions; ++j)
    waves.push_back(long_wave(M_PI * j / n_directions));
  return waves;
}

std::vector<Wave> waves_of_the_zone()
{
  std::vector<Wave> waves = long_waves();
  for (const int parts : {8, 3})
    for (int i = 0; i <= parts / 2; ++i)
      for (int j = 0; j < parts; ++j)
      {
        const bool is_own_conjugate_row = i == 0 || 2 * i == parts;
        if (is_own_conjugate_row && 2 * j > parts)
          continue; // −k is there
        if (i + j > 0)
          waves.push_back(
            bloch_wave(static_cast<double>(i) / parts, static_cast<double>(j) / parts));
      }
  return waves;
}

Eigen::Vector2i supercell_of(const Wave &wave, const int most)
{
  Eigen::Vector2i cells(1, 1);
  if (wave.is_long())
    return cells;
  for (int a = 0; a < 2; ++a)
  {
    double least = 1.;
    for (int n = 1; n <= most; ++n)
      if (const double miss = std::abs(n * wave.k(a) - std::round(n * wave.k(a)));
          miss < least - 1e-9)
      {
        least    = miss;
        cells(a) = n;
      }
  }
  return cells;
}
} // namespace homespun::verification
