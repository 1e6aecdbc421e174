// SPDX-License-Identifier: MIT
#include "verification/strain/gains.h"

#include "verification/cell/discretization_distance.h"
#include "verification/law/laws.h"
#include "verification/method/method.h"
#include "verification/record/claim.h"
#include "verification/strain/budget/budget_rows.h"
#include "verification/strain/strain_cases.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace homespun::verification
{
namespace
{
bool is_reached_in(const StrainRow &row, const StrainRow &of_case)
{
  return row.is_reached() && is_of_case(row, of_case);
}

const StrainRow *row_of(const std::vector<StrainRow> &rows, const StrainRow &of_case,
                        const double strain, const std::string &method)
{
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const StrainRow &row) {
                                    return is_reached_in(row, of_case) && row.strain == strain &&
                                           row.method == method;
                                  });
  return found == rows.end() ? nullptr : &*found;
}

/// Error over error, of two that are larger than what the solvers leave.
double error_ratio(const StrainRow &one, const StrainRow &other)
{
  const double least = solved_to * one.strain;
  return one.per_cell > least && other.per_cell > least ? one.mean / other.mean : GainRow::none;
}

const std::string its_base = "base";

/// A pair of methods under one load and law, and the claim that the first is closer.
struct Pair
{
  std::string method, other;

  /// @param lost as of method_verdicts()
  Verdict judged(const std::vector<StrainRow> &rows, const StrainRow &of_case, const double strain,
                 const double lost) const
  {
    Words words = {{"cell", of_case.cell},           {"load", of_case.load}, {"method", method},
                   {"reference", of_case.reference}, {"strain", strain},     {"note", ""}};
    const auto verdict = [&](const Outcome outcome, const double value)
    { return verification::judged("closer-than." + other, words, outcome, value); };
    const auto open = [&](const double value, const std::string &why)
    {
      words["note"] = "; open: " + why;
      return verdict(Outcome::inconclusive, value);
    };
    if (strain >= lost)
      return open(lost,
                  "from the strain of the value on reference or coarse cloth is not elliptic");
    double reached = 0.;
    for (const StrainRow &row : rows)
      if (is_reached_in(row, of_case) && row.strain <= strain)
        reached = std::max(reached, row.strain);
    if (reached < strain)
      return open(reached,
                  "the level was not reached; the value is the largest strain below it that was");
    const StrainRow *const one  = row_of(rows, of_case, strain, method);
    const StrainRow *const than = other != its_base ? row_of(rows, of_case, strain, other)
                                  : one != nullptr  ? base_of(rows, *one)
                                                    : nullptr;
    if (one == nullptr || than == nullptr)
      return open(GainRow::none, other == its_base ? "no error of a base is known: have " + method +
                                                       "-micro and affine+p2 among --methods"
                                                   : "not among the methods of this level");
    if (other == its_base)
      words["note"] = "; base: " + than->method;
    const double gain  = than->mean - one->mean; // not a number without an equilibrium
    const double bars  = one->bar + than->bar;   // nor is this, where one is not known
    const double ratio = one->mean / than->mean;
    if (!std::isfinite(bars))
      words["note"] += "; open: an error bar is not known";
    else if (std::fmax(one->bar_safety, than->bar_safety) >= safety_unconfirmed)
    {
      words["note"] += "; open: errors of P1, P2 and refined P2 do not come together, and bear no "
                       "claim";
      return verdict(Outcome::inconclusive, ratio);
    }
    return verdict(!(std::abs(than->per_cell - one->per_cell) > solved_to * strain)
                     ? Outcome::inconclusive
                   : gain > bars  ? Outcome::pass
                   : gain < -bars ? Outcome::fail
                                  : Outcome::inconclusive,
                   ratio);
  }
};
} // namespace

std::set<double> strains_of_methods(const std::vector<double> &asked)
{
  std::set<double> judged;
  for (const double strain : judged_strains(asked))
    if (strain < 0.05)
      judged.insert(strain);
  double largest = 0.;
  for (const double strain : asked)
    if (strain <= 0.101)
      largest = std::max(largest, strain);
  if (largest > 0.)
    judged.insert(largest);
  return judged;
}

const StrainRow *base_of(const std::vector<StrainRow> &rows, const StrainRow &of)
{
  const Law law = law_of(of.reference);
  const Load load(of.load);
  const Method method   = under(Method(of.method), law, load),
               coarse   = under(method.without(Term::micro), law, load),
               p2       = under(Method("affine+p2"), law, load);
  const StrainRow *base = nullptr;
  for (const StrainRow &row : rows)
    if (is_reached_in(row, of) && row.strain == of.strain && std::isfinite(row.mean))
    {
      const Method its = under(Method(row.method), law, load);
      if ((its.has_terms_of(coarse) || (method.has(Term::p2) && its.has_terms_of(p2))) &&
          (base == nullptr || row.mean < base->mean))
        base = &row;
    }
  return base;
}

std::vector<GainRow> gain_rows(const std::vector<StrainRow> &rows)
{
  std::vector<GainRow> gains;
  for (const StrainRow &row : rows)
    if (row.is_reached() && std::isfinite(row.mean) && Method(row.method).has(Term::micro))
    {
      const StrainRow *const base = base_of(rows, row), *const affine =
                                                          row_of(rows, row, row.strain, "affine");
      if (base != nullptr)
        gains.push_back({row.cell, row.load, row.strain, row.reference, row.method, base->method,
                         affine == nullptr ? GainRow::none : error_ratio(*affine, *base),
                         error_ratio(*base, row),
                         affine == nullptr ? GainRow::none : error_ratio(*affine, row)});
    }
  return gains;
}

std::vector<Verdict> method_verdicts(const std::vector<StrainRow> &rows, const StrainRow &of_case,
                                     const std::vector<double> &asked,
                                     const std::vector<std::string> &methods, const double lost)
{
  std::vector<std::string> names;
  for (const StrainRow &row : rows)
    if (is_reached_in(row, of_case))
      names.push_back(row.method);
  if (names.empty())
    names = distinct_methods(methods, law_of(of_case.reference), Load(of_case.load));
  const auto has = [&](const std::string &name)
  { return std::find(names.begin(), names.end(), name) != names.end(); };
  const std::string main = main_method(names);
  std::vector<Pair> pairs;
  if (main != "localized")
    pairs.push_back({main, its_base});
  if (has("localized") && has("affine"))
    pairs.push_back({"localized", "affine"});
  if (has("localized") && main != "localized")
    pairs.push_back({main, "localized"});
  std::vector<Verdict> verdicts;
  for (const double strain : strains_of_methods(asked))
    for (const Pair &pair : pairs)
      verdicts.push_back(pair.judged(rows, of_case, strain, lost));
  return verdicts;
}

std::vector<Verdict> verdicts_of_own_method(const std::vector<StrainRow> &rows,
                                            const StrainRow &of_case, const double lost)
{
  std::vector<double> strains;
  for (const StrainRow &row : rows)
    if (is_reached_in(row, of_case) && row.method == of_case.method)
      strains.push_back(row.strain);
  std::vector<Verdict> verdicts;
  for (const double strain : strains_of_methods(strains))
    for (const char *other : {"affine", "localized"})
      verdicts.push_back(Pair{of_case.method, other}.judged(rows, of_case, strain, lost));
  return verdicts;
}
} // namespace homespun::verification
