// SPDX-License-Identifier: MIT
#include "meshes/files/write_whole.h"

#include "meshes/plain/errors.h"

#include <cstdio>

#include <unistd.h>

namespace homespun::meshes
{
void write_whole(const std::string &path, const std::string &content)
{
  const std::string temporary = path + ".part";
  std::FILE *const file       = std::fopen(temporary.c_str(), "wb");
  if (file == nullptr)
    throw BadInput(path + ": cannot be written; expected a folder that exists and is writable");
  const bool on_disk = std::fwrite(content.data(), 1, content.size(), file) == content.size() &&
                       std::fflush(file) == 0 && fsync(fileno(file)) == 0;
  if (std::fclose(file) != 0 || !on_disk)
  {
    std::remove(temporary.c_str());
    throw BadInput(path + ": cannot be written: is the disk full?");
  }
  if (std::rename(temporary.c_str(), path.c_str()) != 0)
  {
    std::remove(temporary.c_str());
    throw BadInput(path + ": cannot be written; expected a file name, found a folder or a file "
                          "that must not be replaced");
  }
}
} // namespace homespun::meshes
