// SPDX-License-Identifier: MIT
#include "meshes/files/write_whole.h"

#include "meshes/plain/errors.h"

#include <utility>

#include <unistd.h>

namespace homespun::meshes
{
WholeFile::WholeFile(std::string the_path)
    : path(std::move(the_path))
    , temporary(path + ".part")
    , file(std::fopen(temporary.c_str(), "wb"))
{
  if (!file)
    throw BadInput(path + ": cannot be written; expected a folder that exists and is writable");
}

WholeFile::~WholeFile()
{
  if (file)
    std::remove(temporary.c_str());
}

void WholeFile::append(const std::string &bytes)
{
  if (std::fwrite(bytes.data(), 1, bytes.size(), file.get()) != bytes.size())
    throw BadInput(path + ": cannot be written: is the disk full?");
}

void WholeFile::finish()
{
  const bool on_disk   = std::fflush(file.get()) == 0 && fsync(fileno(file.get())) == 0;
  const bool is_closed = std::fclose(file.release()) == 0;
  const bool is_named  = on_disk && is_closed && std::rename(temporary.c_str(), path.c_str()) == 0;
  if (is_named)
    return;
  std::remove(temporary.c_str());
  throw BadInput(path + (on_disk && is_closed
                           ? ": cannot be written; expected a file name, found a folder or a file "
                             "that must not be replaced"
                           : ": cannot be written: is the disk full?"));
}

void write_whole(const std::string &path, const std::string &content)
{
  WholeFile file(path);
  file.append(content);
  file.finish();
}
} // namespace homespun::meshes
