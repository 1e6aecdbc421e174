// SPDX-License-Identifier: MIT
// Which files somebody gives for which levels, by their names or by a table.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

namespace homespun::verification
{
struct GivenFile
{
  std::string path;
  std::string row = {}; ///< of the table that names it, as in `table.csv, line 2: `; else empty
  double seconds  = std::numeric_limits<double>::quiet_NaN(); ///< of the method; none: not told
};

/// Files by what a level or a frame is called, `strip-1-biot-0.01` or `biot-0004`: that is the name
/// of a file without its ending. In a table, .csv with columns load, law, strain, file and, where
/// it is known, seconds, or reference, frame, file, a row tells the level or frame of a file, whose
/// path counts from the folder of the table.
/// @param given files, tables, folders of files, in which hidden ones are passed over
/// @throws BadInput with a message per file or row that cannot be
std::map<std::string, GivenFile> files_by_level(const std::vector<std::string> &given);
} // namespace homespun::verification
