// SPDX-License-Identifier: MIT
// homespun judge: somebody's own fine positions against the references of a strain study.
#include "verification/judge/judge_command.h"

#include "verification/command/study_arguments.h"
#include "verification/drape/drape_tables.h"
#include "verification/law/laws.h"
#include "verification/method/method.h"
#include "verification/record/number_text.h"
#include "verification/strain/strain_tables.h"
#include "verification/strain/validity.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>

namespace homespun::verification
{
namespace
{
/// Whether a name in a column of methods, coarse cloths or references means something else.
bool is_taken(const std::string &name)
{
  std::vector<std::string> taken = Method::presets();
  for (const Law law : meshes::all_laws())
    taken.push_back(name_of(law));
  // The last ones were variants of `drape`.
  taken.insert(taken.end(), {unreached, base_method, UncertaintyRow::of_reference,
                             MovingCloth::coarse, "shell", "corotational", "woven"});
  return !Method::name_of_old(name).empty() ||
         std::find(taken.begin(), taken.end(), name) != taken.end();
}

/// Checks name and seconds, and gives the result its folder where none was told.
void check_judge(JudgeOptions &study)
{
  const bool is_word =
    !study.method.empty() &&
    std::all_of(study.method.begin(), study.method.end(),
                [](const unsigned char c) { return std::isalnum(c) || c == '_'; });
  ArgumentFaults faults;
  if (!is_word || is_taken(study.method))
    faults.add("--name: found `" + study.method +
               "`; expected letters, digits and _, and no method, law or reference of homespun");
  if (study.seconds && !(*study.seconds >= 0. && std::isfinite(*study.seconds)))
    faults.add("--seconds: found " + short_text(*study.seconds) +
               "; expected a finite number not below zero");
  faults.throw_if_any();
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
                 "them, or tables load,law,strain,file,seconds or reference,frame,file (.csv)")
    ->required();
  command
    ->add_option("--name", study.method,
                 "What the method is called: letters, digits and _, and no method, law or "
                 "reference of homespun")
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
     ".h5 with a dataset /positions (and /triangles, which are then compared); .obj, .ply or "
     ".vtu.\n"
     "Of infinite cloth (periodic.h5) positions count but for a translation.\n"
     "The folder of the result holds the study with your method as a method more: a row of each "
     "level\n"
     "in strain.csv, claims, a curve in Figure 3. The bar of its error is that of the reference.\n"
     "`homespun drape SCENE.prm --unit-cells CELL.prm --references biot --keep` leaves cloth.h5, "
     "where\n"
     "the cloth begins (/start, /triangles, /coarse_start, /coarse_triangles, of a sheet /rest,\n"
     "/coarse_rest), and biot-FRAME.h5. Positions (n,3) in files of that name become rows of "
     "drape.csv,\n"
     "claims and a curve of the error over time.\n"
     "Example:\n  homespun strain mycell.prm --quick --keep\n"
     "  homespun judge out/mycell/strain-quick mine/*.npy --name mine"},
    [](StudyArguments<JudgeOptions> &given) { check_judge(given.study); });
}
} // namespace homespun::verification
