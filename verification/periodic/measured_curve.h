// SPDX-License-Identifier: MIT
// A curve of strain against force per width that somebody measured.
#pragma once

#include "verification/periodic/periodic_tables.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// Reads a CSV file whose header names columns of load.csv: strain_11, stress_11_N_per_m and so on,
/// in any order, at least the strain and the stress of one component; other columns are passed
/// over, empty fields stay unknown.
/// @throws BadInput, a message per fault: file, line, column, what was found and expected
std::vector<LoadRow> read_measured_curve(const std::string &file);
} // namespace homespun::verification
