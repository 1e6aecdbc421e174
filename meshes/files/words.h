// SPDX-License-Identifier: MIT
// Words of a line of a text file.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

namespace homespun::meshes
{
/// What stands between blanks, tabulators and returns; lives as long as the line.
inline std::vector<std::string_view> words_of(const std::string_view line)
{
  std::vector<std::string_view> words;
  std::size_t begin = 0;
  while ((begin = line.find_first_not_of(" \t\r", begin)) != std::string_view::npos)
  {
    const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = end;
  }
  return words;
}
} // namespace homespun::meshes
