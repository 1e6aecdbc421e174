// SPDX-License-Identifier: MIT
// Checksums by which a run and its files are recognised; against accidents, not against malice.
#pragma once

#include <string>

namespace homespun::verification
{
/// CRC-32 of a file as eight hexadecimal digits.
/// @throws BadInput where it cannot be read
std::string checksum_of_file(const std::string &path);

/// Sixteen hexadecimal digits, FNV-1a of 64 bits.
std::string checksum_of_text(const std::string &text);
} // namespace homespun::verification
