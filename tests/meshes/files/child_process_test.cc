// SPDX-License-Identifier: MIT
#include "meshes/files/child_process.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using homespun::meshes::run_child;

TEST(exact_child_process, how_it_ended_is_told_as_a_shell_tells_it)
{
  EXPECT_EQ(run_child({"true"}), 0);
  EXPECT_EQ(run_child({"sh", "-c", "exit 3"}), 3);
  EXPECT_EQ(run_child({"sh", "-c", "kill -9 $$"}), 128 + 9);
  EXPECT_EQ(run_child({"no-such-program"}), 127);
}

TEST(exact_child_process, words_reach_it_without_a_shell_and_what_it_says_the_log)
{
  const std::string log = (std::filesystem::temp_directory_path() / "homespun-child.log").string();
  EXPECT_EQ(run_child({"printf", "%s|", "a b", "$HOME", "*"}, log), 0);
  std::string said;
  std::getline(std::ifstream(log), said);
  EXPECT_EQ(said, "a b|$HOME|*|");
  std::filesystem::remove(log);
}
