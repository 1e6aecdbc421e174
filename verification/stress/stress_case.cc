// SPDX-License-Identifier: MIT
#include "verification/stress/stress_case.h"

#include "meshes/plain/errors.h"
#include "verification/record/number_text.h"
#include "verification/record/timing.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace homespun::verification
{
namespace
{
/// No more than a reader takes in.
std::string cut(std::string text)
{
  constexpr std::size_t longest = 300;
  if (text.size() > longest)
    text = text.substr(0, longest) + " ...";
  return text;
}

/// What one repetition came to.
struct Repetition
{
  std::string outcome;
  bool is_well  = false; ///< whether it ended as it should
  double figure = std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd values;
};

Repetition repetition(const StressCase &stress_case, const unsigned int seed)
{
  Repetition one;
  try
  {
    StressAnswer answer = stress_case.run(seed);
    one.figure          = answer.figure;
    one.values          = std::move(answer.values);
    const bool finite   = std::isfinite(one.figure) && one.values.allFinite();
    one.outcome         = finite ? "finite" : "not finite";
    one.is_well         = finite && one.figure <= stress_case.limit;
  }
  catch (const meshes::BadInput &bad)
  {
    one.outcome = std::string("refused: ") + bad.what();
  }
  catch (const meshes::NotConverged &failure)
  {
    const std::string text = failure.what();
    one.outcome            = "refused: " + text.substr(0, text.find("; residual norms"));
  }
  catch (const std::exception &other)
  {
    one.outcome = std::string("error: ") + other.what();
  }
  return one;
}
} // namespace

StressCase::StressCase(const std::string &group, const std::string &name,
                       const std::string &expected, const Limit &limit, const Repeats repeats,
                       Run run)
    : limit(limit.value)
    , repeats(repeats)
    , run(std::move(run))
{
  if (limit.derivation.empty())
    throw std::logic_error(group + ": " + name + ": the limit has no derivation");
  row.group      = group;
  row.name       = name;
  row.expected   = expected;
  row.limit      = short_text(limit.value) + " " + limit.is;
  row.derivation = limit.derivation;
}

StressRow run_case(const StressCase &stress_case, const int repeats)
{
  StressRow row = stress_case.row;
  row.repeats   = stress_case.repeats == Repeats::once    ? std::min(repeats, 1)
                  : stress_case.repeats == Repeats::twice ? std::min(repeats, 2)
                                                          : repeats;
  Eigen::MatrixXd first;
  bool all_well = row.repeats > 0;
  row.seconds   = seconds_of(
    [&]()
    {
      for (int k = 0; k < row.repeats; ++k)
      {
        Repetition one = repetition(stress_case, static_cast<unsigned int>(k));
        if (k == 0)
          first = one.values;
        else if (one.is_well && stress_case.repeats != Repeats::with_seeds && one.values != first)
        {
          one.is_well = false;
          one.outcome += " but differs from the first repetition";
        }
        // The first repetition that went wrong is told, of those that went well the first.
        if (k == 0 || (all_well && !one.is_well))
          row.outcome = cut(one.outcome);
        all_well = all_well && one.is_well;
        if (!(one.figure <= row.figure) && !std::isnan(one.figure))
          row.figure = one.figure;
      }
    });
  row.verdict = all_well ? Outcome::pass : Outcome::fail;
  return row;
}

std::vector<Verdict> stress_verdicts(const std::vector<StressRow> &rows)
{
  std::vector<Verdict> verdicts;
  std::vector<std::string> groups;
  for (const StressRow &row : rows)
    if (std::find(groups.begin(), groups.end(), row.group) == groups.end())
      groups.push_back(row.group);
  for (const std::string &group : groups)
  {
    int n = 0, n_failed = 0;
    for (const StressRow &row : rows)
      if (row.group == group)
      {
        ++n;
        n_failed += row.verdict != Outcome::pass;
      }
    verdicts.push_back(
      {group + ": each of " + std::to_string(n) + " cases ends as it should (cases that do not)",
       n_failed == 0 ? Outcome::pass : Outcome::fail, static_cast<double>(n_failed), "0",
       "no case may miss its own limit, whose derivation stands beside it in stress.csv",
       Kind::program});
  }
  return verdicts;
}
} // namespace homespun::verification
