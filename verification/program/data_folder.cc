// SPDX-License-Identifier: MIT
#include "verification/program/data_folder.h"

#include "verification/build_info.h"

#include <filesystem>

namespace homespun::verification
{
std::string data_folder(const std::string &installed, const std::string &in_sources)
{
  namespace fs           = std::filesystem;
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path data    = (program.parent_path() / HOMESPUN_DATA_DIR).lexically_normal();
  return fs::is_directory(data) ? (data / installed).string()
                                : std::string(HOMESPUN_SOURCE_DIR) + "/" + in_sources;
}

std::string cells_folder()
{
  return data_folder("cells", "meshes/cells");
}
} // namespace homespun::verification
