// SPDX-License-Identifier: MIT
#include "verification/scaling/scaling_study.h"

#include "homogenization/cell/unit_cell.h"
#include "meshes/files/child_process.h"
#include "meshes/files/temporary_folder.h"
#include "meshes/plain/errors.h"
#include "verification/cell/study_of_cells.h"
#include "verification/record/number_text.h"
#include "verification/record/progress.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <thread>

namespace homespun::verification
{
namespace
{
/// What `homespun homogenize` wrote of itself.
ScalingRun run_from(const std::string &file)
{
  std::ifstream input(file);
  const nlohmann::json json = nlohmann::json::parse(input);
  ScalingRun run;
  run.dofs = json.at("dofs");
  for (const double iterations : json.at("iterations"))
    run.iterations += iterations / 3.;
  const nlohmann::json &seconds = json.at("seconds");
  run.setup                     = seconds.at("setup");
  run.assembly                  = seconds.at("assembly");
  run.preconditioner            = seconds.at("preconditioner");
  run.solve                     = seconds.at("solve");
  for (const double bytes : json.at("peak_memory_of_rank"))
  {
    run.largest_rank = std::max(run.largest_rank, bytes);
    run.all_ranks += bytes;
  }
  const nlohmann::json &C = json.at("C");
  run.C11 = C.at(0).at(0), run.C12 = C.at(0).at(1), run.C13 = C.at(0).at(2);
  run.C22 = C.at(1).at(1), run.C23 = C.at(1).at(2), run.C33 = C.at(2).at(2);
  return run;
}

ScalingRun measure(const ScalingOptions &options, const int refine, const int ranks)
{
  const meshes::TemporaryFolder passing(options.output);
  const std::string folder = passing.path + "/run", log = passing.path + "/run.log";
  std::vector<std::string> words;
  std::istringstream launcher(options.launcher);
  for (std::string word; launcher >> word;)
  {
    const std::size_t place = word.find("{ranks}");
    words.push_back(place == std::string::npos ? word
                                               : word.replace(place, 7, std::to_string(ranks)));
  }
  for (const std::string &word :
       {std::filesystem::read_symlink("/proc/self/exe").string(), std::string("homogenize"),
        options.cell_files.front(), std::string("--order"), std::to_string(options.order),
        std::string("--refine"), std::to_string(refine), std::string("--no-bars"),
        std::string("--solver"), std::string("multigrid"), std::string("--quiet"),
        std::string("--output"), folder})
    words.push_back(word);
  const int status = meshes::run_child(words, log);
  if (status != 0 || !std::filesystem::exists(folder + "/homogenize.json"))
  {
    std::ifstream input(log);
    std::ostringstream said;
    said << input.rdbuf();
    const std::string what = "refine " + std::to_string(refine) + " on " + std::to_string(ranks) +
                             " ranks ended with status " + std::to_string(status) + ": " +
                             said.str().substr(0, 2000);
    if (const std::string killed = meshes::text_of_signal(status); !killed.empty())
      throw meshes::BadInput(what + killed);
    if (status == 3)
      throw meshes::NotConverged(what, {});
    throw meshes::BadInput(what + "; expected a launcher that runs: mend --launcher, which is `" +
                           options.launcher + "`");
  }
  return run_from(folder + "/homogenize.json");
}

/// Cores that ranks can have to themselves.
int number_of_cores(const ScalingOptions &options)
{
  return options.cores > 0 ? options.cores : static_cast<int>(std::thread::hardware_concurrency());
}

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

ScalingResult run_scaling_study(const ScalingOptions &options)
{
  StudyOfCells study(options, MPI_COMM_NULL);
  const homogenization::UnitCell &cell = study.cells().front();
  const bool is_taken_up = study.open("scaling", {{"refinements", options.refinements},
                                                  {"ranks", options.ranks},
                                                  {"repeats", options.repeats},
                                                  {"order", options.order},
                                                  {"launcher", options.launcher},
                                                  {"cores", number_of_cores(options)}});
  Table<ScalingRun> table(options.output);
  const int n_runs =
    static_cast<int>(options.refinements.size() * options.ranks.size()) * options.repeats;
  {
    Progress progress(!options.quiet, n_runs);
    for (int repeat = 0; repeat < options.repeats; ++repeat)
      for (const int refine : options.refinements)
        for (const int ranks : options.ranks)
        {
          progress.begin(cell.name + ", refined " + std::to_string(refine) + " times, on " +
                         std::to_string(ranks) + (ranks == 1 ? " rank" : " ranks"));
          ScalingRun run;
          run.refine = refine;
          run.ranks  = ranks;
          run.repeat = repeat;
          if (!table.contains(run))
          {
            run        = measure(options, refine, ranks);
            run.refine = refine;
            run.ranks  = ranks;
            run.repeat = repeat;
            table.append(run);
          }
          progress.done();
        }
  }
  const std::vector<ScalingRun> &runs = table.rows();
  const std::vector<Verdict> verdicts = verdicts_of(runs);
  nlohmann::ordered_json told         = {
            {"cell", cell.name},       {"triangles_of_given_mesh", cell.mesh.n_triangles()},
            {"order", options.order},  {"launcher", options.launcher},
            {"memory_model", nullptr}, {"time_model", nullptr}};
  const int cores = number_of_cores(options);
  if (const auto memory = memory_model_of(runs))
    told["memory_model"] = {{"bytes_per_rank", memory->fixed},
                            {"bytes_per_dof", memory->shared},
                            {"misfit", memory->misfit}};
  if (const auto time = time_model_of(runs, cores))
    told["time_model"] = {{"cores", cores},
                          {"serial_seconds_per_dof", time->fixed},
                          {"seconds_per_dof", time->shared},
                          {"misfit", time->misfit}};
  study.conclude(
    {told, nlohmann::ordered_json::array(), notes_of(runs), is_taken_up, "scaling.json"}, verdicts);
  return {runs, verdicts};
}
} // namespace homespun::verification
