// SPDX-License-Identifier: MIT
#include "meshes/files/format_version.h"

namespace homespun::meshes
{
std::string fault_of_format(const std::string &path, const int found)
{
  if (found < 0)
    return fault_of_format(path, std::to_string(found));
  return found <= format_version
           ? ""
           : path + ": found format_version " + std::to_string(found) + "; expected at most " +
               std::to_string(format_version) +
               ": a newer homespun wrote the file: read it with that one, or write it again with "
               "this one";
}

std::string fault_of_format(const std::string &path, const std::string &found)
{
  return path + ": found format_version " + found + "; expected a whole number from 0 to " +
         std::to_string(format_version) + ": the file is damaged, write it again";
}
} // namespace homespun::meshes
