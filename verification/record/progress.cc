// SPDX-License-Identifier: MIT
#include "verification/record/progress.h"

#include <cmath>
#include <cstdio>

#include <unistd.h>

namespace homespun::verification
{
namespace
{
constexpr double first_guess = 10.; ///< seconds of a step before any is known
} // namespace

double shown_part(const int n_done, const int n_steps, const double seconds_in_step,
                  const double mean_seconds)
{
  if (n_steps <= 0 || n_done >= n_steps)
    return n_steps <= 0 ? 0. : 1.;
  const double mean = mean_seconds > 0. ? mean_seconds : first_guess;
  return (n_done + 0.95 * (1. - std::exp(-seconds_in_step / mean))) / n_steps;
}

Progress::Progress(const bool is_shown, const int n_steps, const Seconds period)
    : is_shown(is_shown)
    , is_terminal(isatty(STDERR_FILENO) == 1)
    , n_steps(n_steps)
    , period(is_terminal ? Seconds(1.) : period)
{
  if (is_shown)
    teller = std::thread([this]() { tell_while_it_runs(); });
}

Progress::~Progress()
{
  {
    const std::lock_guard<std::mutex> lock(mutex);
    is_over = true;
  }
  changed.notify_all();
  if (teller.joinable())
    teller.join();
  if (is_shown && is_terminal)
    std::fprintf(stderr, "\r\033[K");
}

void Progress::begin(const std::string &what)
{
  const std::lock_guard<std::mutex> lock(mutex);
  current    = what;
  step_began = Clock::now();
  if (is_shown && is_terminal)
    draw();
}

void Progress::milestone(const std::string &what)
{
  begin(what);
  const std::lock_guard<std::mutex> lock(mutex);
  if (is_shown && !is_terminal)
    std::fprintf(stderr, "[%3.0f%%] %s\n", std::floor(100. * part()), what.c_str());
}

void Progress::done()
{
  const std::lock_guard<std::mutex> lock(mutex);
  ++n_done;
  last_done = Clock::now();
  if (is_shown && is_terminal)
    draw();
}

void Progress::note(const std::string &text)
{
  const std::lock_guard<std::mutex> lock(mutex);
  if (!is_shown)
    return;
  std::fprintf(stderr, "%s%s\n", is_terminal ? "\r\033[K" : "", text.c_str());
  if (is_terminal)
    draw();
}

double Progress::part() const
{
  const double mean = n_done > 0 ? Seconds(last_done - start).count() / n_done : 0.;
  return shown_part(n_done, n_steps, Seconds(Clock::now() - last_done).count(), mean);
}

void Progress::tell_while_it_runs()
{
  std::unique_lock<std::mutex> lock(mutex);
  while (!is_over)
  {
    changed.wait_for(lock, period);
    const double in_step = Seconds(Clock::now() - step_began).count();
    if (is_over || current.empty())
      continue;
    if (is_terminal)
      draw();
    else if (in_step >= period.count())
      std::fprintf(stderr, "[%3.0f%%] %s: %.0f s so far\n", std::floor(100. * part()),
                   current.c_str(), in_step);
  }
}

void Progress::draw()
{
  constexpr int width = 24;
  const double share = part(), seconds = Seconds(Clock::now() - start).count(),
               in_step = Seconds(Clock::now() - step_began).count();
  std::string bar(static_cast<std::size_t>(share * width), '#');
  bar.resize(width, '.');
  std::string more;
  if (n_done > 0 && n_done < n_steps)
    more = ", " + std::to_string(static_cast<int>(seconds / share * (1. - share)) + 1) + " s left";
  const std::string elapsed =
    in_step >= 2. ? " (" + std::to_string(static_cast<int>(in_step)) + " s)" : "";
  std::fprintf(stderr, "\r\033[K[%s] %3.0f%%%s  %s%s", bar.c_str(), std::floor(100. * share),
               more.c_str(), current.c_str(), elapsed.c_str());
  std::fflush(stderr);
}
} // namespace homespun::verification
