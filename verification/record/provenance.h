// SPDX-License-Identifier: MIT
// Where a result comes from: versions, flags, machine, date, revision.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace homespun::verification
{
/// The revision of the sources; of sources that were changed since, with a checksum of the program
/// itself.
std::string revision();

/// Versions of homespun and of every library, compiler, flags, host, processor, date (UTC), ranks.
nlohmann::ordered_json provenance(unsigned int n_ranks);

/// The same in one line, for the attribute of a file.
std::string provenance_line();

/// The text of `homespun --version`.
/// @param program the file that solves, whose checksum stands where the revision is not all
std::string version_text(const std::string &program);
} // namespace homespun::verification
