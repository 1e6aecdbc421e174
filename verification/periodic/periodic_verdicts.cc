// SPDX-License-Identifier: MIT
#include "verification/periodic/periodic_verdicts.h"

#include "verification/record/number_text.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace homespun::verification
{
namespace
{
/// The claim that there is none of what is counted.
Verdict none_of(const std::string &claim, const long n, const Outcome otherwise,
                const std::string &derivation, const Kind kind)
{
  return {claim, n == 0 ? Outcome::pass : otherwise, static_cast<double>(n), "0", derivation, kind};
}

/// The rows of a path.
struct PathRows
{
  std::string name;
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
      path = paths.insert(path, {name, {}, {}, {}, {}});
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
  for (const StabilityRow &row : path.levels)
    if (row.outcome != "not-reached")
      widest = larger(widest, (row.beta - row.lower) / (1. + std::abs(row.beta)));
  return at_most(path.name +
                   "no wave that was asked is below beta (largest distance of its two sides, "
                   "relative to 1 + |beta|)",
                 widest, 3. * MarginSearch::closeness,
                 "the closeness at which Cholesky factors are asked, once from the zone and once "
                 "around its lowest wave, with what halving leaves between");
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
  Verdict verdict = none_of(
    path.name + "long waves are stable where the acoustic tensor of the homogenized tangent is "
                "positive definite, and not else (levels where the two disagree)",
    n_wrong, Outcome::fail,
    "one theorem, two programs: waves after elimination, and the tangent of Newton's "
    "matrices; levels at which the cell itself is no minimum are not asked",
    Kind::program);
  if (n_asked == 0)
    verdict.outcome = Outcome::inconclusive;
  return verdict;
}

Verdict verdict_on_reaching(const PathRows &path)
{
  return none_of(
    path.name + "every strain has a periodic state on both meshes (paths that ended before)",
    std::count_if(path.levels.begin(), path.levels.end(),
                  [](const StabilityRow &row) { return row.outcome == "not-reached"; }),
    Outcome::inconclusive,
    "a path that ends is open, because the cloth itself may have no state there", Kind::method);
}

Verdict verdict_on_meshes(const PathRows &path)
{
  int n_differ = 0;
  for (const StabilityRow &row : path.levels)
    for (const StabilityRow &finer : path.levels)
      n_differ += row.mesh == "given" && finer.mesh == "refined" && row.strain == finer.strain &&
                  row.outcome != finer.outcome;
  return none_of(path.name +
                   "the given mesh and the refined one agree on what is stable (levels where they "
                   "do not)",
                 n_differ, Outcome::inconclusive,
                 "stable holds up to the mesh: where the refined one takes it back the level is "
                 "open",
                 Kind::method);
}

Verdict verdict_on_patterns(const PathRows &path)
{
  return none_of(path.name + "where a wave over several cells is below zero, a state with that "
                             "pattern has less energy (levels without)",
                 std::count_if(path.patterns.begin(), path.patterns.end(),
                               [](const StabilityRow &row) { return row.outcome == "not-found"; }),
                 Outcome::inconclusive,
                 "the second variation is negative along the wave, and every step from there "
                 "lowers the energy; open where Newton's method does not come to an end",
                 Kind::program);
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
  return at_most(cell + ": the slope of the path at rest is C^H of the cell problems on the same "
                        "mesh (largest relative difference of an energy)",
                 difference, limit,
                 "two programs for one discrete problem: what round-off and the solver leave of "
                 "both, by contrast and mesh");
}

std::vector<Verdict> verdicts_on_path(const std::string &what, const CellAssembly &assembly,
                                      const LoadControl &control, const LoadPath &path,
                                      const int n_steps)
{
  const auto n_reached = static_cast<long>(path.levels.size());
  std::vector<Verdict> verdicts;
  verdicts.push_back(
    none_of(what + "every level has an equilibrium (levels that were not reached)",
            n_steps - n_reached, n_reached == 0 ? Outcome::fail : Outcome::inconclusive,
            "every step is asked for; one without equilibrium is open, because the cloth itself "
            "may have none there, and a path without a single level says nothing",
            Kind::method));
  if (!path.why.empty())
    verdicts.back().limit += "; found: " + path.why;
  if (!path.levels.empty())
  {
    const WorkCheck check = check_work(assembly, control, path);
    verdicts.push_back(
      at_most(what + "the stress is the derivative of the energy at the last level (distance of "
                     "the work from a central difference along the strains, N/m)",
              check.difference, check.bar,
              "central differences of steps h and 2h differ by three times the error of the "
              "first; and the rounding of the energy and of its gradients over h; open where that "
              "is more than a thousandth of the work"));
    // Where the energy jumps from one equilibrium to another, its differences say nothing.
    if (!(check.bar <= 1e-3 * std::abs(check.work)))
      verdicts.back().outcome = Outcome::inconclusive;
  }
  verdicts.push_back(
    none_of(what + "every level is a minimum of the energy, against fluctuations of one cell and "
                   "the free strains (levels that are not)",
            std::count_if(path.levels.begin(), path.levels.end(),
                          [](const LoadLevel &level) { return !level.is_stable; }),
            Outcome::inconclusive, "a cloth leaves a state that is no minimum; where to is open",
            Kind::method));
  return verdicts;
}

Verdict verdict_on_rest(const std::string &what, const BlochMargin &bloch)
{
  const Margin margin = bloch.of(at_rest(bloch.assembly));
  return at_most(what + ": beta at rest is 1 (distance of its two sides from it)",
                 std::max(std::abs(margin.beta - 1.), std::abs(margin.lower - 1.)),
                 6. * MarginSearch::closeness,
                 "K is K0 there; 3 times the closeness of the two sides, which is relative to 1 + "
                 "beta");
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
      verdicts.push_back(
        none_of(path.name + "the path has a row of its loss in stability.csv (paths "
                            "without)",
                1, Outcome::fail, "every path leaves one when it ends", Kind::program));
    if (!path.patterns.empty())
      verdicts.push_back(verdict_on_patterns(path));
  }
  return verdicts;
}

std::vector<std::string> notes_on_margins(const std::vector<StabilityRow> &rows)
{
  std::vector<std::string> notes;
  for (const PathRows &path : paths_of(rows))
  {
    if (path.given)
      notes.push_back(path.name + note_on_loss(*path.given, path.refined));
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
        "cell leave, and knows nothing of the law.",
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
