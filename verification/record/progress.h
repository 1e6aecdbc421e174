// SPDX-License-Identifier: MIT
// Tells a user what is being done and how long it will take: a bar that rewrites its line on a
// terminal, plain lines elsewhere, nothing when quiet or on ranks other than the first.
#pragma once

#include <chrono>
#include <string>

namespace homespun::verification
{
class Progress
{
public:
  Progress(bool is_shown, int n_steps);
  ~Progress();

  /// The step that begins now; on a terminal it replaces the line, elsewhere it is a line when
  /// `is_milestone`.
  void begin(const std::string &what, bool is_milestone = false);

  /// One step more is done.
  void done();

  /// A line that stays.
  void note(const std::string &text);

private:
  void draw();

  const bool is_shown, is_terminal;
  const int n_steps;
  int n_done = 0;
  std::string current;
  const std::chrono::steady_clock::time_point start;
};
} // namespace homespun::verification
