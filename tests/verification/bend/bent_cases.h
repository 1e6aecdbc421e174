// SPDX-License-Identifier: MIT
// Cells that bend, and the places of the methods among bending_methods.
#pragma once

#include "tests/homogenization/cell/cells.h"
#include "verification/bend/plate_sheet.h"

#include <stdexcept>
#include <string>

namespace homespun::verification
{
inline constexpr double side = 0.01;

enum Method
{
  affine,
  localized,
  with_edges,
  full
};

/// Three kinds of stripes along x, of which no mirror line is an edge: all terms have a part.
/// @param n1, n2 squares a cell
inline homogenization::UnitCell three_stripes(const int n1 = 12, const int n2 = 20)
{
  return tests::cell_of(tests::square_lattice(side), n1, n2,
                        {homogenization::isotropic("soft", 1e6, 0.1, 5e-4, 400.),
                         homogenization::isotropic("hard", 2e7, 0.4, 5e-4, 400.),
                         homogenization::isotropic("between", 5e6, 0.2, 5e-4, 400.)},
                        [](const double, const double f2) {
                          return f2 < 0.3 ? 0 : f2 < 0.6 ? 1 : 2;
                        });
}

inline const BendingLoad &load_of(const std::string &name)
{
  for (const BendingLoad &load : bending_loads)
    if (load.name == name)
      return load;
  throw std::logic_error(name);
}
} // namespace homespun::verification
