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

/// What a page saves of its figures beside their numbers.
enum class FigureFiles
{
  svg,
  with_pdf
};

/// Makes report.html from folders of results, with Debian's Python.
/// @throws BadInput where the results cannot be read or drawn
void make_report(const std::vector<std::string> &folders, const std::string &output, bool quiet,
                 FigureFiles files = FigureFiles::svg);
} // namespace homespun::verification
