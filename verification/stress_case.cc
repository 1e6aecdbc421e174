// SPDX-License-Identifier: MIT
#include "verification/stress_case.h"

#include "meshes/errors.h"
#include "verification/result_files.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace homespun::verification
{
namespace
{
/// A field of a table: no separators, and no more than a reader takes in.
std::string field(std::string text)
{
  constexpr std::size_t longest = 300;
  std::replace(text.begin(), text.end(), ',', ';');
  std::replace(text.begin(), text.end(), '\n', ' ');
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
    if (stress_case.ending != Ending::refused)
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
    if (!finite || stress_case.ending == Ending::refused)
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
  if (stress_case.ending == Ending::refused)
    return "names `" + stress_case.names + "`";
  return csv_number(stress_case.limit) + " " + stress_case.figure_is;
}

const std::vector<std::string> &stress_columns()
{
  static const std::vector<std::string> columns = {
    "group", "case", "expected", "outcome", "figure", "limit", "verdict", "repeats", "seconds"};
  return columns;
}

std::vector<std::string> stress_keys(const StressCase &stress_case)
{
  return {field(stress_case.group), field(stress_case.name)};
}

std::vector<std::string> stress_row(const StressCase &stress_case, const StressResult &result)
{
  return {field(stress_case.group), field(stress_case.name),        field(stress_case.expected),
          field(result.outcome),    csv_number(result.figure),      field(limit_text(stress_case)),
          name_of(result.verdict),  std::to_string(result.repeats), csv_number(result.seconds)};
}

std::vector<Verdict> stress_verdicts(const std::vector<std::vector<std::string>> &rows)
{
  std::vector<Verdict> verdicts;
  std::vector<std::string> groups;
  for (const auto &row : rows)
    if (std::find(groups.begin(), groups.end(), row.at(0)) == groups.end())
      groups.push_back(row[0]);
  for (const std::string &group : groups)
  {
    int n = 0, n_failed = 0;
    for (const auto &row : rows)
      if (row[0] == group)
      {
        ++n;
        n_failed += row.at(6) != name_of(Outcome::pass);
      }
    verdicts.push_back(
      {group + ": each of " + std::to_string(n) + " cases ends as it should (cases that do not)",
       n_failed == 0 ? Outcome::pass : Outcome::fail, static_cast<double>(n_failed), "0"});
  }
  return verdicts;
}
} // namespace homespun::verification
