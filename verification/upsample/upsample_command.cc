// SPDX-License-Identifier: MIT
// homespun upsample: fine positions for the frames of another program's coarse simulation.
#include "verification/upsample/upsample_command.h"

#include "localization/method.h"
#include "verification/command/study_arguments.h"
#include "verification/record/number_text.h"
#include "verification/record/on_root.h"
#include "verification/record/run_folder.h"
#include "verification/upsample/upsample_study.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cmath>
#include <memory>
#include <utility>

namespace homespun::verification
{
namespace
{
void check_upsample_arguments(const UpsampleOptions &study)
{
  ArgumentFaults faults;
  faults.check_names("--format", study.formats, {"vtu", "ply", "obj", "usda", "pc2"});
  faults.check_names("--method", {study.method},
                     [](const std::string &name) { return localization::Method(name); });
  faults.check_names("--up", {study.up}, {"y", "z"});
  faults.check_names("--held", study.held, {"left", "right", "bottom", "top", "none"});
  if (study.origin.size() != 2 || !std::isfinite(study.origin[0]) ||
      !std::isfinite(study.origin[1]))
    faults.add("--origin: expected two numbers in metres, as in 0.1,0.2");
  if (!std::isfinite(study.angle))
    faults.add("--angle: expected a number of degrees");
  for (const auto &[option, unit] : {std::pair("--unit", study.unit), {"--vt-unit", study.vt_unit}})
    if (!(unit > 0.) || !std::isfinite(unit))
      faults.add(std::string(option) + ": found " + short_text(unit) +
                 "; expected a positive number of metres, as in 0.01 for centimetres");
  if (!(study.limit > 0.) || !std::isfinite(study.limit))
    faults.add("--limit: expected a positive part of the cell side, as in 0.01");
  faults.throw_if_any();
}

int run_upsample(UpsampleOptions study)
{
  if (!is_root(MPI_COMM_WORLD))
    return exit_status::good;
  study.method = localization::Method(study.method).name;
  if (study.output.empty())
    study.output = default_folder("upsample", stems({study.rest_file}));
  run_upsample_study(study);
  return exit_status::good;
}

/// What up-sampling adds to the coarse motion.
void add_method(CLI::App &command, UpsampleOptions &study)
{
  command
    .add_option("--method", study.method,
                "What up-sampling adds to your coarse motion: affine, localized or full, or terms "
                "as in localized+modes")
    ->capture_default_str();
  add_list(command, "--held", study.held,
           "Edges on lattice lines that are held, of all panels, for the term edges, "
           "comma-separated: left, right, bottom, top, or none");
  command.add_flag_callback(
    "--slip", [&study]() { study.slip = localization::Slip::of_cloth; },
    "Held edges of the coarse frames have slip already, as those of `drape` with the term edges");
}
} // namespace

void UpsampleCommand::add(CommandLine &line)
{
  CLI::App *command = line.app.add_subcommand(
    "upsample", "Give the frames of your own coarse simulation their fine positions");
  const auto study = std::make_shared<UpsampleOptions>();
  study->command   = line.text;
  command->add_option("CELL.h5", study->cell_file, "Cell of `homespun homogenize`")->required();
  command
    ->add_option("FRAMES", study->frames,
                 "Frames, .obj or .ply, or a pattern in quotes: 'sim/frame_*.obj'")
    ->required();
  command
    ->add_option("--rest", study->rest_file,
                 "The coarse mesh at rest, .obj or .ply, whose faces all frames have")
    ->required();
  add_list(*command, "--format", study->formats,
           "Formats of the results, comma-separated: a file per frame as vtu, ply, obj, all frames "
           "in one file as usda, pc2");
  add_list(*command, "--origin", study->origin,
           "Rest point [m] that is a corner of a cell, as in 0.1,0.2");
  command
    ->add_option("--angle", study->angle,
                 "Of the cell's first axis against the first rest axis [degrees]")
    ->capture_default_str();
  command
    ->add_option("--unit", study->unit,
                 "Metres per unit of the positions, of the rest mesh and of all frames; 0.01 for "
                 "centimetres. Results are in metres")
    ->capture_default_str();
  command->add_option("--vt-unit", study->vt_unit, "Metres per unit of vt")->capture_default_str();
  command->add_flag("--flat", study->is_flat,
                    "Take the rest state from the positions of a flat mesh although it has vt");
  command->add_flag(
    "--accept-strain", study->accepts_strain,
    "Go on where the mean strain is above 50 %, the mean compression above 30 %, or "
    "a coarse triangle longer than a hundred cells, which mostly mean units that differ");
  add_method(*command, *study);
  command->add_option("--up", study->up, "Axis that points up, y or z: said in .usda")
    ->capture_default_str();
  command->add_option("--validity", study->validity_file,
                      "validity.csv of `homespun strain` (default beside the cell)");
  command
    ->add_option("--limit", study->limit,
                 "Of the range of validity: mean error as a part of the cell side, 0.01 or 0.05")
    ->capture_default_str();
  add_folder_options(*command, *study, "out/REST/upsample");
  command->footer(
    "The rest state is that of `vt` of an OBJ file, or that of a mesh in a plane. Its axes are x "
    "and y of a plane\n"
    "z = const, x and -z of y = const, y and z of x = const, and else the x axis in the plane and "
    "what is to its\n"
    "left, seen from above. A sheet of whole cells, two triangles each, is up-sampled the fast "
    "way; cells are cut\n"
    "along the outlines of all else.\n\n"
    "--method full adds second-order or fitted modes, as cell.h5 has them, and boundary layers at "
    "edges that lie on\n"
    "lattice lines of the cells and are not sewn, if you say with --held which are held. Where the "
    "cloth bends it is\n"
    "curved between its vertices, with the deflection of the bent cell, and PLY has its normals. "
    "The terms p2 and cubic\n"
    "belong to a coarse cloth, and yours is given. Fitted modes of weaves are in the CELL/cell.h5 "
    "of `homespun strain`.\n"
    "What is left out is said, and at which edges of which panels there are layers.\n\n"
    "upsample.csv says of each frame, without a reference, where its error may come from: `strain` "
    "(against the\n"
    "range of validity of the cell, where it is known), `strain_change` across one cell, and "
    "`compression`, where\n"
    "slack cloth wrinkles below the mesh; with mean, what 99 % of the area stay below, the largest "
    "and its place.\n"
    "They indicate and bound nothing. The same values stand on the vertices of .vtu.\n\n"
    "A frame that is made stays, as long as its file is the same; more may be added to a folder.\n"
    "Examples:\n  homespun upsample out/dots/homogenize/cell.h5 --rest rest.obj "
    "'sim/frame_*.obj'\n"
    "  homespun upsample cell.h5 --rest rest.ply sim/*.ply --format ply,usda --up y\n");
  command->callback(
    [&line, study]()
    {
      line.check       = [study]() { check_upsample_arguments(*study); };
      line.without_mpi = [study]() { return run_upsample(*study); };
    });
}
} // namespace homespun::verification
