// SPDX-License-Identifier: MIT
#include "verification/bloch/stability_verdicts.h"

#include "verification/record/number_text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace homespun::verification
{
namespace
{
/// The levels of a mesh on one path.
struct PathLevels
{
  std::vector<StabilityRow> given, refined;
};

std::string name_of_path(const std::string &cell, const std::string &law, const std::string &load,
                         const std::string &way)
{
  return cell + ", " + law + ", " + load + ", " + way + ": ";
}

Verdict verdict_on_sides(const std::string &what, const std::vector<StabilityRow> &rows)
{
  double widest = 0.;
  for (const StabilityRow &row : rows)
    if (row.state != "not-reached")
      widest = larger(widest, (row.beta - row.lower) / (1. + std::abs(row.beta)));
  const double limit = 3. * MarginSearch::closeness;
  return {what +
            "no wave that was asked is below beta (largest distance of its two sides, relative "
            "to 1 + |beta|)",
          widest <= limit ? Outcome::pass : Outcome::fail,
          widest,
          "<= " + short_text(limit),
          "the closeness at which Cholesky factors are asked, once from the zone and once around "
          "its lowest wave, with what halving leaves between",
          Kind::program};
}

Verdict verdict_on_long_waves(const std::string &what, const std::vector<StabilityRow> &rows)
{
  int n_wrong = 0, n_asked = 0;
  for (const StabilityRow &row : rows)
    if (std::isfinite(row.acoustic))
    {
      ++n_asked;
      n_wrong += (row.acoustic > 0.) != row.long_waves_stable;
    }
  return {what + "long waves are stable where the acoustic tensor of the homogenized tangent is "
                 "positive definite, and not else (levels where the two disagree)",
          n_asked == 0   ? Outcome::inconclusive
          : n_wrong == 0 ? Outcome::pass
                         : Outcome::fail,
          static_cast<double>(n_wrong),
          "0",
          "one theorem, two programs: waves after elimination, and the tangent of Newton's "
          "matrices; levels at which the cell itself is no minimum are not asked",
          Kind::program};
}

Verdict verdict_on_reaching(const std::string &what, const std::vector<StabilityRow> &rows)
{
  const auto n_missing = std::count_if(
    rows.begin(), rows.end(), [](const StabilityRow &row) { return row.state == "not-reached"; });
  return {what + "every strain has a periodic state on both meshes (paths that ended before)",
          n_missing == 0 ? Outcome::pass : Outcome::inconclusive,
          static_cast<double>(n_missing),
          "0",
          "a path that ends is open, because the cloth itself may have no state there",
          Kind::method};
}

Verdict verdict_on_meshes(const std::string &what, const PathLevels &levels)
{
  int n_differ = 0;
  for (const StabilityRow &row : levels.given)
    for (const StabilityRow &finer : levels.refined)
      n_differ += row.strain == finer.strain && row.state != finer.state;
  return {what + "the given mesh and the refined one agree on what is stable (levels where they do "
                 "not)",
          n_differ == 0 ? Outcome::pass : Outcome::inconclusive,
          static_cast<double>(n_differ),
          "0",
          "stable holds up to the mesh: where the refined one takes it back the level is open",
          Kind::method};
}
} // namespace

Verdict verdict_on_rest(const std::string &what, const BlochMargin &bloch,
                        const CellAssembly &assembly)
{
  const CellEquilibrium rest{Eigen::Matrix2d::Identity(),
                             meshes::Points::Zero(assembly.cell.mesh.n_vertices(), 2)};
  const Margin margin = bloch.of(rest);
  const double miss   = std::max(std::abs(margin.beta - 1.), std::abs(margin.lower - 1.));
  const double limit  = 6. * MarginSearch::closeness;
  return {what + ": beta at rest is 1 (distance of its two sides from it)",
          miss <= limit ? Outcome::pass : Outcome::fail,
          miss,
          "<= " + short_text(limit),
          "K is K0 there; 3 times the closeness of the two sides, which is relative to 1 + beta",
          Kind::program};
}

std::vector<Verdict> verdicts_on_rows(const std::vector<StabilityRow> &levels,
                                      const std::vector<LossRow> &losses)
{
  std::map<std::string, PathLevels> paths;
  std::vector<std::string> names; // in the order of the rows
  for (const StabilityRow &row : levels)
  {
    const std::string name =
      name_of_path(row.cell, row.law, row.load, row.strain < 0. ? "pressed" : "pulled");
    if (paths.count(name) == 0)
      names.push_back(name);
    (row.mesh == "given" ? paths[name].given : paths[name].refined).push_back(row);
  }
  std::vector<Verdict> verdicts;
  for (const std::string &name : names)
  {
    const PathLevels &path        = paths[name];
    std::vector<StabilityRow> all = path.given;
    all.insert(all.end(), path.refined.begin(), path.refined.end());
    verdicts.push_back(verdict_on_sides(name, all));
    verdicts.push_back(verdict_on_long_waves(name, all));
    verdicts.push_back(verdict_on_reaching(name, all));
    if (!path.refined.empty())
      verdicts.push_back(verdict_on_meshes(name, path));
  }
  // Without a row of its loss a path would be judged by what a run that was killed left of it.
  std::set<std::string> ended;
  for (const LossRow &row : losses)
    ended.insert(name_of_path(row.cell, row.law, row.load, row.way));
  for (const std::string &name : names)
    if (ended.count(name) == 0)
      verdicts.push_back({name + "the path has a row in loss.csv (paths without)", Outcome::fail,
                          1., "0", "every path leaves one when it ends", Kind::program});
  return verdicts;
}

std::vector<std::string> notes_on_losses(const std::vector<LossRow> &losses)
{
  std::vector<std::string> notes;
  std::map<std::string, const LossRow *> refined;
  for (const LossRow &row : losses)
    if (row.mesh == "refined")
      refined[name_of_path(row.cell, row.law, row.load, row.way)] = &row;
  for (const LossRow &row : losses)
  {
    if (row.mesh != "given")
      continue;
    const std::string name = name_of_path(row.cell, row.law, row.load, row.way);
    const LossRow *finer   = refined.count(name) != 0 ? refined[name] : nullptr;
    if (row.outcome != "lost")
    {
      const std::string to =
        std::isfinite(row.held_to) ? short_text(100. * row.held_to) + " %" : "no strain at all";
      notes.push_back(name + "stable up to " + to +
                      (row.outcome == "held" ? ", the last strain" : ", where the path ended") +
                      ", on the given mesh" +
                      (finer && finer->outcome == "lost" ? "; the refined one loses it at " +
                                                             short_text(100. * finer->strain) + " %"
                                                         : "") +
                      ".");
      continue;
    }
    const std::string size =
      std::isfinite(row.strain_bar)
        ? with_bar(100. * (finer ? finer->strain : row.strain), 100. * row.strain_bar) + " %"
        : short_text(std::round(1e4 * row.strain) / 100.) + " % on the given mesh";
    notes.push_back(name + "lost first at " + size + ", " + row.scale + ": " + row.wave +
                    (row.scale == "micro"
                       ? ", a pattern that repeats over " + std::to_string(row.cells_1) + " x " +
                           std::to_string(row.cells_2) + " cells."
                       : ", the macroscopic law localizes."));
  }
  return notes;
}

namespace
{
/// The rows of each path, by its name; names in the order of the rows.
std::vector<std::pair<std::string, std::vector<PatternRow>>>
by_path(const std::vector<PatternRow> &patterns)
{
  std::vector<std::pair<std::string, std::vector<PatternRow>>> paths;
  for (const PatternRow &row : patterns)
  {
    const std::string name =
      name_of_path(row.cell, row.law, row.load, row.strain < 0. ? "pressed" : "pulled");
    if (paths.empty() || paths.back().first != name)
      paths.push_back({name, {}});
    paths.back().second.push_back(row);
  }
  return paths;
}
} // namespace

std::vector<Verdict> verdicts_on_patterns(const std::vector<PatternRow> &patterns)
{
  std::vector<Verdict> verdicts;
  for (const auto &[name, rows] : by_path(patterns))
  {
    const auto n_missing = std::count_if(
      rows.begin(), rows.end(), [](const PatternRow &row) { return row.outcome == "not-found"; });
    verdicts.push_back(
      {name + "where a wave over several cells is below zero, a state with that pattern has less "
              "energy (levels without)",
       n_missing == 0 ? Outcome::pass : Outcome::inconclusive, static_cast<double>(n_missing), "0",
       "the second variation is negative along the wave, and every step from there lowers the "
       "energy; open where Newton's method does not come to an end",
       Kind::program});
  }
  return verdicts;
}

std::vector<std::string> notes_on_patterns(const std::vector<PatternRow> &patterns)
{
  std::vector<std::string> notes;
  for (const auto &[name, rows] : by_path(patterns))
  {
    const PatternRow *best = nullptr;
    for (const PatternRow &row : rows)
      if (row.outcome == "found" && (!best || row.lower > best->lower))
        best = &row;
    if (best)
      notes.push_back(name + "at " + short_text(100. * best->strain) + " % the pattern over " +
                      std::to_string(best->cells_1) + " x " + std::to_string(best->cells_2) +
                      " cells was followed: " + short_text(std::round(1e4 * best->lower) / 100.) +
                      " % less energy than the periodic state, on the given mesh.");
  }
  return notes;
}
} // namespace homespun::verification
