// SPDX-License-Identifier: MIT
// The tables of the stress study: what became of each case, and what the solver of the cell problem
// cost.
#pragma once

#include "verification/record/fields.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

namespace homespun::verification
{
/// A case and what became of it.
struct StressRow
{
  static constexpr const char *file   = "stress.csv";
  static constexpr std::size_t n_keys = 2;

  std::string group, name, expected, outcome;
  double figure = std::numeric_limits<double>::quiet_NaN(); ///< the largest of all repetitions
  std::string limit;                                        ///< number and what it is of
  Outcome verdict = Outcome::fail;
  int repeats     = 0;
  double seconds  = 0.;   ///< of all repetitions
  std::string derivation; ///< where the limit comes from

  template <typename Column>
  static void columns(Column &&column)
  {
    column("group", &StressRow::group, Domain::name);
    column("case", &StressRow::name, Domain::name);
    column("expected", &StressRow::expected, Domain::name);
    column("outcome", &StressRow::outcome, Domain::name);
    column("figure", &StressRow::figure, Domain::real);
    column("limit", &StressRow::limit, Domain::name);
    column("verdict", &StressRow::verdict, Domain::outcome);
    column("repeats", &StressRow::repeats, Domain::needed_not_negative);
    column("seconds", &StressRow::seconds, Domain::needed_not_negative);
    column("derivation", &StressRow::derivation, Domain::name);
  }
};

/// Iterations and times of the conjugate gradients of one cell: numbers without a limit.
struct SolverRow
{
  static constexpr const char *file   = "solver.csv";
  static constexpr std::size_t n_keys = 4;

  std::string parameter; ///< contrast, poisson, anisotropy, sliver, triangles
  double value = 0.;
  std::string cell;
  unsigned int order = 1;
  std::optional<unsigned long> dofs;
  std::optional<unsigned int> iterations;                          ///< the most of the three loads
  double seconds       = std::numeric_limits<double>::quiet_NaN(); ///< preconditioner and solve
  double seconds_total = std::numeric_limits<double>::quiet_NaN();
  int repeats          = 0; ///< of which both times are medians
  std::string outcome;      ///< converged, or why not

  template <typename Column>
  static void columns(Column &&column)
  {
    column("parameter", &SolverRow::parameter, Domain::name);
    column("value", &SolverRow::value, Domain::real);
    column("cell", &SolverRow::cell, Domain::name);
    column("order", &SolverRow::order, Domain::positive);
    column("dofs", &SolverRow::dofs, Domain::not_negative);
    column("iterations", &SolverRow::iterations, Domain::not_negative);
    column("seconds", &SolverRow::seconds, Domain::not_negative);
    column("seconds_total", &SolverRow::seconds_total, Domain::not_negative);
    column("repeats", &SolverRow::repeats, Domain::needed_not_negative);
    column("outcome", &SolverRow::outcome, Domain::name);
  }
};
} // namespace homespun::verification
