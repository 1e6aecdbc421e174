// SPDX-License-Identifier: MIT
#include "verification/record/given_table.h"

#include "meshes/plain/errors.h"
#include "verification/record/fields.h"

#include <fstream>

namespace homespun::verification
{
namespace
{
std::vector<std::string> trimmed_fields_of(std::string line)
{
  if (line.rfind("\xef\xbb\xbf", 0) == 0)
    line.erase(0, 3); // a byte order mark
  std::vector<std::string> fields = fields_of(line);
  for (std::string &field : fields)
  {
    field.erase(0, field.find_first_not_of(" \t\r"));
    field.erase(field.find_last_not_of(" \t\r") + 1);
  }
  return fields;
}
} // namespace

GivenTable read_given_table(const std::string &file)
{
  std::ifstream input(file);
  std::string line;
  if (!std::getline(input, line))
    throw meshes::BadInput(file +
                           ": cannot be read, or is empty; expected a CSV file with a header");
  GivenTable table = {trimmed_fields_of(line), {}, {}};
  std::vector<std::string> faults;
  for (int number = 2; std::getline(input, line); ++number)
  {
    const std::vector<std::string> fields = trimmed_fields_of(line);
    const std::string place               = file + ", line " + std::to_string(number);
    if (fields == std::vector<std::string>{""})
      continue;
    if (fields.size() != table.columns.size())
      faults.push_back(place + ": found " + std::to_string(fields.size()) + " fields; expected " +
                       std::to_string(table.columns.size()) + " as in the header");
    table.rows.push_back(fields);
    table.places.push_back(place);
  }
  if (table.rows.empty())
    faults.push_back(file + ": found no line below the header; expected a row at least");
  if (!faults.empty())
    throw meshes::BadInput(faults);
  return table;
}
} // namespace homespun::verification
