// SPDX-License-Identifier: MIT
// A claim and whether it held: data, never an exception.
#pragma once

#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace homespun::verification
{
enum class Outcome
{
  pass,
  fail,
  inconclusive
};

inline std::string name_of(const Outcome outcome)
{
  return outcome == Outcome::pass ? "PASS" : outcome == Outcome::fail ? "FAIL" : "INCONCLUSIVE";
}

/// A claim, the measured figure, the limit that was written down before, and the outcome.
struct Verdict
{
  std::string claim;
  Outcome outcome = Outcome::inconclusive;
  double value    = 0.;
  std::string limit;
};

/// The larger of a maximum so far and one value more. Once one of them was not a number it stays so, where
/// std::max would drop it and a check would pass.
inline double larger(const double so_far, const double next)
{
  return std::isnan(so_far) || next <= so_far ? so_far : next;
}

/// A number as JSON; null where it is not finite.
inline nlohmann::ordered_json json_number(const double value)
{
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

/// Text of a JSON file; names that are not UTF-8 are written with replacement characters.
inline std::string json_text(const nlohmann::ordered_json &json)
{
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// {"verdicts": [{claim, verdict, value, limit, command}]}
inline nlohmann::ordered_json to_json(const std::vector<Verdict> &verdicts,
                                      const std::string &command)
{
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Verdict &verdict : verdicts)
    list.push_back({{"claim", verdict.claim},
                    {"verdict", name_of(verdict.outcome)},
                    {"value", json_number(verdict.value)},
                    {"limit", verdict.limit},
                    {"command", command}});
  return {{"verdicts", list}};
}

/// Whether any claim failed.
inline bool any_failed(const std::vector<Verdict> &verdicts)
{
  for (const Verdict &verdict : verdicts)
    if (verdict.outcome == Outcome::fail)
      return true;
  return false;
}
} // namespace homespun::verification
