// SPDX-License-Identifier: MIT
#include "verification/command/data_folder.h"

#include "verification/build_info.h"

#include <filesystem>

namespace homespun::verification
{
namespace fs = std::filesystem;

namespace
{
fs::path folder_of_program()
{
  return fs::read_symlink("/proc/self/exe").parent_path();
}
} // namespace

std::string data_folder(const std::string &installed, const std::string &in_sources)
{
  const fs::path program = folder_of_program();
  for (const char *way : {HOMESPUN_DATA_DIR, HOMESPUN_DATA_DIR_OF_FULL})
    if (const fs::path data = (program / way).lexically_normal(); fs::is_directory(data))
      return (data / installed).string();
  return std::string(HOMESPUN_SOURCE_DIR) + "/" + in_sources;
}

std::string full_program()
{
  const std::string name  = "homespun-full";
  const fs::path in_build = folder_of_program() / name;
  return fs::exists(in_build)
           ? in_build.string()
           : (folder_of_program() / HOMESPUN_FULL_DIR / name).lexically_normal().string();
}

std::string cells_folder()
{
  return data_folder("cells", "meshes/cells");
}
} // namespace homespun::verification
