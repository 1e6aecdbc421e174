// SPDX-License-Identifier: MIT
// Bytes as the .prm of a scene: keys, terms, places, motions, and all that they may hold.
#include "tests/fuzz/input_file.h"
#include "verification/drape/scene/scene.h"

#include <cmath>

using namespace homespun;

int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  const tests::InputFile file(data, size, ".prm");
  tests::read_or_refuse(
    [&]()
    {
      const verification::Scene scene = verification::read_scene(file.name);
      tests::must_hold(std::isfinite(scene.duration) && scene.time_step > 0.,
                       "a scene has a time step");
    });
  return 0;
}
