// SPDX-License-Identifier: MIT
#include "verification/judge/given_files.h"

#include "meshes/plain/errors.h"
#include "verification/drape/kept_frames.h"
#include "verification/law/laws.h"
#include "verification/record/given_table.h"
#include "verification/strain/kept_positions.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace homespun::verification
{
namespace fs = std::filesystem;
using meshes::BadInput;

namespace
{
bool is_table(const fs::path &path)
{
  return path.extension() == ".csv";
}

/// A row of a table, its fields by the names of their columns.
struct GivenRow
{
  const GivenTable &table;
  const std::size_t row;

  bool has(const std::string &column) const
  {
    return std::count(table.columns.begin(), table.columns.end(), column) > 0;
  }

  std::string operator[](const std::string &column) const
  {
    const auto found = std::find(table.columns.begin(), table.columns.end(), column);
    return found == table.columns.end()
             ? ""
             : table.rows[row][static_cast<std::size_t>(found - table.columns.begin())];
  }
};

std::string name_of_level(const GivenRow &row)
{
  double strain = 0.;
  if (!read_field(row["strain"], strain) || !(strain > 0.) || !std::isfinite(strain))
    throw BadInput("column strain: found `" + row["strain"] +
                   "`; expected a fraction above zero, in a table with the columns load, law, "
                   "strain, file and, where they are known, seconds");
  return file_name_of({"", row["load"], law_of(row["law"]), strain});
}

std::string name_of_frame(const GivenRow &row)
{
  int frame = 0;
  if (!read_field(row["frame"], frame) || frame < 0 || row["reference"].empty())
    throw BadInput("columns reference, frame: found `" + row["reference"] + "`, `" + row["frame"] +
                   "`; expected a reference and a number from 0 on, in a table with "
                   "the columns reference, frame and file");
  return file_name_of(row["reference"], frame);
}

/// Collects files and what is wrong with them.
class Collection
{
public:
  void add(const fs::path &path)
  {
    if (!fs::exists(path))
      faults.push_back(path.string() + ": is not there; expected a file of positions, a table of "
                                       "such, or a folder of files");
    else if (fs::is_directory(path))
      add_folder(path);
    else if (is_table(path))
      add_table(path);
    else
      add(path.stem(), {path});
  }

  std::map<std::string, GivenFile> files;
  std::vector<std::string> faults;

private:
  void add_folder(const fs::path &folder)
  {
    std::set<fs::path> paths;
    for (const auto &entry : fs::directory_iterator(folder))
      if (entry.path().filename().string().front() != '.')
        paths.insert(entry.path());
    if (paths.empty())
      faults.push_back(folder.string() + ": is an empty folder; expected files of positions in it");
    for (const fs::path &path : paths)
      if (fs::is_directory(path) || is_table(path))
        faults.push_back(path.string() + ": is a " + (is_table(path) ? "table" : "folder") +
                         " in a folder; expected files of positions: give it by itself");
      else
        add(path.stem(), {path});
  }

  void add(const std::string &level, const GivenFile &file)
  {
    const auto [known, is_new] = files.emplace(level, file);
    if (!is_new)
      faults.push_back(file.row + file.path + ": is of the same level as " + known->second.row +
                       known->second.path + "; expected one file for each");
  }

  void add_table(const fs::path &path)
  {
    GivenTable table;
    try
    {
      table = read_given_table(path);
    }
    catch (const BadInput &bad)
    {
      faults.insert(faults.end(), bad.faults().begin(), bad.faults().end());
    }
    for (std::size_t n = 0; n < table.rows.size(); ++n)
    {
      const GivenRow row = {table, n};
      GivenFile file     = {(path.parent_path() / row["file"]).string(), table.places[n] + ": "};
      try
      {
        const std::string seconds = row["seconds"],
                          level   = row.has("frame") ? name_of_frame(row) : name_of_level(row);
        if (!read_field(seconds, file.seconds) ||
            (!seconds.empty() && (file.seconds < 0. || !std::isfinite(file.seconds))))
          throw BadInput("column seconds: found `" + seconds +
                         "`; expected a finite number not below zero, or nothing");
        if (row["file"].empty() || !fs::is_regular_file(file.path))
          throw BadInput("column file: " + file.path +
                         " is not there; expected a file of "
                         "positions, as seen from the table");
        add(level, file);
      }
      catch (const BadInput &bad)
      {
        faults.push_back(file.row + bad.what());
      }
    }
  }
};
} // namespace

std::map<std::string, GivenFile> files_by_level(const std::vector<std::string> &given)
{
  Collection collection;
  for (const std::string &path : given)
    collection.add(fs::path(path));
  if (!collection.faults.empty())
    throw BadInput(collection.faults);
  return collection.files;
}
} // namespace homespun::verification
