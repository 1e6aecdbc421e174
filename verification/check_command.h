// SPDX-License-Identifier: MIT
// What `homespun check` says of a cell, for whoever has just made one.
#pragma once

#include "homogenization/cell_reading.h"

#include <string>

namespace homespun::verification
{
/// Reads a cell and prints what it is, its warnings, and on the error stream its errors. First rank.
homogenization::CellReading tell_findings(const std::string &file);
} // namespace homespun::verification
