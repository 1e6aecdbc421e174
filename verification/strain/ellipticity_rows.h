// SPDX-License-Identifier: MIT
// From which strain on a load has triangles that are not elliptic, read off ellipticity.csv.
#pragma once

#include "verification/strain/strain_tables.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// The strain at which the first triangle is lost, with `least` linear in strain between the levels
/// and 1 at rest.
/// @param rows of one cell, load, reference and part, in any order
/// @return not a number where every level is elliptic
double strain_of_loss(const std::vector<EllipticityRow> &rows);

/// The same, of the part that is lost first.
/// @param all rows of ellipticity.csv
double elliptic_up_to(const std::vector<EllipticityRow> &all, const std::string &cell,
                      const std::string &load, const std::string &reference);
} // namespace homespun::verification
