// SPDX-License-Identifier: MIT
#include "verification/strain/claims/budget_verdicts.h"

#include "verification/law/laws.h"
#include "verification/record/claim.h"
#include "verification/record/convergence.h"
#include "verification/record/main_reference.h"
#include "verification/record/number_text.h"
#include "verification/reference/loads.h"
#include "verification/strain/budget/second_code.h"
#include "verification/strain/claims/strain_verdicts.h"
#include "verification/strain/strain_cases.h"
#include "verification/strain/validity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>
#include <utility>

namespace homespun::verification
{
namespace
{
template <typename Row>
bool is_of_level(const Row &row, const BudgetRow &level)
{
  return is_of_case(row, level) && row.strain == level.strain;
}

Words words_of(const BudgetRow &level)
{
  return {{"cell", level.cell}, {"load", level.load}, {"percent", 100. * level.strain}};
}

/// Mean of a part over the whole sheet, per cell side; NaN where the row is not there.
double mean_of(const std::vector<BudgetRow> &rows, const BudgetRow &level, const std::string &part)
{
  for (const BudgetRow &row : rows)
    if (is_of_level(row, level) && row.part == part && row.region == "all")
      return row.per_cell;
  return std::numeric_limits<double>::quiet_NaN();
}

/// The error bar of the reference at a level, per cell side; NaN where there is none.
double bar_of(const std::vector<StrainRow> &rows, const BudgetRow &level)
{
  for (const StrainRow &row : rows)
    if (is_of_level(row, level) && row.mean > 0.)
      return row.uncertainty / row.mean * row.per_cell;
  return std::numeric_limits<double>::quiet_NaN();
}

std::string title_of(const BudgetRow &level)
{
  return level.cell + ", " + level.load + " at " + short_text(100. * level.strain) + " %: ";
}

bool is_zero(const double error, const double strain)
{
  return error < solved_to * strain;
}

/// Above it the bar of a sum says too little of the error to decide on it.
constexpr double widest_bar = 0.2;

/// Whether a sheet of yarns is so far from linear theory, which the part `rest` is of, that the sum
/// of its parts decides nothing: yarns turn against each other where they are pulled by as much as
/// the cloth resists that. More left than the bar is a fault under any law.
bool has_left_linear_theory(const std::vector<BudgetRow> &rows, const BudgetRow &level)
{
  if (!is_of_yarns(law_of(level.reference)) || Load(level.load).is_periodic() ||
      is_zero(mean_of(rows, level, "total"), level.strain))
    return false;
  const double bar = mean_of(rows, level, "unexplained-bar");
  return std::isfinite(bar) && bar > widest_bar * mean_of(rows, level, "total") &&
         mean_of(rows, level, "unexplained") <= bar;
}

/// What a reader is told in the place of a claim on the sum.
std::string note_of_sum(const std::vector<BudgetRow> &rows, const BudgetRow &level)
{
  const double total = mean_of(rows, level, "total");
  const auto percent = [&](const std::string &part)
  { return short_text(std::round(100. * mean_of(rows, level, part) / total)) + " %"; };
  return "what the parts leave, " + percent("unexplained") +
         " of the error, is not judged: under " + level.reference +
         " the sheet, its cell and the terms of edges have left linear theory, which the "
         "part `rest` is of, by up to " +
         percent("unexplained-bar") + " of the error";
}

/// What is not found where P2 and a second code may come to other equilibria, beyond the loss of
/// the law, is open.
struct Miss
{
  Outcome outcome;
  std::string note; ///< for the limit
};

Miss miss_at(const std::vector<LevelRow> &levels, const BudgetRow &level)
{
  const double lost = elliptic_up_to(levels, level.cell, level.load, level.reference);
  if (level.strain > lost)
    return {Outcome::inconclusive, "; the law is lost at " + percent_text(lost)};
  return {Outcome::fail, ""};
}

/// @param bar_of_reference per cell side; not a number where there is none
void judge_level(const std::vector<BudgetRow> &rows, const BudgetRow &level,
                 const double bar_of_reference, const Miss &miss, std::vector<Verdict> &verdicts)
{
  const Words words = words_of(level);
  const auto with   = [&](const char *name, const Word &word)
  {
    Words all = words;
    all.emplace(name, word);
    return all;
  };
  const double total = mean_of(rows, level, "total"), sum = mean_of(rows, level, "sum");
  if (is_zero(total, level.strain))
  {
    verdicts.push_back(judged("budget.zero", with("limit", solved_to),
                              is_zero(sum, level.strain) ? Outcome::pass : Outcome::fail,
                              sum / level.strain));
    return;
  }
  const auto outcome_of = [](const double value, const bool holds, const Outcome otherwise) {
    return !std::isfinite(value) ? Outcome::inconclusive : holds ? Outcome::pass : otherwise;
  };
  const double unexplained = mean_of(rows, level, "unexplained") / total,
               bar         = mean_of(rows, level, "unexplained-bar") / total;
  const bool is_known      = std::isfinite(unexplained) && std::isfinite(bar);
  if (!has_left_linear_theory(rows, level))
    verdicts.push_back(
      judged("budget.unexplained",
             with("bar", !is_known ? "no second code was solved at that strain and law"
                                   : "<= " + short_text(bar) +
                                       (bar > widest_bar ? "; a bar above a fifth of the error "
                                                           "decides nothing"
                                                         : "") +
                                       miss.note),
             !is_known           ? Outcome::inconclusive
             : unexplained > bar ? miss.outcome
             : bar > widest_bar  ? Outcome::inconclusive
                                 : Outcome::pass,
             unexplained));
  const double beyond_solvers =
                 larger(0., mean_of(rows, level, "reference") - solved_to * level.strain),
               covered = beyond_solvers / bar_of_reference;
  if (std::isfinite(bar_of_reference))
    verdicts.push_back(judged("budget.error-bar", with("note", miss.note),
                              outcome_of(covered, covered <= 1., miss.outcome), covered));
  const double solver = mean_of(rows, level, "solver") / total;
  verdicts.push_back(
    judged("budget.solvers", words, outcome_of(solver, solver <= 0.01, Outcome::fail), solver));
}

/// A part of second order in strain, and what it is called in a claim.
struct SecondOrderPart
{
  const char *part, *words;
};

void judge_slope(const SecondOrderPart &of, const std::vector<BudgetRow> &rows,
                 const BudgetRow &of_case, const std::vector<double> &asked,
                 std::vector<Verdict> &verdicts)
{
  if (!decide_order(asked))
    return; // the study was not asked for what would decide it
  std::vector<double> strains = asked, x, y, small_x, small_y;
  std::sort(strains.begin(), strains.end());
  std::size_t n_round_off = 0;
  for (const double strain : strains)
  {
    BudgetRow level   = of_case;
    level.strain      = strain;
    const double mean = mean_of(rows, level, of.part);
    if (!is_small(strain) || !std::isfinite(mean))
      continue;
    if (mean > 10. * solved_to * strain)
    {
      small_x.push_back(strain);
      small_y.push_back(mean);
    }
    if (!decides_order(strain))
      continue;
    n_round_off += is_zero(mean, strain);
    x.push_back(strain);
    y.push_back(mean);
  }
  const bool is_all_zero = !x.empty() && n_round_off == x.size();
  const bool is_decided  = is_all_zero || (x.size() >= 3 && n_round_off == 0);
  const double slope =
    is_decided && !is_all_zero ? log_slope(x, y) : std::numeric_limits<double>::quiet_NaN();
  Words words = {{"cell", of_case.cell}, {"load", of_case.load}, {"part", of.words}, {"note", ""}};
  // 2 % is not small for a weave, and symmetry may leave no quadratic term.
  if (std::abs(slope - 2.) > 0.1 && small_x.size() >= 3)
  {
    verdicts.push_back(verdict_of_smallest("budget-slope.smallest", words, small_x, small_y));
    return;
  }
  if (is_all_zero)
    words["note"] = "; zero to what the solvers leave at every level";
  verdicts.push_back(judged("budget-slope.window", words,
                            !is_decided                                  ? Outcome::inconclusive
                            : is_all_zero || std::abs(slope - 2.) <= 0.1 ? Outcome::pass
                                                                         : Outcome::fail,
                            is_all_zero ? 0. : slope));
}

/// The case of each cell and load, against the main reference of the cell; its strains, ascending.
std::vector<std::pair<BudgetRow, std::vector<double>>>
budgeted_cases(const std::vector<StrainRow> &strain_rows)
{
  std::vector<std::pair<BudgetRow, std::vector<double>>> cases;
  for (const StrainRow &of_case : cases_of(strain_rows))
    if (of_case.reference == main_reference(strain_rows, of_case.cell))
    {
      std::set<double> strains;
      for (const StrainRow &row : strain_rows)
        if (is_of_case(row, of_case))
          strains.insert(row.strain);
      cases.push_back({{of_case.cell, of_case.load, of_case.strain, of_case.reference},
                       {strains.begin(), strains.end()}});
    }
  return cases;
}

/// Calls `judge` with the judged levels of every case.
template <typename Judge>
void at_judged_levels(const std::vector<StrainRow> &strain_rows, const Judge &judge)
{
  for (const auto &[of_case, strains] : budgeted_cases(strain_rows))
    for (const double strain : Load(of_case.load).has_free_sides() // no budget speaks of those
                                 ? std::vector<double>()
                                 : judged_strains(strains))
    {
      BudgetRow level = of_case;
      level.strain    = strain;
      judge(level);
    }
}
} // namespace

std::vector<Verdict> budget_verdicts(const std::vector<StrainRow> &strain_rows,
                                     const std::vector<BudgetRow> &budget_rows,
                                     const std::vector<double> &strains,
                                     const std::vector<LevelRow> &levels)
{
  std::vector<Verdict> verdicts;
  at_judged_levels(strain_rows,
                   [&](const BudgetRow &level) {
                     judge_level(budget_rows, level, bar_of(strain_rows, level),
                                 miss_at(levels, level), verdicts);
                   });
  for (const auto &[of_case, its_strains] : budgeted_cases(strain_rows))
  {
    if (!Load(of_case.load).is_periodic()) // whose motion no law decides
      judge_slope({"macro-law", "macro law"}, budget_rows, of_case, strains, verdicts);
    judge_slope({"modes", "modes"}, budget_rows, of_case, strains, verdicts);
  }
  return verdicts;
}

std::vector<Verdict> error_agreement_verdicts(const std::vector<StrainRow> &strain_rows,
                                              const std::vector<BudgetRow> &budget_rows)
{
  std::vector<Verdict> verdicts;
  at_judged_levels(
    strain_rows,
    [&](const BudgetRow &level)
    {
      for (const StrainRow &row : strain_rows)
        for (const BudgetRow &budget : budget_rows)
          if (is_of_level(row, level) && row.method == "localized" && is_of_level(budget, level) &&
              budget.part == "total" && budget.region == "all")
            verdicts.push_back(at_most("budget-of-strain-csv", words_of(level),
                                       std::abs(row.per_cell - budget.per_cell) / level.strain,
                                       solved_to));
    });
  return verdicts;
}

std::vector<Verdict> second_code_verdicts(const std::vector<CrossCheckRow> &rows,
                                          const std::vector<LevelRow> &levels)
{
  std::vector<Verdict> verdicts;
  for (const CrossCheckRow &row : rows)
  {
    const bool is_sheet = row.what == "sheet";
    if (!is_sheet && row.what != "p2-cell")
      continue;
    const Miss miss = is_sheet ? miss_at(levels, {row.cell, row.load, row.strain, row.reference})
                               : Miss{Outcome::fail, ""};
    const Outcome answer  = !std::isfinite(row.distance) ? Outcome::inconclusive
                            : row.distance <= agreement  ? Outcome::pass
                                                         : miss.outcome;
    const std::string why = (row.fault.empty() ? "" : "; " + row.fault) + miss.note;
    verdicts.push_back(
      is_sheet
        ? judged(
            "second-code",
            {{"cell", row.cell}, {"load", row.load}, {"percent", 100. * row.strain}, {"note", why}},
            answer, row.distance)
        : judged("second-solver", {{"cell", row.cell}, {"note", why}}, answer, row.distance));
  }
  return verdicts;
}

std::vector<std::string> budget_notes(const std::vector<StrainRow> &strain_rows,
                                      const std::vector<BudgetRow> &budget_rows)
{
  std::vector<std::string> notes;
  at_judged_levels(strain_rows,
                   [&](const BudgetRow &level)
                   {
                     if (has_left_linear_theory(budget_rows, level))
                       notes.push_back(title_of(level) + note_of_sum(budget_rows, level));
                   });
  at_judged_levels(
    strain_rows,
    [&](const BudgetRow &level)
    {
      const double total = mean_of(budget_rows, level, "total");
      if (is_zero(total, level.strain) || !std::isfinite(total))
        return;
      std::string larger_parts;
      for (const std::string &part : budget_parts())
        if (const double mean = mean_of(budget_rows, level, part); is_in_sum(part) && mean > total)
          larger_parts += (larger_parts.empty() ? "" : ", ") + part + " (" +
                          short_text(std::round(100. * mean / total)) + " %)";
      if (!larger_parts.empty())
        notes.push_back(title_of(level) +
                        "parts larger than the error, which cancel in part: " + larger_parts);
      const double change = mean_of(budget_rows, level, "resolution") / total;
      if (Load(level.load).is_periodic()) // whose affine motion is exact on any mesh
        return;
      char text[160];
      std::snprintf(text, sizeof(text),
                    "the homogenized sheet that counts as resolved changes by %.2g %% of the error "
                    "from a mesh half as fine",
                    100. * change);
      notes.push_back(title_of(level) + text);
    });
  return notes;
}
} // namespace homespun::verification
