// SPDX-License-Identifier: MIT
// How a file reaches the disk: whole or not at all.
#pragma once

#include <cstdio>
#include <memory>
#include <string>

namespace homespun::meshes
{
/// A file that grows beside the place where it will be: whoever reads sees the old content or the
/// new, also after a kill. One that is not finished goes away.
class WholeFile
{
public:
  /// @throws BadInput where the folder is absent or not writable
  explicit WholeFile(std::string path);
  ~WholeFile();

  /// @param bytes added as they are
  /// @throws BadInput where the disk is full
  void append(const std::string &bytes);

  /// Waits for the disk, and gives the file its name.
  /// @throws BadInput where the disk is full, or the name is that of a folder
  void finish();

private:
  struct Close
  {
    void operator()(std::FILE *file) const
    {
      std::fclose(file);
    }
  };
  const std::string path, temporary;
  std::unique_ptr<std::FILE, Close> file;
};

/// Writes a file at once.
/// @param content bytes, written as they are
/// @throws BadInput as WholeFile
void write_whole(const std::string &path, const std::string &content);
} // namespace homespun::meshes
