// SPDX-License-Identifier: MIT
// homespun drape: a scene and its page.
#include "verification/drape/drape_command.h"

#include "meshes/plain/errors.h"
#include "verification/command/study_arguments.h"
#include "verification/drape/scene/scene.h"
#include "verification/drape/scene_cloth.h"
#include "verification/method/method.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <memory>

namespace homespun::verification
{
namespace
{
struct DrapeArguments : StudyArguments<DrapeOptions>
{
  bool no_frames = false;
};

void check_drape_arguments(const CLI::App &command, DrapeArguments &arguments)
{
  DrapeOptions &study = arguments.study;
  if (arguments.no_frames)
    study.frames.clear();
  if (study.is_quick)
    make_quick(study);
  choose_folder(command, {study.scene_file}, study);
  ArgumentFaults faults;
  faults.read_variants(study, study.variants);
  faults.check_names("--variants", study.variants, membrane_of);
  faults.read_methods(study, study.methods);
  std::vector<std::string> references = {"shell"};
  for (const meshes::Law law : meshes::laws_with(&meshes::LawProperties::is_of_space))
    references.push_back(name_of(law));
  faults.check_names("--references", study.references, references);
  faults.check_names("--frames", study.frames, {"vtu", "ply", "obj"});
  if (!study.variants.empty() && study.variants.front() == name_of_membrane({}))
    faults.add("--variants: found `" + study.variants.front() +
               "` first; expected a law, which has an energy: references and other variants are "
               "held against the first");
  if (!(study.time_step >= 0.) || !(study.duration >= 0.))
    faults.add("--time-step, --duration: expected positive numbers in seconds");
  faults.throw_if_any();
}
} // namespace

void DrapeCommand::add(CommandLine &line)
{
  CLI::App *command = line.app.add_subcommand(
    "drape",
    "Run a scene: the coarse cloth in motion, up-sampled every step, against the resolved one");
  const auto arguments = std::make_shared<DrapeArguments>();
  DrapeOptions &study  = arguments->study;
  study.methods        = {"affine", "localized"};

  command
    ->add_option("SCENE.prm", study.scene_file, "Scene file; the shipped ones are in meshes/scenes")
    ->required();
  add_list(*command, "--unit-cells", study.cell_files,
           "Cell files instead of the scene's, comma-separated");
  add_list(*command, "--references", study.references,
           "Full-resolution cloths to run beside it, comma-separated: shell, biot, green, yarn");
  add_list(*command, "--variants", study.variants,
           "Membranes of the coarse cloth, the method's first: the laws biot and yarn, and\n"
           "nodal-warping, the paper's (default: yarn where a phase loses ellipticity under biot\n"
           "before 20 %, else biot)");
  add_list(*command, "--methods", study.methods,
           "Methods of up-sampling, as in `homespun strain --help`; those with the terms p2,\n"
           "cubic or edges (of a scene with the term selvedge) move coarse cloths of their own;\n"
           "curved (of a scene with the term bending) bends between their vertices");
  command->add_option("--cells", study.n_cells, "Cells per side of a sheet, instead of the scene's")
    ->check(CLI::Range(1, 400));
  command->add_option("--time-step", study.time_step, "[s], instead of the scene's");
  command->add_option("--duration", study.duration, "[s], instead of the scene's");
  add_list(*command, "--frames", study.frames,
           "Formats of the frames, comma-separated: vtu, ply, obj");
  command->add_flag("--no-frames", arguments->no_frames, "Write no frames");
  command->add_flag("--keep", study.keep,
                    "Keep meshes and positions of every frame of a reference in CELL/positions/, "
                    "for a method of your own: see `homespun judge`");
  command->add_flag("--costs", study.costs,
                    "Measure what each term that the scene leaves out would have cost");
  command->add_flag("--quick", study.is_quick, "A sheet of 4 x 4 cells, no error bar: seconds");
  add_study<DrapeCommand>(
    line, *command, arguments,
    {"out/SCENE/drape, --quick drape-quick",
     "References: shell is this program's own cloth with a stiffness per triangle, the naive way "
     "at its\n"
     "best, with the law of the method; the laws are finite elements (deal.II), on all ranks, "
     "for sheets\n"
     "under gravity that are held by edges, corners or vertices.\n"
     "Of each frame: errors (drape.csv), motion, energies and what each pin and handle exerts\n"
     "(motion.csv), the cloth for ParaView.\n"
     "Examples:\n  homespun drape meshes/scenes/hang.prm\n"
     "  mpirun -n 2 homespun drape meshes/scenes/pull.prm --references biot\n"
     "  homespun drape meshes/scenes/clamp-four.prm --variants biot,nodal-warping\n\n"
     "Keys of a scene file:\n" +
       scene_keys()},
    [command](DrapeArguments &given) { check_drape_arguments(*command, given); });
}
} // namespace homespun::verification
