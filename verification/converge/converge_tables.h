// SPDX-License-Identifier: MIT
// The table of `homespun converge`: series over levels, the claims about them, and the cases that
// are complete.
#pragma once

#include "verification/record/table.h"

#include <limits>
#include <optional>
#include <string>

namespace homespun::verification
{
/// A row of a case. What its kind does not have is empty. `kind`:
///   level  of a series
///   claim  about the series of the case
///   case   it is complete: all other rows of it are there
struct ConvergeRow
{
  static constexpr const char *file       = "converge.csv";
  static constexpr const char *level_kind = "level", *claim_kind = "claim", *case_kind = "case";
  static constexpr std::size_t n_keys = 7;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  std::string cell, study, name;
  std::string kind                    = level_kind;
  std::string quantity                = {}; ///< with its unit in brackets
  std::optional<unsigned int> order_p = {}; ///< P1 or P2
  std::optional<unsigned long> level  = {}; ///< coarse to fine; of a claim its number
  double h                            = none;
  std::string h_unit                  = {};
  std::optional<unsigned long> dofs   = {}; ///< 0: the level solves nothing
  double value = none, error = none;
  double observed_order = none; ///< between the level before and this one
  double order = none, spread = none, order_lowest = none, order_highest = none; ///< of the series
  double richardson_limit = none, gci = none;
  std::optional<Outcome> judgement  = {}; ///< none: the series is reported, not judged
  double seconds                    = none;
  std::string claim                 = {}; ///< its sentence
  std::string id                    = {}; ///< in claims.json; nothing where it has none
  std::optional<Kind> kind_of_claim = {}; ///< program, input or method
  std::string limit = {}, derivation = {};

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &ConvergeRow::cell, Domain::name);
    column("study", &ConvergeRow::study, Domain::name);
    column("case", &ConvergeRow::name, Domain::name);
    column("kind", &ConvergeRow::kind, Domain::name);
    column("quantity", &ConvergeRow::quantity, Domain::text);
    column("order_p", &ConvergeRow::order_p, Domain::not_negative);
    column("level", &ConvergeRow::level, Domain::not_negative);
    column("h", &ConvergeRow::h, Domain::not_negative);
    column("h_unit", &ConvergeRow::h_unit, Domain::text);
    column("dofs", &ConvergeRow::dofs, Domain::not_negative);
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
    column("seconds", &ConvergeRow::seconds, Domain::not_negative);
    column("claim", &ConvergeRow::claim, Domain::text);
    column("id", &ConvergeRow::id, Domain::text);
    column("kind_of_claim", &ConvergeRow::kind_of_claim, Domain::text);
    column("limit", &ConvergeRow::limit, Domain::text);
    column("derivation", &ConvergeRow::derivation, Domain::text);
  }
};
} // namespace homespun::verification
