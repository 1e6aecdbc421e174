// SPDX-License-Identifier: MIT
// Numbers for people: six digits, or as many as an error bar justifies.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace homespun::verification
{
/// Six digits; "not a number" where it is none.
inline std::string short_text(const double value)
{
  if (!std::isfinite(value))
    return "not a number";
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return text;
}

/// A fraction as percent, three digits: "0.291 %".
inline std::string percent_text(const double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g %%", 100. * value);
  return text;
}

/// "2.12 +- 0.02": the value rounded to the place of the bar's first digit, and the bar with what
/// that rounding did to the value added, rounded up to one digit: what is printed never claims more
/// than what is known.
/// @param bar on the value, in its unit; not negative
inline std::string with_bar(const double value, const double bar)
{
  char text[80];
  if (!std::isfinite(value) || !std::isfinite(bar))
  {
    std::snprintf(text, sizeof(text), "%.3g +- %g", value, bar);
    return text;
  }
  constexpr int most_decimals = 15;
  int decimals = bar > 0. ? -static_cast<int>(std::floor(std::log10(bar))) : most_decimals;
  decimals     = std::min(decimals, most_decimals); // below zero: of tens, hundreds, ...
  while (true)
  {
    const double per_unit = std::pow(10., decimals);
    const double printed  = std::round(value * per_unit) / per_unit;
    const double units    = std::ceil((bar + std::abs(value - printed)) * per_unit);
    if (units > 9.)
    {
      --decimals;
      continue;
    }
    std::snprintf(text, sizeof(text), "%.*f +- %.1g", std::max(decimals, 0), printed,
                  units / per_unit);
    return text;
  }
}
} // namespace homespun::verification
