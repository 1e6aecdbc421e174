// SPDX-License-Identifier: MIT
// A stress case as data: what is done, how it must end, the one figure that is measured and its
// limit; and what became of it. Running never throws: a failure is a row of the table, not the end
// of the program.
#pragma once

#include "verification/extremes/stress_tables.h"
#include "verification/record/verdict.h"

#include <Eigen/Core>

#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace homespun::verification
{
/// What one repetition found.
struct StressAnswer
{
  double figure = 0.;     ///< compared with the case's limit
  Eigen::MatrixXd values; ///< all numbers that a user would get; every one must be finite
};

enum class ExpectedEnd
{
  finite, ///< a finite answer whose figure is within the limit
  refused ///< BadInput or NotConverged, whose message names the fault
};

struct StressCase
{
  std::string group, name;
  std::string expected; ///< in words
  ExpectedEnd ending = ExpectedEnd::finite;
  double limit       = 0.; ///< of the figure; finite cases
  std::string figure_is;   ///< what the figure is, with its unit; finite cases
  std::string names;       ///< what the refusal must contain; refused cases
  /// Seeds differ; else every repetition must give the same numbers to the last bit.
  bool is_random = false;
  /// @throws BadInput, NotConverged where it refuses
  std::function<StressAnswer(unsigned int seed)> run;
  /// For cases that are long or need but a second look.
  int most_repeats = std::numeric_limits<int>::max();
  std::string derivation; ///< where the limit comes from, known before the figure; finite cases
};

/// What the figure of a finite case is, with its unit, and its limit.
struct Figure
{
  double limit;
  std::string is;
};

/// Cases of one group, added to a list.
class CaseGroup
{
public:
  using Run = std::function<StressAnswer(unsigned int seed)>;

  CaseGroup(std::string name, std::vector<StressCase> &cases);

  /// A case that ends in an answer; repetitions give the same numbers, unless told otherwise.
  /// @return the case, until the next one is added
  StressCase &finite(const std::string &name, const std::string &expected, const Figure &figure,
                     const Run &run);

  /// A case that is refused with a message that contains `names`.
  StressCase &refused(const std::string &name, const std::string &names, const Run &run);

private:
  const std::string group;
  std::vector<StressCase> &cases;
};

/// Where limits come from, by what the figure is.
using Derivations = std::map<std::string, std::string>;

/// Gives the cases that end in an answer the derivation of their figure; one that is not known
/// stays empty.
void derive(std::vector<StressCase> &cases, const Derivations &derivations);

/// Growth of energy that round-off explains, over the largest energy: the cloth's own slack
/// (shell/solver/cloth.cc), 1e-12 of the energy before and of what is stored, in up to five parts
/// of a step that was cut.
constexpr double energy_round_off = 1e-11;

/// Where that comes from.
inline const char *const of_energy =
  "theory: nothing brings energy into the sheet, and damping takes some; round-off: 1e-12 of the "
  "energy before and of what is stored, in up to five parts of a step that was cut";

/// The figure of most sheets that are let go, and what is expected of it.
inline const char *const growth_of_energy = "largest growth in a step over the largest energy [-]";
inline const char *const largest_way      = "largest way of a vertex [m]";
inline const char *const never_grows      = "finite; the energy of the damped sheet never grows";

struct StressResult
{
  std::string outcome;  ///< finite; finite but ...; not finite; refused: message; error: message
  double figure   = 0.; ///< the largest of all repetitions; not-a-number where there is none
  Outcome verdict = Outcome::fail;
  int repeats     = 0;
  double seconds  = 0.; ///< of all repetitions
};

/// Runs a case with the seeds 0 ... repeats − 1, or fewer where the case wants no more.
StressResult run_case(const StressCase &stress_case, int repeats);

/// The limit as a table shows it: of the figure, or the words that a refusal must contain.
std::string limit_text(const StressCase &stress_case);

/// What names a case in the table.
StressRow keys_of(const StressCase &stress_case);

/// The row of a case that was run.
/// @throws std::logic_error where its limit has no derivation
StressRow stress_row(const StressCase &stress_case, const StressResult &result);

/// One verdict per group, in the order of the rows: how many of its cases do not hold.
std::vector<Verdict> stress_verdicts(const std::vector<StressRow> &rows);
} // namespace homespun::verification
