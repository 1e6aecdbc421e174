// SPDX-License-Identifier: MIT
#include "verification/command/report_script.h"

#include "meshes/files/child_process.h"
#include "meshes/plain/errors.h"
#include "verification/build_info.h"
#include "verification/command/data_folder.h"

#include <cstdio>
#include <filesystem>

namespace homespun::verification
{
int run_report_script(const std::string &name, const std::vector<std::string> &arguments)
{
  const std::string folder = data_folder("report", "verification/report"),
                    script = folder + "/" + name, installed = folder + "/schema.json";
  // The sources have no schema: the build keeps it.
  const std::string schema = std::filesystem::exists(installed)
                               ? installed
                               : std::string(HOMESPUN_BUILD_DIR) + "/schema.json";
  // -B: no __pycache__ in a folder that a package manager keeps.
  std::vector<std::string> words = {HOMESPUN_PYTHON, "-B", script};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const int status = meshes::run_child(words, "", {"HOMESPUN_SCHEMA=" + schema});
  if (status == 127)
    throw meshes::BadInput(
      std::string(HOMESPUN_PYTHON) + " " + script +
      ": cannot be run; expected Debian's Python with numpy, h5py, matplotlib and jinja2: "
      "./bootstrap installs them");
  if (const std::string killed = meshes::text_of_signal(status); !killed.empty())
    throw meshes::BadInput(name + " did not end: " + killed);
  return status;
}

void make_report(const std::vector<std::string> &folders, const std::string &output,
                 const bool quiet, const FigureFiles files)
{
  std::vector<std::string> arguments = folders;
  arguments.insert(arguments.end(), {"--output", output});
  if (files == FigureFiles::with_pdf)
    arguments.push_back("--pdf");
  if (quiet)
    arguments.push_back("--quiet");
  else
    std::fprintf(stderr, "Making the page %s/report.html: drawing takes 15 s or more\n",
                 output.c_str());
  if (run_report_script("report.py", arguments) != 0)
  {
    std::string all;
    for (const std::string &folder : folders)
      all += " " + folder;
    throw meshes::BadInput("no page was made, see above; when that is mended, `homespun report" +
                           all + "` makes it");
  }
  if (!quiet)
    std::printf("Report: %s/report.html\n", output.c_str());
}
} // namespace homespun::verification
