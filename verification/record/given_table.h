// SPDX-License-Identifier: MIT
// A CSV file that somebody else wrote, of whose columns some count.
#pragma once

#include <string>
#include <vector>

namespace homespun::verification
{
struct GivenTable
{
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows; ///< as many fields as columns each
  std::vector<std::string> places;            ///< of the rows: `file, line 2`
};

/// Blanks around fields, empty lines, a byte order mark and the line ends of other systems are
/// passed over.
/// @throws BadInput, a message per fault: a file without a line below the header, a line of another
///   number of fields
GivenTable read_given_table(const std::string &file);
} // namespace homespun::verification
