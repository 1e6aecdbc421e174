// SPDX-License-Identifier: MIT
#include "verification/record/run_folder.h"

#include "meshes/files/format_version.h"
#include "meshes/plain/errors.h"
#include "verification/record/checksum.h"
#include "verification/record/json_files.h"
#include "verification/record/provenance.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace homespun::verification
{
using meshes::BadInput;
using nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace
{
constexpr double work_worth_keeping = 10.; ///< [s]

double now()
{
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

double time_of(const fs::path &path)
{
  struct stat status = {};
  return ::stat(path.c_str(), &status) == 0 ? static_cast<double>(status.st_mtime) +
                                                1e-9 * static_cast<double>(status.st_mtim.tv_nsec)
                                            : 0.;
}

std::string text_of_duration(const double seconds)
{
  const long whole = std::lround(seconds);
  return whole < 120    ? std::to_string(whole) + " s"
         : whole < 7200 ? std::to_string(whole / 60) + " min"
                        : std::to_string(whole / 3600) + " h";
}

/// The files of a run below its folder, without run.json and without the runs that have a folder of
/// their own in it.
std::vector<std::string> files_in(const std::string &folder)
{
  std::vector<std::string> files;
  for (auto entry = fs::recursive_directory_iterator(folder);
       entry != fs::recursive_directory_iterator(); ++entry)
    if (entry->is_directory() && fs::exists(entry->path() / "run.json"))
      entry.disable_recursion_pending();
    else if (!entry->is_directory() && entry->path().filename() != "run.json")
      files.push_back(fs::relative(entry->path(), folder).string());
  std::sort(files.begin(), files.end());
  return files;
}

/// run.json of a folder; nothing where there is none.
std::optional<ordered_json> description_in(const std::string &folder)
{
  const std::string path = folder + "/run.json";
  if (!fs::exists(path))
    return {};
  std::ifstream input(path);
  ordered_json json = ordered_json::parse(input, nullptr, false);
  const ordered_json version =
    json.is_object() ? json.value("format_version", ordered_json(0)) : ordered_json(0);
  if (const std::string fault = version.is_number_integer()
                                  ? meshes::fault_of_format(path, version.get<int>())
                                  : meshes::fault_of_format(path, version.dump());
      !fault.empty())
    throw BadInput(fault + ", or choose another --output");
  if (!json.is_object() || !json.contains("fingerprint") || !json["fingerprint"].is_string() ||
      !json.contains("seconds") || !json["seconds"].is_number())
    throw BadInput(path + ": is damaged; expected what homespun writes there: remove the folder, " +
                   "or choose another --output");
  return json;
}

/// What lies in a folder and is of no run, told by the list of a run that ended, and by the kinds
/// of files that runs write where one did not.
std::vector<std::string> foreign_files(const std::string &folder,
                                       const std::optional<ordered_json> &earlier)
{
  static const std::set<std::string> kinds = {
    ".csv",  ".json", ".h5",  ".vtu", ".pvtu", ".pvd", ".ply",  ".obj",  ".usda", ".pc2",
    ".html", ".svg",  ".png", ".pdf", ".js",   ".inp", ".comm", ".webp", ".gif",  ".tmp"};
  std::vector<std::string> foreign;
  for (const std::string &file : files_in(folder))
  {
    if (file.find(".homespun-") != std::string::npos)
      continue;
    const bool is_listed =
      earlier && earlier->contains("files") && (*earlier)["files"].contains(file);
    const bool is_finished = earlier && earlier->value("finished", false);
    const bool is_of_run =
      is_listed || (earlier && !is_finished && kinds.count(fs::path(file).extension()) != 0);
    if (!is_of_run)
      foreign.push_back(file);
  }
  return foreign;
}

/// run.json of the runs that have a folder of their own in a folder, but for those that a run of
/// `homespun verify` makes there, of cells, of scenes and of its parts.
std::vector<std::string> runs_within(const std::string &folder, const ordered_json &earlier)
{
  std::set<std::string> own;
  if (earlier.value("command", "") == "verify")
  {
    own = {"cells", "hang", "pull"};
    for (const ordered_json &part : earlier["inputs"].value("parts", ordered_json::array()))
      own.insert(part.get<std::string>());
  }
  std::vector<std::string> runs;
  for (const auto &entry : fs::recursive_directory_iterator(folder))
    if (const fs::path inside = fs::relative(entry.path(), folder);
        entry.path().filename() == "run.json" && inside.has_parent_path() &&
        own.count(inside.begin()->string()) == 0)
      runs.push_back(inside.string());
  return runs;
}

/// Seconds of work that a folder holds.
double work_in(const std::string &folder, const ordered_json &earlier)
{
  double last = 0.;
  for (const auto &entry : fs::recursive_directory_iterator(folder))
    last = std::max(last, time_of(entry.path()));
  const double begun = earlier.value("began", last);
  return earlier.value("finished", false)
           ? earlier["seconds"].get<double>()
           : earlier["seconds"].get<double>() + std::max(0., last - begun);
}

/// What differs between two descriptions, in words.
std::string difference(const ordered_json &earlier, const ordered_json &wanted)
{
  std::string text;
  const auto add = [&](const std::string &one) { text += (text.empty() ? "" : ", ") + one; };
  if (earlier.value("command", "") != wanted["command"])
    add("command " + earlier.value("command", "") + " and not " +
        wanted["command"].get<std::string>());
  if (earlier.value("revision", "") != wanted["revision"])
    add("revision " + earlier.value("revision", "") + " and not " +
        wanted["revision"].get<std::string>());
  const ordered_json none    = ordered_json::object();
  const ordered_json &before = earlier.contains("inputs") ? earlier["inputs"] : none;
  for (const auto &[key, value] : wanted["inputs"].items())
    if (!before.contains(key) || before[key] != value)
      add(key);
  for (const auto &[key, value] : before.items())
    if (!wanted["inputs"].contains(key))
      add(key);
  return text.empty() ? "an unknown difference" : text;
}

/// Refuses results that were changed after their run ended.
void check_unchanged(const std::string &folder, const ordered_json &earlier)
{
  if (!earlier.value("finished", false) || !earlier.contains("files"))
    return;
  std::vector<std::string> faults;
  for (const auto &[file, listed] : earlier["files"].items())
  {
    const std::string path = folder + "/" + file, kind = fs::path(file).extension();
    if ((kind == ".csv" || kind == ".json" || kind == ".h5") && fs::exists(path) &&
        checksum_of_file(path) != listed.value("crc32", ""))
      faults.push_back(path + ": was changed after the run ended; expected what the run wrote: "
                              "restore it, or begin anew with --overwrite");
  }
  if (!faults.empty())
    throw BadInput(faults);
}

void remove_all_in(const std::string &folder)
{
  for (const auto &entry : fs::directory_iterator(folder))
    fs::remove_all(entry.path());
}

ordered_json list_of_files(const std::string &folder)
{
  ordered_json files = ordered_json::object();
  for (const std::string &file : files_in(folder))
    if (file.find(".homespun-") == std::string::npos)
      files[file] = {{"bytes", fs::file_size(folder + "/" + file)},
                     {"crc32", checksum_of_file(folder + "/" + file)}};
  return files;
}
} // namespace

RunFolder::RunFolder(std::string path_of_folder, const RunDescription &description,
                     const Earlier earlier)
    : path(std::move(path_of_folder))
    , began(now())
{
  json                          = {{"format_version", meshes::format_version},
                                   {"command", description.command},
                                   {"revision", revision()},
                                   {"inputs", description.inputs}};
  const std::string fingerprint = checksum_of_text(json.dump());
  const bool was_there          = fs::exists(path);
  if (was_there && !fs::is_directory(path))
    throw BadInput(path + ": found a file; expected a folder: choose another --output");
  fs::create_directories(path);
  lock = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock < 0)
    throw BadInput(path + ": cannot be opened; expected a folder that can be read and written");
  if (flock(lock, LOCK_EX | LOCK_NB) != 0)
  {
    ::close(lock);
    throw BadInput(path +
                   ": another homespun is writing there; expected a folder of this run's own: "
                   "wait for the other one, or choose another --output");
  }
  try
  {
    const std::optional<ordered_json> found = description_in(path);
    const std::vector<std::string> foreign  = foreign_files(path, found);
    const bool is_same                      = found && (*found)["fingerprint"] == fingerprint;
    if (!found && !foreign.empty())
      throw BadInput(path + ": holds " + foreign.front() +
                     (foreign.size() > 1
                        ? " and " + std::to_string(foreign.size() - 1) + " files more"
                        : std::string()) +
                     ", which no run wrote that is told here; expected an empty folder or one with "
                     "the run.json of a run: choose another --output");
    if (is_same && earlier != Earlier::overwrite)
    {
      check_unchanged(path, *found);
      taken_up = true;
    }
    else if (found)
    {
      const double work      = work_in(path, *found);
      const std::string what = path + ": holds another run (" + difference(*found, json) + ")";
      if (earlier == Earlier::resume)
        throw BadInput(what + "; expected the same to --resume: leave that out, or choose another "
                              "--output");
      if (earlier == Earlier::keep_work && work > work_worth_keeping)
        throw BadInput(
          what + ", " + text_of_duration(work) +
          " of work; expected an empty folder or the same run: --overwrite removes it, another "
          "--output keeps both");
      std::vector<std::string> others = runs_within(path, *found);
      others.insert(others.end(), foreign.begin(), foreign.end());
      if (!others.empty())
        throw BadInput(
          path + ": holds " + others.front() +
          ", which the run there did not write; expected nothing of others in a folder that is "
          "begun anew: move it away, or choose another --output");
      remove_all_in(path);
      line = path + ": the earlier run was replaced (" +
             (is_same ? std::string("the same one, begun anew") : difference(*found, json)) + ")";
    }
    json["fingerprint"] = fingerprint;
    json["seconds"]     = taken_up ? work_in(path, *found) : 0.;
    write(false);
  }
  catch (...)
  {
    ::close(lock);
    if (!was_there)
    {
      std::error_code ignored;
      fs::remove(path, ignored);
    }
    throw;
  }
}

RunFolder::~RunFolder()
{
  ::close(lock);
}

void RunFolder::finish()
{
  write(true);
}

void RunFolder::write(const bool is_finished) const
{
  ordered_json written = json;
  written["began"]     = began;
  written["finished"]  = is_finished;
  if (is_finished)
  {
    written["seconds"] = json["seconds"].get<double>() + now() - began;
    written["files"]   = list_of_files(path);
  }
  write_json(path + "/run.json", written);
}

std::unique_ptr<RunFolder> open_run_folder(const std::string &path,
                                           const RunDescription &description, const Earlier earlier,
                                           const bool quiet)
{
  auto folder = std::make_unique<RunFolder>(path, description, earlier);
  if (!quiet && !folder->notice().empty())
    std::fprintf(stderr, "homespun: %s\n", folder->notice().c_str());
  return folder;
}

ordered_json finished_run(const std::string &path)
{
  const std::optional<ordered_json> found = description_in(path);
  if (!found || !found->value("finished", false))
    throw BadInput(path + ": " + (found ? "holds a run that did not end" : "holds no run") +
                   "; expected the --output folder of one that did");
  check_unchanged(path, *found);
  return *found;
}

void check_format(const std::string &folder)
{
  description_in(folder);
}

void list_report(const std::string &path)
{
  std::optional<ordered_json> found = description_in(path);
  if (!found || !found->value("finished", false))
    return;
  const auto is_of_report = [](const std::string &file)
  { return file == "report.html" || file.rfind("figures/", 0) == 0; };
  const ordered_json listed = found->value("files", ordered_json::object());
  ordered_json files        = ordered_json::object();
  for (const auto &[file, description] : listed.items())
    if (!is_of_report(file))
      files[file] = description;
  const ordered_json present = list_of_files(path);
  for (const auto &[file, description] : present.items())
    if (is_of_report(file))
      files[file] = description;
  (*found)["files"] = files;
  write_json(path + "/run.json", *found);
}

bool lies_in(const std::string &path, const std::string &folder)
{
  const fs::path inside =
    fs::weakly_canonical(path).lexically_relative(fs::weakly_canonical(folder));
  return !inside.empty() && *inside.begin() != "..";
}

std::string default_folder(const std::string &command, const std::vector<std::string> &names)
{
  std::string joined;
  for (std::size_t k = 0; k < std::min<std::size_t>(names.size(), 3); ++k)
    joined += (k == 0 ? "" : "+") + names[k];
  if (names.size() > 3)
    joined += "+" + std::to_string(names.size() - 3) + "-more";
  return "out/" + (joined.empty() ? "" : joined + "/") + command;
}
} // namespace homespun::verification
