// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace homespun::tests
{
inline std::string temporary(const std::string &name)
{
  return (std::filesystem::temp_directory_path() / ("homespun-" + name)).string();
}
} // namespace homespun::tests
