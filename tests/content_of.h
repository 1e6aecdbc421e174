// SPDX-License-Identifier: MIT
// A file, byte by byte.
#pragma once

#include <fstream>
#include <sstream>
#include <string>

namespace homespun::tests
{
inline std::string content_of(const std::string &file)
{
  std::ifstream input(file, std::ios::binary);
  std::ostringstream text;
  text << input.rdbuf();
  return text.str();
}
} // namespace homespun::tests
