// SPDX-License-Identifier: MIT
// homespun drape: a scene and its page.
#include "meshes/errors.h"
#include "verification/commands.h"
#include "verification/drape_study.h"
#include "verification/lightweight_cloth.h"
#include "verification/scene.h"
#include "verification/scene_cloth.h"

#include <deal.II/base/mpi.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace homespun::verification
{
namespace
{
struct DrapeArguments
{
  DrapeOptions study;
  bool quick = false, no_report = false, no_frames = false;
};

void check_arguments(const DrapeOptions &study)
{
  std::vector<std::string> faults;
  const auto collect =
    [&](const char *option, const std::vector<std::string> &names, const auto &make)
  {
    for (const std::string &name : names)
      try
      {
        make(name);
      }
      catch (const meshes::BadInput &bad)
      {
        faults.push_back(std::string(option) + ": " + bad.what());
      }
  };
  collect("--variants", study.variants,
          [](const std::string &name) { static_cast<void>(membrane_model_of(name)); });
  collect("--methods", study.methods,
          [](const std::string &name) { static_cast<void>(Method(name)); });
  for (const std::string &name : study.references)
    if (name != "shell" && name != "biot" && name != "green")
      faults.push_back("--references: found `" + name + "`; expected shell, biot or green");
  for (const std::string &name : study.frames)
    if (name != "vtu" && name != "ply" && name != "obj")
      faults.push_back("--frames: found `" + name + "`; expected vtu, ply or obj");
  if (study.variants.empty() || study.variants.front() != "corotational")
    faults.push_back(
      "--variants: expected `corotational` first, against which the others are held");
  if (!(study.time_step >= 0.) || !(study.duration >= 0.))
    faults.push_back("--time-step, --duration: expected positive numbers in seconds");
  if (!faults.empty())
    throw meshes::BadInput(faults);
}

int run_drape(DrapeArguments arguments, Afterwards &afterwards)
{
  DrapeOptions &study = arguments.study;
  if (arguments.no_frames)
    study.frames.clear();
  check_arguments(study);
  if (study.output.empty())
    study.output = "out/" + std::filesystem::path(study.scene_file).stem().string();
  const std::vector<Verdict> verdicts = run_drape_study(study, MPI_COMM_WORLD);
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
  {
    if (!study.quiet)
      for (const Verdict &verdict : verdicts)
        std::printf("%-12s %s: %.4g (%s)\n", name_of(verdict.outcome).c_str(),
                    verdict.claim.c_str(), verdict.value, verdict.limit.c_str());
    if (!arguments.no_report)
      afterwards = [output = study.output, quiet = study.quiet]()
      { make_report({output}, output, quiet); };
  }
  return any_failed(verdicts) ? 1 : 0;
}
} // namespace

void add_drape_command(CLI::App &app, Action &action, Afterwards &afterwards,
                       const std::string &command_line)
{
  CLI::App *command = app.add_subcommand(
    "drape",
    "Run a scene: the coarse cloth in motion, up-sampled every step, against the resolved one");
  const auto arguments = std::make_shared<DrapeArguments>();
  DrapeOptions &study  = arguments->study;
  study.variants       = {"corotational"};
  study.methods        = {"affine", "localized", "localized-affine-lift"};
  study.command        = command_line;

  command
    ->add_option("SCENE.prm", study.scene_file, "Scene file; the shipped ones are in meshes/scenes")
    ->required();
  command
    ->add_option("--unit-cells", study.cell_files,
                 "Cell files in place of the scene's, comma-separated")
    ->delimiter(',')
    ->allow_extra_args(false);
  command
    ->add_option("--references", study.references,
                 "Full-resolution cloths to run beside it, comma-separated: shell, biot, green")
    ->delimiter(',')
    ->allow_extra_args(false);
  command
    ->add_option(
      "--variants", study.variants,
      "Membrane models of the coarse cloth: corotational, triangle-warping, nodal-warping")
    ->delimiter(',')
    ->allow_extra_args(false)
    ->capture_default_str();
  command->add_option("--methods", study.methods, "Ways to the fine positions")
    ->delimiter(',')
    ->allow_extra_args(false)
    ->capture_default_str();
  command
    ->add_option("--cells", study.n_cells, "Cells per side of a sheet, in place of the scene's")
    ->check(CLI::Range(1, 400));
  command->add_option("--time-step", study.time_step, "[s], in place of the scene's");
  command->add_option("--duration", study.duration, "[s], in place of the scene's");
  command
    ->add_option("--frames", study.frames, "Formats of the frames, comma-separated: vtu, ply, obj")
    ->delimiter(',')
    ->allow_extra_args(false)
    ->capture_default_str();
  command->add_flag("--no-frames", arguments->no_frames, "Write no frames");
  command->add_flag("--costs", study.costs,
                    "Measure what each term that the scene leaves out would have cost");
  command->add_option("--output", study.output, "Folder of the results (default out/SCENE)");
  command->add_flag("--quick", arguments->quick, "A sheet of 4 x 4 cells, no error bar: seconds");
  command->add_flag("--resume", study.resume,
                    "Go on from the last frame of the references; coarse cloths are run again");
  command->add_flag("--quiet", study.quiet, "Print nothing but faults");
  command->add_flag("--no-report", arguments->no_report, "Leave out report.html");
  command->footer(
    "References: shell is this program's own cloth with a stiffness per triangle, the naive way at its\n"
    "best; biot and green are finite elements (deal.II), on all ranks, for sheets under gravity that are\n"
    "held by edges or corners.\n"
    "Examples:\n  homespun drape meshes/scenes/hang.prm\n"
    "  mpirun -n 2 homespun drape meshes/scenes/pull.prm --references biot\n"
    "  homespun drape meshes/scenes/clamp-four.prm --variants corotational,nodal-warping\n\n"
    "Keys of a scene file:\n" +
    scene_keys());
  command->callback(
    [&action, &afterwards, arguments]()
    {
      if (arguments->quick)
      {
        if (arguments->study.n_cells == 0)
          arguments->study.n_cells = 4;
        arguments->study.n_cells_of_error_bar = 0;
      }
      action = [&afterwards, arguments]() { return run_drape(*arguments, afterwards); };
    });
}
} // namespace homespun::verification
