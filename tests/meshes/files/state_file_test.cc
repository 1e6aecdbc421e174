// SPDX-License-Identifier: MIT
#include "meshes/files/state_file.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include <unistd.h>

using namespace homespun::meshes;
using homespun::tests::refusal;

namespace
{
/// A file that goes away.
struct StateFile : testing::Test
{
  ~StateFile() override
  {
    std::filesystem::remove(path);
  }
  const std::string path = (std::filesystem::temp_directory_path() /
                            ("homespun-state-" + std::to_string(::getpid()) + ".h5"))
                             .string();
};
using exact_state_file    = StateFile;
using tripwire_state_file = StateFile;

ClothState some_state(const std::vector<double> &step_seconds)
{
  ClothState state;
  state.positions    = SpacePoints::Random(5, 3);
  state.velocities   = SpacePoints::Random(5, 3);
  state.time         = 0.1 + 0.2;
  state.frame        = 7;
  state.run          = "0123456789abcdef";
  state.step_seconds = step_seconds;
  return state;
}
} // namespace

TEST_F(exact_state_file, a_state_comes_back_with_every_digit_before_the_first_step_too)
{
  EXPECT_FALSE(read_state(path, 5, "any").has_value());
  for (const std::vector<double> &seconds :
       {std::vector<double>{}, std::vector<double>{0.1, 1. / 3., 2e-6}})
  {
    const ClothState state = some_state(seconds);
    write_state(state, path);
    const auto found = read_state(path, 5, state.run);
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(found->positions, state.positions);
    EXPECT_EQ(found->velocities, state.velocities);
    EXPECT_EQ(found->time, state.time);
    EXPECT_EQ(found->frame, state.frame);
    EXPECT_EQ(found->run, state.run);
    EXPECT_EQ(found->step_seconds, seconds);
  }
}

TEST_F(tripwire_state_file, the_state_of_another_run_or_cloth_is_refused)
{
  write_state(some_state({1.}), path);
  const std::string other = refusal([&] { read_state(path, 5, "fedcba9876543210"); });
  for (const char *part : {"0123456789abcdef", "fedcba9876543210", "--overwrite"})
    EXPECT_NE(other.find(part), std::string::npos) << other;
  EXPECT_NE(refusal([&] { read_state(path, 6, "0123456789abcdef"); })
              .find("has shape (5,3); expected (6,3)"),
            std::string::npos);
  ClothState bad       = some_state({});
  bad.velocities(2, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal([&] { write_state(bad, path); }).find("not finite"), std::string::npos);
}
