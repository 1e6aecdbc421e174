// SPDX-License-Identifier: MIT
// Tells a user what is being done and how long it will take: a bar that rewrites its line on a
// terminal, plain lines elsewhere, nothing when quiet or on ranks other than the first. A step that
// takes long is seen to be alive: the bar creeps, elsewhere a line says how long it has taken.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace homespun::verification
{
/// The part of all steps that a bar shows: n_done of n_steps, and of the step that runs what it
/// would have behind it if it took as long as those before, 1 - exp(-t/mean), so that it grows and
/// never reaches the next step.
/// @param seconds_in_step t [s]
/// @param mean_seconds of the steps before, not positive: not known yet, some ten seconds are taken
double shown_part(int n_done, int n_steps, double seconds_in_step, double mean_seconds);

class Progress
{
public:
  using Seconds = std::chrono::duration<double>;

  /// @param period between lines about a step that still runs, where no terminal shows a bar
  Progress(bool is_shown, int n_steps, Seconds period = Seconds(20.));
  ~Progress();

  /// The step that begins now: on a terminal it replaces the line, elsewhere nothing is said.
  void begin(const std::string &what);

  /// A step that is a line elsewhere, too.
  void milestone(const std::string &what);

  /// One step more is done.
  void done();

  /// A line that stays.
  void note(const std::string &text);

private:
  using Clock = std::chrono::steady_clock;

  void draw();
  void tell_while_it_runs();
  double part() const;

  const bool is_shown, is_terminal;
  const int n_steps;
  const Seconds period;
  int n_done = 0;
  std::string current;
  const Clock::time_point start = Clock::now();
  Clock::time_point last_done = start, step_began = start;
  std::mutex mutex;
  std::condition_variable changed;
  bool is_over = false;
  std::thread teller; ///< the last member: it uses all others
};
} // namespace homespun::verification
