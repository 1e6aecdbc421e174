// SPDX-License-Identifier: MIT
// What a convergence study measures and how it reaches the disk: series of a quantity over levels
// as rows of converge.csv, with the claims about them and a row for each case that is complete, so
// that a study that was cut short is taken up again.
#pragma once

#include "meshes/plain/errors.h"
#include "verification/converge/converge_tables.h"
#include "verification/record/claim.h"
#include "verification/record/convergence.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
struct ConvergenceLevel
{
  double h             = 0.; ///< true size, in the series' unit
  unsigned long n_dofs = 0;  ///< 0: the level solves nothing
  std::optional<double> value, error;
  double seconds = 0.;
};

/// A quantity over levels, coarse to fine.
struct Series
{
  std::string quantity;   ///< with its unit in brackets
  unsigned int order = 1; ///< P1 or P2
  std::string h_unit;
  std::vector<ConvergenceLevel> levels;
  std::optional<OrderJudgement> judgement; ///< none: reported, not judged
  std::optional<Richardson> richardson;

  /// Sets the Richardson limit and the errors as distances from it; the error bar only where the
  /// order has settled, else it would be that of an order that is not there.
  /// @param floor, highest_order as extrapolated() @param judged the same values
  void extrapolate(double floor, double highest_order, const OrderJudgement &judged);

  bool has_error_bar() const;

  std::vector<double> sizes() const;
  std::vector<double> values() const;
  std::vector<double> errors() const;
};

/// What a case gives.
struct ConvergenceResult
{
  std::vector<Series> series;
  std::vector<Verdict> verdicts;
  std::string unfinished; ///< why the levels end early; empty where all are solved
  /// What that is: a failure, unless theory knows of loads that have no equilibrium.
  Outcome outcome_of_unfinished = Outcome::fail;

  /// Runs one level. Where its solver does not converge the levels before it are kept, and the
  /// ladder ends.
  /// @return whether it was solved
  template <typename Level>
  bool solves(Level &&level)
  {
    try
    {
      level();
      return true;
    }
    catch (const meshes::NotConverged &failure)
    {
      unfinished = failure.what();
      return false;
    }
  }

  /// Adds a series that is reported, not judged.
  void add(Series one);

  /// Adds a series, and what its judgement claims of its order.
  void add(Series one, const std::string &claim, Words words = {});
};

/// A case: one cell, one study, one load or solver.
struct ConvergenceCase
{
  std::string cell, study, name;
  std::function<ConvergenceResult()> run; ///< to be called on every rank. @throws NotConverged
};

/// The table of a study, on the first rank alone.
class ConvergenceRecord
{
public:
  /// Takes up the table of a folder: rows and claims of complete cases are kept; what others left
  /// is dropped, because they run again.
  explicit ConvergenceRecord(const std::string &folder);

  bool is_complete(const ConvergenceCase &one) const;

  /// Rows and claims, and where nothing is unfinished that the case is complete.
  void add(const ConvergenceCase &one, const ConvergenceResult &result, double seconds);

  /// Claims of all cases, in the order of the table.
  std::vector<Verdict> verdicts() const;

  /// The levels of all series.
  std::vector<ConvergeRow> levels() const;

private:
  std::vector<ConvergeRow> of_kind(const std::string &kind) const;

  Table<ConvergeRow> rows;
};
} // namespace homespun::verification
