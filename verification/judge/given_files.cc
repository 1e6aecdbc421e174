// SPDX-License-Identifier: MIT
#include "verification/judge/given_files.h"

#include "meshes/plain/errors.h"
#include "verification/law/laws.h"
#include "verification/record/given_table.h"
#include "verification/strain/kept_positions.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace homespun::verification
{
namespace fs = std::filesystem;
using meshes::BadInput;

namespace
{
/// Collects files and what is wrong with them.
class Collection
{
public:
  void add(const std::string &level, const GivenFile &file)
  {
    const auto [known, is_new] = files.emplace(level, file);
    if (!is_new)
      faults.push_back(file.path + ": is of the same level as " + known->second.path +
                       "; expected one file for each");
  }

  void add_table(const fs::path &path)
  {
    const GivenTable table = read_given_table(path);
    const auto field       = [&](const std::size_t row, const std::string &column) -> std::string
    {
      const auto found = std::find(table.columns.begin(), table.columns.end(), column);
      return found == table.columns.end()
               ? ""
               : table.rows[row][static_cast<std::size_t>(found - table.columns.begin())];
    };
    for (std::size_t row = 0; row < table.rows.size(); ++row)
      try
      {
        double strain = 0.;
        GivenFile file;
        if (!read_field(field(row, "strain"), strain) || !(strain > 0.) ||
            !read_field(field(row, "seconds"), file.seconds) || file.seconds <= 0. ||
            field(row, "file").empty())
          throw BadInput("expected a load, a law, a strain as a fraction, a file and, where they "
                         "are known, seconds, in columns of these names");
        file.path = (path.parent_path() / field(row, "file")).string();
        if (!fs::exists(file.path))
          throw BadInput(file.path + " is not there");
        add(file_name_of({"", field(row, "load"), law_of(field(row, "law")), strain}), file);
      }
      catch (const BadInput &bad)
      {
        faults.push_back(table.places[row] + ": " + bad.what());
      }
  }

  std::map<std::string, GivenFile> files;
  std::vector<std::string> faults;
};
} // namespace

std::map<std::string, GivenFile> files_by_level(const std::vector<std::string> &given)
{
  Collection collection;
  for (const fs::path path : given)
    if (fs::is_directory(path))
      for (const auto &entry : fs::directory_iterator(path))
        collection.add(entry.path().stem(), {entry.path()});
    else if (!fs::exists(path))
      collection.faults.push_back(path.string() + ": is not there; expected a file of positions, a "
                                                  "table of such, or a folder of them");
    else if (path.extension() == ".csv")
      collection.add_table(path);
    else
      collection.add(path.stem(), {path});
  if (!collection.faults.empty())
    throw BadInput(collection.faults);
  return collection.files;
}
} // namespace homespun::verification
