// SPDX-License-Identifier: MIT
// The tables of the stability map: where each axis ends, and its rungs.
#pragma once

#include "verification/record/fields.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

namespace homespun::verification
{
/// How far one thing may be driven until the answer is wrong, and why it ends there.
struct LimitRow
{
  static constexpr const char *file   = "limits.csv";
  static constexpr std::size_t n_keys = 2;

  std::string axis, of, value_is;
  std::optional<double> reached, end; ///< the largest value that is right, the first that is wrong
  std::string ended_by; ///< error, solver, repetition, cap, or ladder: no value was wrong
  std::string why;
  double error = std::numeric_limits<double>::quiet_NaN(); ///< at the end, or else where reached
  double limit = 0.;                                       ///< of the error
  std::string criterion;
  std::optional<double>
    theory; ///< where theory sees the end, or promises that there is none before
  std::string theory_is;
  double seconds = 0.;

  template <typename Column>
  static void columns(Column &&column)
  {
    column("axis", &LimitRow::axis, Domain::name);
    column("of", &LimitRow::of, Domain::name);
    column("value_is", &LimitRow::value_is, Domain::name);
    column("reached", &LimitRow::reached, Domain::not_negative);
    column("end", &LimitRow::end, Domain::not_negative);
    column("ended_by", &LimitRow::ended_by, Domain::name);
    column("why", &LimitRow::why, Domain::name);
    column("error", &LimitRow::error, Domain::not_negative);
    column("limit", &LimitRow::limit, Domain::positive);
    column("criterion", &LimitRow::criterion, Domain::name);
    column("theory", &LimitRow::theory, Domain::not_negative);
    column("theory_is", &LimitRow::theory_is, Domain::text);
    column("seconds", &LimitRow::seconds, Domain::needed_not_negative);
  }
};

/// One value along an axis. Iterations and DoFs are those of the cell problem, where there is one.
struct StressRow
{
  static constexpr const char *file   = "stress.csv";
  static constexpr std::size_t n_keys = 3;

  std::string axis, of;
  double value = 0.;
  double error = std::numeric_limits<double>::quiet_NaN();
  double limit = 0.;
  std::string outcome; ///< right, wrong, or what was refused and why
  std::optional<unsigned int> iterations;
  std::optional<unsigned long> dofs;
  double seconds = 0.;

  template <typename Column>
  static void columns(Column &&column)
  {
    column("axis", &StressRow::axis, Domain::name);
    column("of", &StressRow::of, Domain::name);
    column("value", &StressRow::value, Domain::positive);
    column("error", &StressRow::error, Domain::not_negative);
    column("limit", &StressRow::limit, Domain::positive);
    column("outcome", &StressRow::outcome, Domain::name);
    column("iterations", &StressRow::iterations, Domain::not_negative);
    column("dofs", &StressRow::dofs, Domain::not_negative);
    column("seconds", &StressRow::seconds, Domain::needed_not_negative);
  }
};

/// A limit that is shipped: verification/published/limits.csv.
struct PublishedLimitRow
{
  static constexpr std::size_t n_keys = 2;

  std::string axis, of, value_is;
  std::optional<double> reached, end;
  std::string ended_by, why;
  double error = std::numeric_limits<double>::quiet_NaN();
  std::optional<double> theory;
  std::string run, revision;

  template <typename Column>
  static void columns(Column &&column)
  {
    column("axis", &PublishedLimitRow::axis, Domain::name);
    column("of", &PublishedLimitRow::of, Domain::name);
    column("value_is", &PublishedLimitRow::value_is, Domain::name);
    column("reached", &PublishedLimitRow::reached, Domain::not_negative);
    column("end", &PublishedLimitRow::end, Domain::not_negative);
    column("ended_by", &PublishedLimitRow::ended_by, Domain::name);
    column("why", &PublishedLimitRow::why, Domain::name);
    column("error", &PublishedLimitRow::error, Domain::not_negative);
    column("theory", &PublishedLimitRow::theory, Domain::not_negative);
    column("run", &PublishedLimitRow::run, Domain::name);
    column("revision", &PublishedLimitRow::revision, Domain::name);
  }
};
} // namespace homespun::verification
