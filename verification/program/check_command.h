// SPDX-License-Identifier: MIT
// What `homespun check` says of a cell, for whoever has just made one.
#pragma once

#include "homogenization/lint/cell_reading.h"
#include "verification/command/command.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// Reads a cell and prints what it is, its warnings, and on the error stream its errors. First
/// rank.
homogenization::CellReading tell_findings(const std::string &file);

/// Writes check.json into a folder and leaves a picture of each cell, as .svg and .png, to be drawn
/// there. First rank.
void write_pictures(const std::vector<homogenization::CellReading> &readings,
                    const std::string &folder, AfterMpi &afterwards);
} // namespace homespun::verification
