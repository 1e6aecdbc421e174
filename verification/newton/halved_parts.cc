// SPDX-License-Identifier: MIT
#include "verification/newton/halved_parts.h"

namespace homespun::verification
{
GoneWay go_in_halves(const unsigned int most_halvings,
                     const std::function<void(double from, double to)> &go_part)
{
  GoneWay way;
  const unsigned long whole = 1UL << most_halvings; // in units of the shortest part
  for (unsigned long at = 0; at < whole;)
  {
    unsigned long length = at == 0 ? whole : at & (~at + 1);
    while (true)
      try
      {
        go_part(static_cast<double>(at) / static_cast<double>(whole),
                static_cast<double>(at + length) / static_cast<double>(whole));
        break;
      }
      catch (const meshes::NotConverged &failure)
      {
        way.failure.emplace(failure);
        if (length == 1)
          return way;
        length /= 2;
      }
    at += length;
    way.reached = static_cast<double>(at) / static_cast<double>(whole);
    ++way.n_parts;
  }
  return way;
}
} // namespace homespun::verification
