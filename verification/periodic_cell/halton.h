// SPDX-License-Identifier: MIT
// Points that fill a box evenly, the same every time.
#pragma once

namespace homespun::verification
{
/// Radical inverse of an index: with bases without a common factor, the coordinates of the points
/// of a Halton sequence.
/// @param index from 1
/// @return 0 to 1
inline double halton(int index, const int base)
{
  double value = 0., digit = 1.;
  for (; index > 0; index /= base)
  {
    digit /= base;
    value += digit * (index % base);
  }
  return value;
}
} // namespace homespun::verification
