// SPDX-License-Identifier: MIT
// A claim and whether it held: data, never an exception.
#pragma once

#include <cmath>
#include <map>
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

/// PASS, FAIL or INCONCLUSIVE.
std::string name_of(Outcome outcome);

/// What a claim speaks of, and so whose fault its failure is.
enum class Kind
{
  program, ///< it computes what it says it computes
  input,   ///< cell, mesh or scene are fit for the question
  method   ///< up-sampling is good enough for this cell, load and strain
};

/// program, input or method.
std::string name_of(Kind kind);

/// A claim, the measured figure, what it had to be, where that limit comes from, and the outcome.
///
/// A limit is known before the figure: from theory, from round-off, or from an error bar of the
/// same run; `derivation` says which and how. A number that was chosen because figures lay below it
/// is no limit, and what it would judge is a note.
struct Verdict
{
  std::string claim;
  Outcome outcome = Outcome::inconclusive;
  double value    = 0.;
  std::string limit;
  std::string derivation = {};
  Kind kind              = Kind::program;
  std::string id         = {}; ///< in claims.json
  /// What it is about and what its sentence says, by name: cell, load, strain, ...
  std::map<std::string, std::string> of = {};
};

/// The larger of a maximum so far and one value more. Once one of them was not a number it stays
/// so, where std::max would drop it and a check would pass.
inline double larger(const double so_far, const double next)
{
  return std::isnan(so_far) || next <= so_far ? so_far : next;
}

/// Whether any claim has this outcome.
bool any(const std::vector<Verdict> &verdicts, Outcome outcome);

/// Whether any claim failed.
bool any_failed(const std::vector<Verdict> &verdicts);

/// What the program returns to the shell.
namespace exit_status
{
constexpr int good          = 0;
constexpr int claim_failed  = 1;
constexpr int bad_input     = 2;
constexpr int not_converged = 3;
constexpr int claim_open    = 4;
constexpr int program_fault = 5;
} // namespace exit_status

/// The worse of two exit statuses, in this order: a fault of homespun itself, bad input, a solver
/// that did not converge, a claim that failed, a claim that is open, good.
int worse(int one, int other);

/// What verdicts amount to: claim_failed, claim_open or good.
int status_of(const std::vector<Verdict> &verdicts);
} // namespace homespun::verification
