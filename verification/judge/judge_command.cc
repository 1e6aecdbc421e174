// SPDX-License-Identifier: MIT
// homespun judge: somebody's own fine positions against the references of a strain study.
#include "verification/judge/judge_command.h"

#include "verification/command/study_arguments.h"
#include "verification/method/method.h"
#include "verification/strain/strain_tables.h"
#include "verification/strain/validity.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <cctype>
#include <memory>

namespace homespun::verification
{
namespace
{
/// Checks the name, and gives the result its folder where none was told.
void check_judge(JudgeOptions &study)
{
  const bool is_word =
    !study.method.empty() &&
    std::all_of(study.method.begin(), study.method.end(),
                [](const unsigned char c) { return std::isalnum(c) || c == '_'; });
  std::vector<std::string> taken = Method::presets();
  taken.insert(taken.end(), {unreached, base_method, UncertaintyRow::of_reference});
  if (!is_word || std::find(taken.begin(), taken.end(), study.method) != taken.end())
    throw meshes::BadInput("--name: found `" + study.method +
                           "`; expected letters, digits and _, and no method of homespun");
  while (study.run.size() > 1 && study.run.back() == '/')
    study.run.pop_back();
  if (study.output.empty())
    study.output = study.run + "-" + study.method;
}
} // namespace

void JudgeCommand::add(CommandLine &line)
{
  CLI::App *command = line.app.add_subcommand(
    "judge", "Hold the fine positions of your own method against the references of a study");
  const auto arguments = std::make_shared<StudyArguments<JudgeOptions>>();
  JudgeOptions &study  = arguments->study;
  study.command        = line.text;
  command->add_option("RUN", study.run, "Folder of a `homespun strain --keep` or `drape --keep`")
    ->required();
  command
    ->add_option("POSITIONS", study.files,
                 "Files LOAD-LAW-STRAIN.npy (.h5, .obj, .ply, .vtu), each of one level, folders of "
                 "them, or tables load,law,strain,file,seconds (.csv)")
    ->required();
  command
    ->add_option("--name", study.method,
                 "What the method is called: letters, digits and _, and no method of homespun")
    ->capture_default_str();
  command->add_option(
    "--seconds", study.seconds,
    "Run time of the method from coarse to fine positions of one level [s], to which that "
    "of the coarse cloth comes (default: not told)");
  add_study<JudgeCommand>(
    line, *command, arguments,
    {"RUN-NAME",

     "`homespun strain CELL.prm --keep` leaves RUN/CELL/positions/: sheet.h5 with the meshes "
     "(/rest,\n"
     "/triangles, /coarse_rest, /coarse_triangles), and for every load, law and strain a file\n"
     "LOAD-LAW-STRAIN.h5 with /coarse, where the coarse cloth is, and /reference, where the "
     "resolved\n"
     "one is. Your method makes of /coarse the positions of all vertices of /rest, in their order "
     "and\n"
     "in metres, shape (n,2) or (n,3) with zeros, and writes them to a file of the same name: "
     ".npy;\n"
     ".h5 with a dataset /positions; .obj, .ply or .vtu. Of infinite cloth (periodic.h5) positions "
     "count "
     "but\n"
     "for a translation.\n"
     "The folder of the result holds the study with your method as a method more: a row of each "
     "level\n"
     "in strain.csv, claims, a curve in Figure 3. The bar of its error is that of the reference.\n"
     "`homespun drape SCENE.prm --unit-cells CELL.prm --references biot --keep` leaves cloth.h5, "
     "where\n"
     "the cloth begins (/start, /triangles, /coarse_start, /coarse_triangles, of a sheet /rest,\n"
     "/coarse_rest), and biot-FRAME.h5. Positions (n,3) in files of that name become rows of "
     "drape.csv\n"
     "and a curve of the error over time.\n"
     "Example:\n  homespun strain mycell.prm --quick --keep\n"
     "  homespun judge out/mycell/strain-quick mine/*.npy --name mine"},
    [](StudyArguments<JudgeOptions> &given) { check_judge(given.study); });
}
} // namespace homespun::verification
