// SPDX-License-Identifier: MIT
// What is wrong with a command line that CLI11 does not take: a command or an option of another
// name, or a file in the place of the command.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Error.hpp>

#include <string>
#include <vector>

namespace homespun::verification
{
/// One line: what was found, what was expected, and what may have been meant.
/// @param app with all commands
/// @param words of the command line, without the name of the program
/// @param error what CLI11 says of them
std::string command_fault(const CLI::App &app, const std::vector<std::string> &words,
                          const CLI::ParseError &error);
} // namespace homespun::verification
