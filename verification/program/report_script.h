// SPDX-License-Identifier: MIT
// Scripts of the folder report/, run by Debian's Python.
#pragma once

#include <string>
#include <vector>

namespace homespun::verification
{
/// Runs a script on all cores.
/// @return its exit status
/// @throws BadInput where Python cannot be run
int run_report_script(const std::string &name, const std::vector<std::string> &arguments);
} // namespace homespun::verification
