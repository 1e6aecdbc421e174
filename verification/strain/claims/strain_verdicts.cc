// SPDX-License-Identifier: MIT
#include "verification/strain/claims/strain_verdicts.h"

#include "verification/record/claim.h"
#include "verification/record/convergence.h"
#include "verification/record/main_reference.h"
#include "verification/record/number_text.h"
#include "verification/reference/fine_reference.h"
#include "verification/reference/loads.h"
#include "verification/strain/gains.h"
#include "verification/strain/strain_cases.h"
#include "verification/strain/validity.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace homespun::verification
{
namespace
{
template <typename Row>
Words words_of(const Row &of_case)
{
  return {{"cell", of_case.cell}, {"load", of_case.load}, {"reference", of_case.reference}};
}

/// The rows up to where the law of their case is lost: beyond, no minimum need exist, and what was
/// found there, or was not, is no claim of the method or of the solver.
/// @param levels rows of levels.csv
std::vector<StrainRow> rows_of_laws(const std::vector<StrainRow> &rows,
                                    const std::vector<LevelRow> &levels)
{
  std::vector<StrainRow> kept;
  for (const StrainRow &row : rows)
    if (!(row.strain > elliptic_up_to(levels, row.cell, row.load, row.reference)))
      kept.push_back(row);
  return kept;
}

/// @param lost strain from which on the law is lost; not a number where it never is
Verdict verdict_of_reach(const std::vector<StrainRow> &rows, const StrainRow &of_case,
                         const std::vector<double> &asked, const double lost)
{
  for (const double strain : asked)
    if (std::none_of(rows.begin(), rows.end(),
                     [&](const StrainRow &row)
                     { return is_of_case(row, of_case) && row.strain == strain; }))
    {
      Words words     = words_of(of_case);
      words["levels"] = asked.size();
      words["note"]   = "; strain.csv has no row at strain " + short_text(strain);
      return judged("equilibria", words, Outcome::fail, 1.);
    }
  std::size_t n_missing = 0;
  bool any              = false; // level was reached
  double first          = std::numeric_limits<double>::infinity();
  for (const StrainRow &row : rows)
    if (is_of_case(row, of_case) && row.is_reached())
      any = true;
    else if (is_of_case(row, of_case))
    {
      ++n_missing;
      first = std::min(first, row.strain);
    }
  const bool is_lost = first > lost;
  Words words        = words_of(of_case);
  words["levels"]    = asked.size();
  words["note"]      = (n_missing == 0 ? "" : "; none from strain " + short_text(first) + " on") +
                  (is_lost ? "; the law is lost at " + percent_text(lost) : std::string());
  return judged("equilibria", words,
                n_missing == 0 && any ? Outcome::pass
                : any || is_lost      ? Outcome::inconclusive
                                      : Outcome::fail,
                static_cast<double>(n_missing));
}

bool is_in_window(const double strain)
{
  return strain >= 0.99e-4 && strain <= 0.101;
}

/// What a claim says that a loss leaves no levels for; nothing where the law is lost from rest on,
/// which no law is.
std::vector<Verdict> open_by_loss(const char *claim, Words words, const double lost)
{
  if (!(lost > 0.))
    return {};
  words["note"] = "; the law is lost at " + percent_text(lost);
  return {judged(claim, words, Outcome::inconclusive, std::numeric_limits<double>::quiet_NaN())};
}

/// @param method whose rows are judged by what is claimed of `localized`
std::vector<Verdict> periodic_verdict(const std::vector<StrainRow> &rows, const StrainRow &of_case,
                                      const std::vector<double> &asked,
                                      const std::string &method = "localized")
{
  if (!decides_slope(asked))
    return {};
  std::vector<std::pair<double, double>> levels; // strain and error
  for (const StrainRow &row : rows)
    if (is_of_case(row, of_case) && row.method == method && row.strain <= 0.101)
      levels.emplace_back(row.strain, row.per_cell);
  std::sort(levels.begin(), levels.end());
  std::vector<double> strains, errors; // in the window of the claim
  double largest = 0.;                 // per strain
  for (const auto &[strain, error] : levels)
    if (is_in_window(strain))
    {
      strains.push_back(strain);
      errors.push_back(error);
      largest = larger(largest, error / strain);
    }
  const double none  = std::numeric_limits<double>::quiet_NaN();
  const auto verdict = [&](const Outcome outcome, const double value,
                           const std::string &note) -> std::vector<Verdict>
  {
    Words words   = words_of(of_case);
    words["note"] = note;
    return {judged("strain-squared.slope", words, outcome, value)};
  };
  if (!std::all_of(levels.begin(), levels.end(),
                   [](const auto &level) { return std::isfinite(level.second); }))
    return verdict(Outcome::fail, none, "; an error is not a number");
  if (strains.size() < 3)
    return verdict(Outcome::inconclusive, none, " over at least three levels from 1e-4 to 0.1");
  if (largest < solved_to)
  {
    Words words    = words_of(of_case);
    words["limit"] = solved_to;
    return {judged("strain-squared.zero", words, Outcome::pass, largest)};
  }
  const double slope = log_slope(strains, errors);
  if (std::abs(slope - 2.) <= 0.1)
    return verdict(Outcome::pass, slope, "");

  // Theory speaks of strains that are small against what the cell bears, which a weave, soft in
  // shear, does not at 1 %; where its symmetry leaves no quadratic term, the error falls faster.
  strains.clear();
  errors.clear();
  for (const auto &[strain, error] : levels)
    if (error > solved_to * strain)
    {
      strains.push_back(strain);
      errors.push_back(error);
    }
  if (strains.size() < 3)
    return verdict(Outcome::inconclusive, slope,
                   "; fewer than three levels above what the solvers leave: give larger "
                   "--strains");
  return {verdict_of_smallest("strain-squared.smallest", words_of(of_case), strains, errors)};
}

/// What `localized` must pass, `affine` must not, wherever it errs by strain as theory says: so it
/// is seen that the claim can fail.
std::vector<Verdict> affine_verdict(const std::vector<StrainRow> &rows, const StrainRow &of_case,
                                    const std::vector<double> &asked)
{
  std::vector<std::pair<double, double>> levels; // strain and error
  for (const StrainRow &row : rows)
    if (is_of_case(row, of_case) && row.method == "affine" && is_in_window(row.strain) &&
        row.per_cell > 10. * solved_to * row.strain)
      levels.emplace_back(row.strain, row.per_cell);
  std::sort(levels.begin(), levels.end());
  if (levels.size() < 3)
    return {};
  const double slope =
    std::log(levels[1].second / levels[0].second) / std::log(levels[1].first / levels[0].first);
  const std::vector<Verdict> judged_as_squared = periodic_verdict(rows, of_case, asked, "affine");
  if (std::abs(slope - 1.) > 0.1 || judged_as_squared.empty())
    return {}; // strains at which theory does not hold yet
  return {judged("affine-slope", {{"cell", of_case.cell}, {"load", of_case.load}},
                 judged_as_squared[0].outcome == Outcome::pass ? Outcome::fail : Outcome::pass,
                 slope)};
}

/// How much the slopes between three levels differ where errors are a e + b e², a, b >= 0, and have
/// a slope on the whole; zero of other slopes.
double rise_of_slope(const double slope, const double last_over_first)
{
  if (slope <= 1. || slope >= 2.)
    return 0.;
  const double x = (slope - 1.) / (2. - slope), // b e / a in the middle
    q            = std::pow(last_over_first, 0.25);
  const auto at  = [](const double ratio) { return ratio / (1. + ratio); };
  return at(x * q) - at(x / q);
}
} // namespace

Verdict verdict_of_smallest(const std::string &claim, Words words,
                            const std::vector<double> &strains, const std::vector<double> &errors)
{
  const auto between = [&](const std::size_t k)
  { return std::log(errors[k + 1] / errors[k]) / std::log(strains[k + 1] / strains[k]); };
  const auto verdict = [&](const Outcome outcome, const double value, const std::string &note)
  {
    words["note"] = note;
    return judged(claim, words, outcome, value);
  };
  const double first = between(0), second = between(1);
  if (std::abs(first - second) <= 0.1)
  {
    const double slope =
      log_slope({strains.begin(), strains.begin() + 3}, {errors.begin(), errors.begin() + 3});
    const double rise = rise_of_slope(slope, strains[2] / strains[0]);
    if (rise > 0.1 && second - first < 0.5 * rise)
      return verdict(Outcome::inconclusive, slope,
                     "; errors of first and second order together would have slopes that rise by " +
                       short_text(rise) +
                       ": the strains are not small for this cell, give smaller --strains");
    return verdict(slope >= 1.9 ? Outcome::pass : Outcome::fail, slope, "");
  }
  // a e + b e² has slopes that rise from one to two; beyond, other powers are in play, unless the
  // first is near one.
  if (first < 1.9 && first < second && (second <= 2.1 || first < 1.5))
    return verdict(Outcome::fail, first, "");
  return verdict(Outcome::inconclusive, first,
                 "; the slopes at the three smallest levels still differ: give smaller --strains");
}

bool is_shared(const std::string &reference)
{
  return reference == name_of(Law::biot) || is_of_yarns(law_of(reference));
}

bool decides_slope(const std::vector<double> &strains)
{
  return std::count_if(strains.begin(), strains.end(), is_in_window) >= 3;
}

std::vector<Verdict> strain_verdicts(const std::vector<StrainRow> &all,
                                     const std::vector<double> &strains,
                                     const std::vector<LevelRow> &levels,
                                     const std::vector<std::string> &methods)
{
  const std::vector<StrainRow> rows = rows_of_laws(all, levels);
  std::vector<Verdict> verdicts;
  const auto add = [&](const std::vector<Verdict> &some)
  { verdicts.insert(verdicts.end(), some.begin(), some.end()); };
  const std::vector<StrainRow> cases = cases_of(all);
  const auto lost_of                 = [&](const StrainRow &of_case)
  { return elliptic_up_to(levels, of_case.cell, of_case.load, of_case.reference); };
  for (const StrainRow &of_case : cases)
    if (is_shared(of_case.reference) && of_case.reference == main_reference(all, of_case.cell))
    {
      const double lost = lost_of(of_case);
      if (!Load(of_case.load).is_periodic())
      {
        add(method_verdicts(all, of_case, strains, methods, lost));
        continue;
      }
      std::vector<double> asked;
      std::copy_if(strains.begin(), strains.end(), std::back_inserter(asked),
                   [=](const double strain) { return !(strain > lost); });
      add(decides_slope(strains) && !decides_slope(asked)
            ? open_by_loss("strain-squared.slope", words_of(of_case), lost)
            : periodic_verdict(rows, of_case, asked));
      add(affine_verdict(rows, of_case, asked));
    }
  for (const StrainRow &of_case : cases)
    verdicts.push_back(verdict_of_reach(all, of_case, strains, lost_of(of_case)));
  return verdicts;
}

std::vector<Verdict> stability_verdicts(const std::vector<LevelRow> &all)
{
  std::vector<LevelRow> solved;
  std::copy_if(all.begin(), all.end(), std::back_inserter(solved),
               [](const LevelRow &row)
               { return row.is_solved() && row.reference != name_of(Law::linear); });
  std::vector<Verdict> verdicts;
  for (const LevelRow &of_case : cases_of(solved))
  {
    const double lost = elliptic_up_to(all, of_case.cell, of_case.load, of_case.reference);
    int n_levels = 0, n_not = 0;
    std::string which;
    for (const LevelRow &step : solved)
      if (is_of_case(step, of_case) && !(step.strain > lost))
      {
        ++n_levels;
        if (step.stability != name_of(Stability::every_triangle) &&
            step.stability != name_of(Stability::stable) &&
            step.stability != name_of(Stability::left))
        {
          ++n_not;
          which += (which.empty() ? "; " : ", ") + short_text(100. * step.strain) + " %";
        }
      }
    Words words     = words_of(of_case);
    words["levels"] = n_levels;
    words["note"]   = which;
    if (n_levels > 0)
      verdicts.push_back(
        judged("minimum", words, n_not == 0 ? Outcome::pass : Outcome::inconclusive, n_not));
    else
      for (const Verdict &verdict : open_by_loss("minimum", words, lost))
        verdicts.push_back(verdict);
  }
  return verdicts;
}
} // namespace homespun::verification
