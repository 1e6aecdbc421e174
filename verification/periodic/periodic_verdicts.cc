// SPDX-License-Identifier: MIT
#include "verification/periodic/periodic_verdicts.h"

#include "verification/record/claim.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace homespun::verification
{
namespace
{
/// The claim that there is none of what is counted.
Verdict none_of(const char *claim, const Words &words, const long n, const Outcome otherwise)
{
  return judged(claim, words, n == 0 ? Outcome::pass : otherwise, static_cast<double>(n));
}

/// The rows of a path.
struct PathRows
{
  std::string name;
  Words words;
  std::vector<StabilityRow> levels, patterns;
  std::optional<StabilityRow> given, refined; ///< first losses
};

/// In the order of the rows.
std::vector<PathRows> paths_of(const std::vector<StabilityRow> &rows)
{
  std::vector<PathRows> paths;
  for (const StabilityRow &row : rows)
  {
    const std::string name = row.cell + ", " + row.law + ", " + row.load + ", " + row.way + ": ";
    auto path              = std::find_if(paths.begin(), paths.end(),
                                          [&](const PathRows &one) { return one.name == name; });
    if (path == paths.end())
      path = paths.insert(
        path, {name,
               {{"cell", row.cell}, {"law", row.law}, {"load", row.load}, {"way", row.way}},
               {},
               {},
               {},
               {}});
    if (row.kind == "level")
      path->levels.push_back(row);
    else if (row.kind == "pattern")
      path->patterns.push_back(row);
    else if (row.kind == "loss")
      (row.mesh == "given" ? path->given : path->refined) = row;
  }
  return paths;
}

Verdict verdict_on_sides(const PathRows &path)
{
  double widest = 0.;
  int n_asked   = 0;
  for (const StabilityRow &row : path.levels)
    if (row.outcome != "not-reached")
    {
      ++n_asked;
      widest = larger(widest, (row.beta - row.lower) / (1. + std::abs(row.beta)));
    }
  return open_without(n_asked,
                      at_most("beta-sides", path.words, widest, 3. * MarginSearch::closeness));
}

Verdict verdict_on_long_waves(const PathRows &path)
{
  int n_wrong = 0, n_asked = 0;
  for (const StabilityRow &row : path.levels)
    if (std::isfinite(row.acoustic))
    {
      ++n_asked;
      n_wrong += (row.acoustic > 0.) != (row.long_waves == "stable");
    }
  return open_without(n_asked, none_of("long-waves", path.words, n_wrong, Outcome::fail));
}

Verdict verdict_on_reaching(const PathRows &path)
{
  return none_of("periodic-states", path.words,
                 std::count_if(path.levels.begin(), path.levels.end(),
                               [](const StabilityRow &row)
                               { return row.outcome == "not-reached" || row.path == "left"; }),
                 Outcome::inconclusive);
}

Verdict verdict_on_meshes(const PathRows &path)
{
  int n_differ = 0, n_asked = 0;
  for (const StabilityRow &row : path.levels)
    for (const StabilityRow &finer : path.levels)
      if (row.mesh == "given" && finer.mesh == "refined" && row.strain == finer.strain)
      {
        n_asked += row.outcome != "not-reached" && finer.outcome != "not-reached";
        n_differ += row.outcome != finer.outcome;
      }
  return open_without(
    n_asked, none_of("stable-on-both-meshes", path.words, n_differ, Outcome::inconclusive));
}

Verdict verdict_on_patterns(const PathRows &path)
{
  return none_of("pattern-has-less-energy", path.words,
                 std::count_if(path.patterns.begin(), path.patterns.end(),
                               [](const StabilityRow &row) { return row.outcome == "not-found"; }),
                 Outcome::inconclusive);
}

std::string note_on_loss(const StabilityRow &given, const std::optional<StabilityRow> &refined)
{
  if (given.outcome != "lost")
  {
    const std::string to =
      std::isfinite(given.held_to) ? short_text(100. * given.held_to) + " %" : "no strain at all";
    return "stable up to " + to +
           (given.outcome == "held" ? ", the last strain" : ", where the path ended") +
           ", on the given mesh" +
           (refined && refined->outcome == "lost"
              ? "; the refined one loses it at " + short_text(100. * refined->strain) + " %"
              : "") +
           ".";
  }
  const std::string size =
    std::isfinite(given.strain_bar)
      ? with_bar(100. * (refined ? refined->strain : given.strain), 100. * given.strain_bar) + " %"
      : short_text(std::round(1e4 * given.strain) / 100.) + " % on the given mesh";
  return "lost first at " + size + ", " + given.scale + ": " + given.wave +
         (given.scale == "micro"
            ? ", a pattern that repeats over " + std::to_string(given.cells_1) + " x " +
                std::to_string(given.cells_2) + " cells."
            : ", the macroscopic law localizes.");
}

std::string note_on_pattern(const StabilityRow &best)
{
  return "at " + short_text(100. * best.strain) + " % the pattern over " +
         std::to_string(best.cells_1) + " x " + std::to_string(best.cells_2) +
         " cells was followed: " + short_text(std::round(1e4 * best.less_energy) / 100.) +
         " % less energy than the periodic state, on the given mesh.";
}
} // namespace

Verdict verdict_on_slope(const std::string &cell, const double difference, const double limit)
{
  return at_most("slope-at-rest", {{"cell", cell}}, difference, limit);
}

std::vector<Verdict> verdicts_on_path(const Words &of_path, const CellAssembly &assembly,
                                      const LoadControl &control, const LoadPath &path,
                                      const int n_steps)
{
  const auto n_reached = static_cast<long>(path.levels.size());
  Words with_note      = of_path;
  with_note["note"]    = path.why.empty() ? "" : "; found: " + path.why;
  std::vector<Verdict> verdicts;
  verdicts.push_back(none_of("load-levels", with_note, n_steps - n_reached,
                             n_reached == 0 ? Outcome::fail : Outcome::inconclusive));
  if (!path.levels.empty())
  {
    const WorkCheck check = check_work(assembly, control, path);
    verdicts.push_back(at_most("load-work", of_path, check.difference, check.bar));
    // Where the energy jumps from one equilibrium to another, its differences say nothing.
    if (!(check.bar <= 1e-3 * std::abs(check.work)))
      verdicts.back().outcome = Outcome::inconclusive;
    verdicts.push_back(
      none_of("load-minimum", of_path,
              std::count_if(path.levels.begin(), path.levels.end(),
                            [](const LoadLevel &level) { return !level.is_stable; }),
              Outcome::inconclusive));
  }
  return verdicts;
}

Verdict verdict_on_rest(const std::string &cell, const std::string &law, const BlochMargin &bloch)
{
  const Margin margin = bloch.of(at_rest(bloch.assembly));
  return at_most("beta-at-rest", {{"cell", cell}, {"law", law}},
                 larger(std::abs(margin.beta - 1.), std::abs(margin.lower - 1.)),
                 6. * MarginSearch::closeness);
}

std::vector<Verdict> verdicts_on_margins(const std::vector<StabilityRow> &rows)
{
  std::vector<Verdict> verdicts;
  for (const PathRows &path : paths_of(rows))
  {
    verdicts.push_back(verdict_on_sides(path));
    verdicts.push_back(verdict_on_long_waves(path));
    verdicts.push_back(verdict_on_reaching(path));
    if (path.refined)
      verdicts.push_back(verdict_on_meshes(path));
    // Without a row of its loss a path would be judged by what a run that was killed left of it.
    if (!path.given && !path.refined)
      verdicts.push_back(none_of("row-of-loss", path.words, 1, Outcome::fail));
    if (!path.patterns.empty())
      verdicts.push_back(verdict_on_patterns(path));
  }
  return verdicts;
}

void add_owed_of_paths(const std::string &cell, const std::vector<std::string> &laws,
                       std::vector<OwedClaim> &owed)
{
  owed.push_back({"slope-at-rest", {{"cell", cell}}});
  for (const std::string &law : laws)
    for (const std::string method : {"resolved", "coarse"})
      if (const Words path = {{"cell", cell}, {"law", law}, {"method", method}};
          law != "linear" || method == "resolved")
      {
        owed.push_back({"load-levels", path});
        for (const char *id : {"load-work", "load-minimum"})
          owed.push_back({id, path, {"load-levels"}});
      }
}

void add_owed_of_margins(const Words &path, const int n_refinements, std::vector<OwedClaim> &owed)
{
  for (const char *id : {"beta-sides", "long-waves", "periodic-states"})
    owed.push_back({id, path});
  if (n_refinements > 0)
    owed.push_back({"stable-on-both-meshes", path, {"row-of-loss"}});
}

std::vector<std::string> notes_on_margins(const std::vector<StabilityRow> &rows)
{
  std::vector<std::string> notes;
  for (const PathRows &path : paths_of(rows))
  {
    if (path.given)
      notes.push_back(path.name + note_on_loss(*path.given, path.refined));
    const auto left = std::find_if(path.levels.begin(), path.levels.end(),
                                   [](const StabilityRow &row) { return row.path == "left"; });
    if (left != path.levels.end())
      notes.push_back(path.name + "at " + short_text(100. * left->strain) +
                      " % and beyond, on the " + left->mesh +
                      " mesh, the state is not that of the load any more: on the way Newton's "
                      "method jumped to another equilibrium, from which a step back does not lead "
                      "to the state before.");
    const StabilityRow *best = nullptr;
    for (const StabilityRow &row : path.patterns)
      if (row.outcome == "found" && (!best || row.less_energy > best->less_energy))
        best = &row;
    if (best)
      notes.push_back(path.name + note_on_pattern(*best));
  }
  for (const char *note :
       {"beta is the least eigenvalue of the tangent stiffness on waves of every length, relative "
        "to the stiffness at rest: 1 at rest, zero where a wave costs nothing.",
        "A jump of Newton's method to another equilibrium is looked for by a step back. Where the "
        "state is no minimum any more, rounding decides which equilibrium is found: a jump may be "
        "told a level late, or not at all.",
        "Of each state 49 waves are asked, one of k and -k, 12 of them long ones in the limit; "
        "and then those around the lowest, to 1/128 of the reciprocal vectors.",
        "`unstable-proved`: a field with a negative second variation was found: the state of the "
        "discrete cloth is no minimum. `stable-up-to-mesh`: every wave that was asked is positive "
        "definite by Cholesky factors; a finer mesh has more fields and a lower beta, and other "
        "waves lie between.",
        "A positive beta tells of a strict local minimum: a distant lower state is not excluded.",
        "beta_lower: no wave that was asked is below, by the inertia of K - beta K0, up to the "
        "rounding of its factors.",
        "The strain of first loss lies between held_to and lost_at on its mesh; strain_bar is "
        "1.25 |given - refined| / (1 - 2^-q), q the order of the energy that the corners of the "
        "cell leave, or how far held_to and lost_at are apart, whichever is more; it knows nothing "
        "of the law.",
        "The zone and the mode are those of the given mesh just beyond the first loss, or else "
        "at the last strain that was reached."})
    notes.emplace_back(note);
  return notes;
}

std::vector<std::string> notes_on_load(const LoadControl &control, const int n_steps)
{
  return {"Prescribed: " + control.text() + "; " + std::to_string(n_steps) + " steps.",
          "Strains are those of F = (1 + e11, " +
            std::string(control.axis == 1 ? "e12; 0" : "0; e12") +
            ", 1 + e22): the material axis " + std::to_string(control.axis) +
            " keeps its direction. Stresses are nominal, forces per rest width, and work on these "
            "strains.",
          "`resolved` is one cell with its phases and periodic fluctuations, P1 on the given mesh; "
          "`coarse` has C^H in place of the cell, as the coarse cloth has it. Under the law linear "
          "both are the same.",
          "Bars: 1.25 |mesh - once refined mesh| / (1 - 2^-q), q the order of the energy that the "
          "corners of the cell leave. They know nothing of the law.",
          "Stable means: against the fluctuation of one cell and the free strains; longer waves "
          "are not asked."};
}
} // namespace homespun::verification
