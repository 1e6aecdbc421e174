// SPDX-License-Identifier: MIT
// The tables of `homespun converge`: series over levels, the claims about them, and the cases that
// are complete.
#pragma once

#include "verification/record/table.h"

#include <limits>
#include <optional>
#include <string>

namespace homespun::verification
{
/// A level of a series. What there is none of is not a number.
struct ConvergeRow
{
  static constexpr const char *file   = "converge.csv";
  static constexpr std::size_t n_keys = 6;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  std::string cell, study, name, quantity; ///< the quantity with its unit in brackets
  unsigned int order_p = 1;                ///< P1 or P2
  unsigned long level  = 0;                ///< coarse to fine
  double h             = none;
  std::string h_unit;
  unsigned long dofs = 0; ///< 0: the level solves nothing
  double value = none, error = none;
  double observed_order = none; ///< between the level before and this one
  double order = none, spread = none, order_lowest = none, order_highest = none; ///< of the series
  double richardson_limit = none, gci = none;
  std::optional<Outcome> judgement; ///< none: reported, not judged
  double seconds = 0.;

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &ConvergeRow::cell, Domain::name);
    column("study", &ConvergeRow::study, Domain::name);
    column("case", &ConvergeRow::name, Domain::name);
    column("quantity", &ConvergeRow::quantity, Domain::name);
    column("order_p", &ConvergeRow::order_p, Domain::positive);
    column("level", &ConvergeRow::level, Domain::needed_not_negative);
    column("h", &ConvergeRow::h, Domain::positive);
    column("h_unit", &ConvergeRow::h_unit, Domain::name);
    column("dofs", &ConvergeRow::dofs, Domain::needed_not_negative);
    column("value", &ConvergeRow::value, Domain::real);
    column("error", &ConvergeRow::error, Domain::not_negative);
    column("observed_order", &ConvergeRow::observed_order, Domain::real);
    column("order", &ConvergeRow::order, Domain::real);
    column("spread", &ConvergeRow::spread, Domain::not_negative);
    column("order_lowest", &ConvergeRow::order_lowest, Domain::real);
    column("order_highest", &ConvergeRow::order_highest, Domain::real);
    column("richardson_limit", &ConvergeRow::richardson_limit, Domain::real);
    column("gci", &ConvergeRow::gci, Domain::not_negative);
    column("judgement", &ConvergeRow::judgement, Domain::outcome);
    column("seconds", &ConvergeRow::seconds, Domain::needed_not_negative);
  }
};

/// A claim of a case.
struct ClaimRow
{
  static constexpr const char *file   = "claims.csv";
  static constexpr std::size_t n_keys = 4;

  std::string cell, study, name, claim;
  std::string id; ///< in claims.json; nothing where it has none
  Outcome verdict = Outcome::inconclusive;
  double value    = ConvergeRow::none;
  std::string limit;
  Kind kind = Kind::program;
  std::string derivation;

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &ClaimRow::cell, Domain::name);
    column("study", &ClaimRow::study, Domain::name);
    column("case", &ClaimRow::name, Domain::name);
    column("claim", &ClaimRow::claim, Domain::name);
    column("verdict", &ClaimRow::verdict, Domain::outcome);
    column("value", &ClaimRow::value, Domain::real);
    column("limit", &ClaimRow::limit, Domain::name);
    column("kind", &ClaimRow::kind, Domain::name);
    column("derivation", &ClaimRow::derivation, Domain::name);
    column("id", &ClaimRow::id, Domain::text);
  }
};

/// A case that is complete: all that belongs to it is in the other tables.
struct CaseRow
{
  static constexpr const char *file   = "cases.csv";
  static constexpr std::size_t n_keys = 3;

  std::string cell, study, name;
  double seconds = 0.;

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &CaseRow::cell, Domain::name);
    column("study", &CaseRow::study, Domain::name);
    column("case", &CaseRow::name, Domain::name);
    column("seconds", &CaseRow::seconds, Domain::needed_not_negative);
  }
};
} // namespace homespun::verification
