// SPDX-License-Identifier: MIT
#include "verification/scaling/scaling_summary.h"

#include "verification/record/number_text.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>

namespace homespun::verification
{
namespace
{
using Repeats = std::map<std::pair<int, int>, std::vector<ScalingRun>>; ///< by refine and ranks

Repeats repeats_of(const std::vector<ScalingRun> &runs)
{
  Repeats repeats;
  for (const ScalingRun &run : runs)
    repeats[{run.refine, run.ranks}].push_back(run);
  return repeats;
}

/// Of the run whose time is the median.
ScalingRun median(std::vector<ScalingRun> runs)
{
  std::sort(runs.begin(), runs.end(),
            [](const ScalingRun &one, const ScalingRun &two)
            { return one.seconds() < two.seconds(); });
  return runs[runs.size() / 2];
}

/// Nonnegative x, y with x a + y b = 1 in the least squares of all rows, and the largest misfit;
/// nothing where the rows do not determine both, or leave no misfit to see.
std::optional<TwoTerms> fit(const std::vector<Eigen::RowVector2d> &rows)
{
  Eigen::MatrixX2d matrix(static_cast<long>(rows.size()), 2);
  for (std::size_t k = 0; k < rows.size(); ++k)
    matrix.row(static_cast<long>(k)) = rows[k];
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(matrix.rows());
  const auto factors         = matrix.colPivHouseholderQr();
  if (rows.size() < 3 || factors.rank() < 2)
    return {};
  Eigen::Vector2d solution = factors.solve(ones);
  for (const int k : {0, 1})
    if (!(solution(k) >= 0.))
    {
      solution(k)     = 0.;
      solution(1 - k) = matrix.col(1 - k).sum() / matrix.col(1 - k).squaredNorm();
    }
  return TwoTerms{solution(0), solution(1), (matrix * solution - ones).cwiseAbs().maxCoeff()};
}
} // namespace

std::optional<TwoTerms> memory_model_of(const std::vector<ScalingRun> &runs)
{
  std::vector<Eigen::RowVector2d> rows;
  for (const auto &[key, its] : repeats_of(runs))
  {
    const ScalingRun run = median(its);
    rows.emplace_back(1. / run.largest_rank, run.dofs / run.ranks / run.largest_rank);
  }
  return fit(rows);
}

std::optional<TwoTerms> time_model_of(const std::vector<ScalingRun> &runs, const int cores)
{
  std::vector<Eigen::RowVector2d> rows;
  for (const auto &[key, its] : repeats_of(runs))
  {
    const ScalingRun run = median(its);
    if (run.ranks <= cores)
      rows.emplace_back(run.dofs / run.seconds(), run.dofs / run.ranks / run.seconds());
  }
  return fit(rows);
}

std::vector<Verdict> verdicts_of(const std::vector<ScalingRun> &runs)
{
  std::vector<Verdict> verdicts;
  const auto judge = [&](const std::string &claim, const double value, const double limit,
                         const std::string &derivation)
  {
    verdicts.push_back({claim, value <= limit ? Outcome::pass : Outcome::fail, value,
                        "<= " + short_text(limit), derivation});
  };
  const Repeats repeats = repeats_of(runs);
  std::map<int, const ScalingRun *> first_of_mesh;
  bool several_ranks = false;
  double difference  = 0.;
  for (const ScalingRun &run : runs)
  {
    const ScalingRun &first               = *first_of_mesh.emplace(run.refine, &run).first->second;
    several_ranks                         = several_ranks || run.ranks != first.ranks;
    const std::array<double, 6> reference = first.stiffness(), found = run.stiffness();
    double size = 0.;
    for (const double value : reference)
      size = larger(size, std::abs(value));
    for (std::size_t k = 0; k < reference.size(); ++k)
      difference = larger(difference, std::abs(found[k] - reference[k]) / size);
  }
  // One run compared with itself says nothing.
  if (several_ranks)
    judge("C^H of a mesh is the same on all numbers of ranks (largest difference in parts of the "
          "largest entry)",
          difference, 1e-10,
          "the solver leaves 1e-9 of the displacements, which enter an energy squared; sums in "
          "another order differ by about 2e-16 times the root of the number of triangles: 1e-12 "
          "at 1e7; requirement: no more than a hundred times that");
  // On the finest mesh, from each number of ranks to the next.
  auto entry  = repeats.lower_bound({repeats.rbegin()->first.first, 0});
  double rise = 0., before = median(entry->second).largest_rank;
  const bool has_next = std::next(entry) != repeats.end();
  while (++entry != repeats.end())
  {
    const double bytes = median(entry->second).largest_rank;
    rise               = larger(rise, bytes / before);
    before             = bytes;
  }
  if (has_next)
    judge("On the finest mesh the largest rank needs less memory on more ranks (ratio from one "
          "number to the next)",
          rise, 1., "what less means");
  return verdicts;
}

std::vector<std::string> notes_of(const std::vector<ScalingRun> &runs)
{
  double least = std::numeric_limits<double>::infinity(), most = 0.;
  for (const ScalingRun &run : runs)
  {
    least = std::min(least, run.iterations);
    most  = std::max(most, run.iterations);
  }
  // A homogeneous cell needs none.
  if (repeats_of(runs).size() < 2 || most == 0.)
    return {};
  return {
    "Iterations lie between " + short_text(least) + " and " + short_text(most) +
    " on all meshes and ranks (mean of the three loads). Multigrid keeps them bounded when the "
    "mesh is refined; theory gives the bound no number, and it is not judged."};
}

std::string table_of(const std::vector<ScalingRun> &runs)
{
  std::ostringstream text;
  char line[200];
  std::snprintf(line, sizeof(line), "%10s %6s %5s %9s %19s %9s %8s %12s %10s\n", "DoFs", "ranks",
                "iter", "seconds", "(least to most)", "us/DoF", "speed-up", "MiB of a rank",
                "bytes/DoF");
  text << line;
  const Repeats repeats = repeats_of(runs);
  for (const auto &[key, its] : repeats)
  {
    const ScalingRun run = median(its);
    double least = run.seconds(), most = run.seconds();
    for (const ScalingRun &one : its)
    {
      least = std::min(least, one.seconds());
      most  = std::max(most, one.seconds());
    }
    // Against the fewest ranks of the same mesh.
    const ScalingRun first = median(repeats.lower_bound({key.first, 0})->second);
    std::snprintf(line, sizeof(line),
                  "%10.0f %6d %5.1f %9.3g (%7.3g to %7.3g) %9.3g %8.2f %12.0f %10.0f\n", run.dofs,
                  run.ranks, run.iterations, run.seconds(), least, most,
                  1e6 * run.seconds() / run.dofs, first.seconds() / run.seconds(),
                  run.largest_rank / 1048576., run.all_ranks / run.dofs);
    text << line;
  }
  return text.str();
}
} // namespace homespun::verification
