// SPDX-License-Identifier: MIT
// A folder of results is one run: all that lies in it was made from the same inputs with the same
// options by the same revision, and run.json says by which. A run that is begun again takes up what
// it left; another one replaces it, or is refused where work would be lost.
#pragma once

#include "verification/record/earlier.h"

#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <vector>

namespace homespun::verification
{
/// What a run is, in the words of its command.
struct RunDescription
{
  std::string command;           ///< "strain"
  nlohmann::ordered_json inputs; ///< all that the results depend on, but for the revision
};

/// The folder of a run, locked as long as this lives; the lock goes with the process, however that
/// ends. On the first rank alone.
class RunFolder
{
public:
  /// Makes the folder, or takes up the run in it, or removes that and begins anew.
  /// @throws BadInput, with nothing touched, where the folder belongs to a process that runs, holds
  ///   what no run wrote, or holds another run and `earlier` says to keep it
  RunFolder(std::string path, const RunDescription &description, Earlier earlier);
  RunFolder(const RunFolder &)            = delete;
  RunFolder &operator=(const RunFolder &) = delete;
  ~RunFolder();

  /// Whether the folder held this run already.
  bool is_taken_up() const
  {
    return taken_up;
  }

  /// One line for the terminal where an earlier run was replaced, else empty.
  const std::string &notice() const
  {
    return line;
  }

  /// Lists every file with its size and checksum in run.json, and says that the run came to its
  /// end: pages take only what is listed, unchanged.
  void finish();

  const std::string path;

private:
  void write(bool is_finished) const;

  nlohmann::ordered_json json;
  double began  = 0.; ///< of this process [s since 1970]
  int lock      = -1;
  bool taken_up = false;
  std::string line;
};

/// A RunFolder, whose notice goes to the terminal.
std::unique_ptr<RunFolder> open_run_folder(const std::string &path,
                                           const RunDescription &description, Earlier earlier,
                                           bool quiet);

/// Refuses a folder whose run.json has a format that is not read here, and with it its tables.
/// @throws BadInput naming it; a folder without run.json is as good as one of any version
void check_format(const std::string &folder);

/// run.json of a run that ended, and whose files are as it wrote them.
/// @throws BadInput where the folder holds no such run
nlohmann::ordered_json finished_run(const std::string &path);

/// Lists the page and the figures of a finished run, after they were made; what it listed of its
/// results stays. Does nothing where the folder holds no run.
void list_report(const std::string &path);

/// Whether a file or folder lies in a folder or is it, links followed: what a run that begins there
/// would delete.
bool lies_in(const std::string &path, const std::string &folder);

/// The name of a place of the command's own: out/NAMES/COMMAND.
/// @param command as the folder has it: with -quick where the sizes are small
/// @param names of the cells or of the scene, joined by + up to three
std::string default_folder(const std::string &command, const std::vector<std::string> &names);
} // namespace homespun::verification
