// SPDX-License-Identifier: MIT
#include "verification/record/checksum.h"

#include "meshes/plain/errors.h"

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <vector>

#include <zlib.h>

namespace homespun::verification
{
std::string checksum_of_file(const std::string &path)
{
  std::ifstream input(path, std::ios::binary);
  if (!input)
    throw meshes::BadInput(path + ": cannot be read; expected a file that this run wrote");
  std::vector<char> block(1 << 20);
  uLong sum = crc32(0, nullptr, 0);
  do
  {
    input.read(block.data(), static_cast<std::streamsize>(block.size()));
    sum =
      crc32(sum, reinterpret_cast<const Bytef *>(block.data()), static_cast<uInt>(input.gcount()));
  } while (input);
  char text[16];
  std::snprintf(text, sizeof(text), "%08lx", sum);
  return text;
}

std::string checksum_of_text(const std::string &text)
{
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : text)
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  char digits[20];
  std::snprintf(digits, sizeof(digits), "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}
} // namespace homespun::verification
