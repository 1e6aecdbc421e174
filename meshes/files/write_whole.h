// SPDX-License-Identifier: MIT
// How a file reaches the disk: whole or not at all.
#pragma once

#include <string>

namespace homespun::meshes
{
/// Writes to a file beside it, waits for the disk, and gives it the name: whoever reads sees the
/// old content or the new, also after a kill.
/// @param content bytes, written as they are
/// @throws BadInput where the folder is absent or not writable, or the disk is full
void write_whole(const std::string &path, const std::string &content);
} // namespace homespun::meshes
