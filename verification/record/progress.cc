// SPDX-License-Identifier: MIT
#include "verification/record/progress.h"

#include <cstdio>

#include <unistd.h>

namespace homespun::verification
{
Progress::Progress(const bool is_shown, const int n_steps)
    : is_shown(is_shown)
    , is_terminal(isatty(STDERR_FILENO) == 1)
    , n_steps(n_steps)
    , start(std::chrono::steady_clock::now())
{
}

Progress::~Progress()
{
  if (is_shown && is_terminal)
    std::fprintf(stderr, "\r\033[K");
}

void Progress::begin(const std::string &what, const bool is_milestone)
{
  current = what;
  if (!is_shown)
    return;
  if (is_terminal)
    draw();
  else if (is_milestone)
    std::fprintf(stderr, "[%3d%%] %s\n", n_steps > 0 ? 100 * n_done / n_steps : 0, what.c_str());
}

void Progress::done()
{
  ++n_done;
  if (is_shown && is_terminal)
    draw();
}

void Progress::note(const std::string &text)
{
  if (!is_shown)
    return;
  std::fprintf(stderr, "%s%s\n", is_terminal ? "\r\033[K" : "", text.c_str());
  if (is_terminal)
    draw();
}

void Progress::draw()
{
  constexpr int width = 24;
  const double part   = n_steps > 0 ? static_cast<double>(n_done) / n_steps : 0.;
  const double seconds =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::string bar(static_cast<std::size_t>(part * width), '#');
  bar.resize(width, '.');
  std::string left;
  if (n_done > 0 && n_done < n_steps)
    left = ", " + std::to_string(static_cast<int>(seconds / part * (1. - part)) + 1) + " s left";
  std::fprintf(stderr, "\r\033[K[%s] %3.0f%%%s  %s", bar.c_str(), 100. * part, left.c_str(),
               current.c_str());
  std::fflush(stderr);
}
} // namespace homespun::verification
