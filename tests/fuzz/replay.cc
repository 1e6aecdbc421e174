// SPDX-License-Identifier: MIT
// Hands each file of a folder to a fuzz target: what was once found stays mended, with every
// compiler.
#include "tests/fuzz/input_file.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <vector>

int main(const int argc, char **argv)
{
  std::size_t n_files = 0;
  for (int k = 1; k < argc; ++k)
    for (const auto &entry : std::filesystem::directory_iterator(argv[k]))
    {
      std::ifstream file(entry.path(), std::ios::binary);
      const std::vector<char> bytes((std::istreambuf_iterator<char>(file)),
                                    std::istreambuf_iterator<char>());
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t *>(bytes.data()), bytes.size());
      ++n_files;
    }
  std::printf("%zu inputs\n", n_files);
  return n_files > 0 ? 0 : 1;
}
