// SPDX-License-Identifier: MIT
#include "verification/extremes/stress_case.h"

#include "meshes/plain/errors.h"
#include "verification/record/number_text.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
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

/// What one repetition came to; a problem is empty where it ended as it should.
struct Repetition
{
  std::string outcome, problem;
  double figure = std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd values;
};

Repetition repetition(const StressCase &stress_case, const unsigned int seed)
{
  Repetition one;
  const auto refused = [&](const std::string &message)
  {
    one.outcome = "refused: " + message;
    if (stress_case.ending != ExpectedEnd::refused)
      one.problem = "a finite answer was expected";
    else if (message.find(stress_case.names) == std::string::npos)
      one.problem = "the message does not name the fault";
  };
  try
  {
    StressAnswer answer = stress_case.run(seed);
    one.figure          = answer.figure;
    one.values          = std::move(answer.values);
    const bool finite   = std::isfinite(one.figure) && one.values.allFinite();
    one.outcome         = finite ? "finite" : "not finite";
    if (!finite || stress_case.ending == ExpectedEnd::refused)
      one.problem = "a number is not finite, or a refusal was expected";
    else if (!(one.figure <= stress_case.limit))
      one.problem = "beyond the limit";
  }
  catch (const meshes::BadInput &bad)
  {
    refused(bad.what());
  }
  catch (const meshes::NotConverged &failure)
  {
    const std::string text = failure.what();
    refused(text.substr(0, text.find("; residual norms")));
  }
  catch (const std::exception &other)
  {
    one.outcome = std::string("error: ") + other.what();
    one.problem = "neither an answer nor a refusal";
  }
  return one;
}
} // namespace

CaseGroup::CaseGroup(std::string name, std::vector<StressCase> &cases)
    : group(std::move(name))
    , cases(cases)
{
}

StressCase &CaseGroup::finite(const std::string &name, const std::string &expected,
                              const Figure &figure, const Run &run)
{
  StressCase &one = cases.emplace_back();
  one.group       = group;
  one.name        = name;
  one.expected    = expected;
  one.limit       = figure.limit;
  one.figure_is   = figure.is;
  one.run         = run;
  return one;
}

StressCase &CaseGroup::refused(const std::string &name, const std::string &names, const Run &run)
{
  StressCase &one = cases.emplace_back();
  one.group       = group;
  one.name        = name;
  one.expected    = "refused; the message names `" + names + "`";
  one.ending      = ExpectedEnd::refused;
  one.names       = names;
  one.run         = run;
  return one;
}

void derive(std::vector<StressCase> &cases, const Derivations &derivations)
{
  for (StressCase &one : cases)
    if (const auto found = derivations.find(one.figure_is); found != derivations.end())
      one.derivation = found->second;
}

StressResult run_case(const StressCase &stress_case, const int most_repeats)
{
  const int repeats = std::min(most_repeats, stress_case.most_repeats);
  const auto begin  = std::chrono::steady_clock::now();
  StressResult result;
  result.repeats = repeats;
  result.figure  = std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd first;
  std::string problem;
  for (int k = 0; k < repeats; ++k)
  {
    Repetition one = repetition(stress_case, static_cast<unsigned int>(k));
    if (k == 0)
      first = one.values;
    else if (one.problem.empty() && !stress_case.is_random && one.values != first)
    {
      one.problem = "differs from the first repetition";
      one.outcome += " but differs from the first repetition";
    }
    // The first repetition that went wrong is told, of those that went well the first.
    if (k == 0 || (problem.empty() && !one.problem.empty()))
    {
      result.outcome = one.outcome;
      problem        = one.problem;
    }
    if (!(one.figure <= result.figure) && !std::isnan(one.figure))
      result.figure = one.figure;
  }
  result.verdict = repeats > 0 && problem.empty() ? Outcome::pass : Outcome::fail;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

std::string limit_text(const StressCase &stress_case)
{
  if (stress_case.ending == ExpectedEnd::refused)
    return "names `" + stress_case.names + "`";
  return short_text(stress_case.limit) + " " + stress_case.figure_is;
}

StressRow keys_of(const StressCase &stress_case)
{
  StressRow row;
  row.group = stress_case.group;
  row.name  = stress_case.name;
  return row;
}

StressRow stress_row(const StressCase &stress_case, const StressResult &result)
{
  const bool is_refused = stress_case.ending == ExpectedEnd::refused;
  if (!is_refused && stress_case.derivation.empty())
    throw std::logic_error(stress_case.group + ": " + stress_case.name +
                           ": the limit has no derivation");
  StressRow row = keys_of(stress_case);
  row.expected  = stress_case.expected;
  row.outcome   = cut(result.outcome);
  row.figure    = result.figure;
  row.limit     = limit_text(stress_case);
  row.verdict   = result.verdict;
  row.repeats   = result.repeats;
  row.seconds   = result.seconds;
  row.derivation =
    is_refused ? "requirement: what has no answer is refused by a message that names the fault"
               : stress_case.derivation;
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
