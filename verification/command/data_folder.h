// SPDX-License-Identifier: MIT
// Where the files are that the program brings along: cells, scenes, the report, and its larger
// part.
#pragma once

#include <string>

namespace homespun::verification
{
/// The folder share/homespun/INSTALLED of the prefix in which the running program is installed, and
/// for a program that runs in its build tree the folder IN_SOURCES of the sources. The prefix is
/// found from the program itself, so that an installed tree may be moved and never reads the
/// sources.
std::string data_folder(const std::string &installed, const std::string &in_sources);

/// The path of `homespun-full`: the running program itself, or beside it in a build tree, or where
/// it was installed with the running one.
std::string full_program();

/// The folder of the shipped cells: where they were installed with the program, or in the sources.
std::string cells_folder();
} // namespace homespun::verification
