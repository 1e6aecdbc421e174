// SPDX-License-Identifier: MIT
#include "verification/scaling/scaling_study.h"

#include "homogenization/cell/unit_cell.h"
#include "meshes/files/child_process.h"
#include "meshes/files/temporary_folder.h"
#include "meshes/plain/errors.h"
#include "verification/cell/study_of_cells.h"
#include "verification/record/progress.h"
#include "verification/scaling/scaling_summary.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
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

class ScalingStudy final : public StudyOfCells
{
public:
  explicit ScalingStudy(const ScalingOptions &options)
      : StudyOfCells("scaling", options, MPI_COMM_NULL)
      , options(options)
      , cell(cells().front())
  {
  }

  const std::vector<ScalingRun> &runs() const
  {
    return table->rows();
  }

private:
  nlohmann::ordered_json inputs() override
  {
    return {{"refinements", options.refinements}, {"ranks", options.ranks},
            {"repeats", options.repeats},         {"order", options.order},
            {"launcher", options.launcher},       {"cores", number_of_cores(options)}};
  }

  void open_tables() override
  {
    table = std::make_unique<Table<ScalingRun>>(options.output);
  }

  void work() override
  {
    Progress progress(!options.quiet,
                      static_cast<int>(options.refinements.size() * options.ranks.size()) *
                        options.repeats);
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
          if (!table->contains(run))
          {
            run        = measure(options, refine, ranks);
            run.refine = refine;
            run.ranks  = ranks;
            run.repeat = repeat;
            table->append(run);
          }
          progress.done();
        }
  }

  StudyDescription conclude() override
  {
    verdicts                    = verdicts_of(runs());
    nlohmann::ordered_json told = {
      {"cell", cell.name},       {"triangles_of_given_mesh", cell.mesh.n_triangles()},
      {"order", options.order},  {"launcher", options.launcher},
      {"memory_model", nullptr}, {"time_model", nullptr}};
    const int cores = number_of_cores(options);
    if (const auto memory = memory_model_of(runs()))
      told["memory_model"] = {{"bytes_per_rank", memory->fixed},
                              {"bytes_per_dof", memory->shared},
                              {"misfit", memory->misfit}};
    if (const auto time = time_model_of(runs(), cores))
      told["time_model"] = {{"cores", cores},
                            {"serial_seconds_per_dof", time->fixed},
                            {"seconds_per_dof", time->shared},
                            {"misfit", time->misfit}};
    return {told, nlohmann::ordered_json::array(), notes_of(runs()), "scaling.json"};
  }

  const ScalingOptions options;
  const homogenization::UnitCell &cell;
  std::unique_ptr<Table<ScalingRun>> table;
};
} // namespace

ScalingResult run_scaling_study(const ScalingOptions &options)
{
  ScalingStudy study(options);
  const std::vector<Verdict> verdicts = study.run();
  return {study.runs(), verdicts};
}
} // namespace homespun::verification
