// SPDX-License-Identifier: MIT
// A folder for what other programs write on the way.
#pragma once

#include "meshes/plain/errors.h"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace homespun::meshes
{
/// A new folder that goes away with all that is in it.
class TemporaryFolder
{
public:
  /// @throws BadInput where a folder cannot be made in `parent`
  explicit TemporaryFolder(const std::string &parent)
      : path(parent + "/.homespun-XXXXXX")
  {
    if (!mkdtemp(path.data()))
      throw BadInput(parent +
                     ": cannot be written; expected a folder that can: choose another --output, or "
                     "for temporary files another TMPDIR");
  }
  TemporaryFolder(const TemporaryFolder &)            = delete;
  TemporaryFolder &operator=(const TemporaryFolder &) = delete;
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }

  std::string path;
};
} // namespace homespun::meshes
