// SPDX-License-Identifier: MIT
// homespun homogenize: one cell, with its bars.
#include "verification/homogenize/homogenize_command.h"

#include "verification/command/study_arguments.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Option.hpp>

#include <map>
#include <memory>

namespace homespun::verification
{
void HomogenizeCommand::add(CommandLine &line)
{
  CLI::App *command = line.app.add_subcommand(
    "homogenize",
    "C^H and the bending stiffness D^H with their guaranteed brackets, characteristic "
    "displacements, deflections, strains and stresses of the phases, moduli: cell.h5, "
    "homogenize.json, a .vtu for ParaView");
  const auto arguments = std::make_shared<HomogenizeOptions>();
  command->add_option("CELL.prm", arguments->file, "Cell file")->required();
  command
    ->add_option("--order", arguments->study.solve.order,
                 "Order of the elements, 1 (solves on the mesh as given) or 2")
    ->check(CLI::Range(1, 2))
    ->capture_default_str();
  command
    ->add_option("--refine", arguments->study.solve.refine,
                 "Uniform refinements of the mesh; each makes four triangles of one")
    ->check(CLI::Range(0, 8))
    ->capture_default_str();
  using homogenization::CellSolver;
  std::map<std::string, CellSolver> solvers;
  for (const CellSolver solver : {CellSolver::fastest, CellSolver::direct, CellSolver::multigrid})
    solvers[homogenization::name_of(solver)] = solver;
  command
    ->add_option("--solver", arguments->study.solve.solver,
                 "Of the cell problems: fastest, direct, multigrid; fastest is direct up to "
                 "1,600,000 DoFs, and "
                 "direct takes over where multigrid fails")
    ->transform(CLI::CheckedTransformer(solvers).description(""))
    ->default_str(homogenization::name_of(CellSolver::fastest));
  CLI::Option *tolerance =
    command
      ->add_option(
        "--tolerance", arguments->study.bracket.tolerance,
        "Refine adaptively until the brackets C_lower <= C^H <= C_upper and D_lower <= D^H <= "
        "D_upper both have this relative width, the largest v.(C_upper - C_lower).v / v.C_upper.v; "
        "each has its own meshes; without it the brackets are those of the given mesh")
      ->check(CLI::Range(1e-12, 1.));
  CLI::Option *max_dofs =
    command
      ->add_option(
        "--max-dofs", arguments->study.bracket.max_dofs,
        "DoFs up to which brackets are made, of the larger of its two problems; adaptivity stops "
        "before")
      ->check(CLI::Range(100u, 20000000u))
      ->capture_default_str();
  CLI::Option *uncertain = command->add_option(
    "--uncertain", arguments->uncertain,
    "`phase.constant=range, ...`, such as soft.E=20%,hard.thickness=1e-5: inputs "
    "known only to a range, in percent of the value or in Pa, m, deg; constants are E, nu "
    "and thickness, or E1, E2, nu12, G12, thickness and angle of an orthotropic "
    "phase. Their largest effect on C^H and D^H, to first order, stands beside the "
    "brackets");
  command
    ->add_flag("!--no-bars", arguments->study.bars,
               "Neither brackets nor, where there are none, the finer solve of the error bar: the "
               "cell problems alone, without D^H, for large meshes")
    ->excludes(tolerance)
    ->excludes(max_dofs)
    ->excludes(uncertain);
  command
    ->add_flag("--pieces", arguments->study.pieces,
               "Also characteristic-displacements-refined.pvtu: on the mesh of the solve, a piece "
               "from each rank")
    ->excludes(tolerance);
  add_folder_options(*command, arguments->study, "out/NAME/homogenize");
  command->footer(
    "Example:\n  homespun homogenize meshes/cells/layered.prm\n"
    "  homespun homogenize meshes/cells/three-stiffness.prm --tolerance 1e-3\n"
    "  homespun homogenize meshes/cells/layered.prm --uncertain soft.E=20%,hard.E=20%\n"
    "  mpirun -n 2 homespun homogenize mycell.prm --refine 2 --pieces");
  command->callback(
    [&line, arguments]()
    {
      line.solve = [&line, arguments]()
      { return line.studies.run<HomogenizeCommand>(*arguments, MPI_COMM_WORLD); };
    });
}
} // namespace homespun::verification
