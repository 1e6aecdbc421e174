// SPDX-License-Identifier: MIT
// Fuzzing of what homespun parses itself: any bytes are read or refused by BadInput, with nothing
// else between.
#pragma once

#include "meshes/plain/errors.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include <unistd.h>

namespace homespun::tests
{
/// A file of some bytes, as long as it lives; one per process.
class InputFile
{
public:
  InputFile(const std::uint8_t *data, const std::size_t size, const std::string &ending)
      : name("/tmp/homespun-fuzz-" + std::to_string(getpid()) + ending)
  {
    std::ofstream file(name, std::ios::binary);
    file.write(reinterpret_cast<const char *>(data), static_cast<std::streamsize>(size));
  }
  ~InputFile()
  {
    std::remove(name.c_str());
  }
  InputFile(const InputFile &)            = delete;
  InputFile &operator=(const InputFile &) = delete;

  const std::string name;
};

/// Ends the program where something that was read is not as it must be.
inline void must_hold(const bool condition, const char *const what)
{
  if (condition)
    return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

/// A refusal must say something; HOMESPUN_FUZZ_SAY in the environment prints what.
template <typename Read>
void read_or_refuse(const Read &read)
{
  try
  {
    read();
  }
  catch (const meshes::BadInput &fault)
  {
    must_hold(!std::string(fault.what()).empty(), "a refusal has a message");
    if (std::getenv("HOMESPUN_FUZZ_SAY") != nullptr)
      std::fprintf(stderr, "refused: %s\n", fault.what());
  }
}
} // namespace homespun::tests

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);
