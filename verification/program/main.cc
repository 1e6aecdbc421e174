// SPDX-License-Identifier: MIT
// The program: a command line, and what its exit status means.
#include "meshes/plain/errors.h"
#include "verification/program/commands.h"
#include "verification/program/study_arguments.h"
#include "verification/record/blas.h"
#include "verification/record/on_root.h"
#include "verification/record/provenance.h"
#include "verification/record/verdict.h"

#include <deal.II/base/mpi.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>

namespace
{
/// Runs the chosen action; every rank meets the same faults, the first one tells.
int guarded(const homespun::verification::Action &action, const bool tells)
{
  try
  {
    return action();
  }
  catch (const homespun::meshes::BadInput &bad)
  {
    if (tells)
      for (const std::string &fault : bad.faults())
        std::cerr << "homespun: " << fault << "\n";
    return homespun::verification::exit_status::bad_input;
  }
  catch (const std::filesystem::filesystem_error &error)
  {
    if (tells)
      std::cerr << "homespun: " << error.what()
                << "; expected a folder that can be written: choose "
                << "another --output\n";
    return homespun::verification::exit_status::bad_input;
  }
  catch (const homespun::meshes::NotConverged &failure)
  {
    if (tells)
      std::cerr << "homespun: " << failure.what() << "\n";
    return homespun::verification::exit_status::not_converged;
  }
}

/// Whether mpirun, srun or the like started this process, as one of several perhaps.
bool is_launched()
{
  for (const char *name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID"})
    if (std::getenv(name))
      return true;
  return false;
}

/// MPI, for as long as it runs. With one thread per rank.
class Mpi
{
public:
  /// @param name of the program. The command line is not handed on: PETSc, which deal.II starts
  ///   with MPI, would take our options for its own and warn of them at the end.
  void start(char *const name)
  {
    if (running)
      return;
    // A process by itself needs no daemon of Open MPI, whose start takes longer than all else in
    // MPI_Init; only processes that start others by MPI do.
    if (!is_launched())
      setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    arguments[0] = name;
    running.emplace(n_arguments, first_argument, 1);
  }

private:
  int n_arguments = 1;
  std::array<char *, 2> arguments{};
  char **first_argument = arguments.data();
  std::optional<dealii::Utilities::MPI::MPI_InitFinalize> running;
};

/// All that happens while MPI runs.
/// @param afterwards receives what is left to do when it has ended
int run(int argc, char **argv, homespun::verification::AfterMpi &afterwards)
{
  using namespace homespun::verification;
  // Under a launcher at once: the first rank alone prints, and a launcher waits for MPI. A process
  // by itself starts it where a command needs it.
  Mpi mpi;
  if (is_launched())
    mpi.start(argv[0]);
  const bool is_root = homespun::verification::is_root(MPI_COMM_WORLD);

  std::string command_line = "homespun";
  for (int k = 1; k < argc; ++k)
    command_line += std::string(" ") + argv[k];
  const unsigned int n_ranks = n_ranks_of(MPI_COMM_WORLD);
  if (n_ranks > 1)
    command_line = "mpirun -n " + std::to_string(n_ranks) + " " + command_line;

  CLI::App app(
    "homespun tells how far an up-sampled cloth is from the truth, and where the error comes "
    "from.\nA periodic unit cell is homogenized once, a coarse cloth moves with the effective "
    "stiffness, the fine\nmesh is restored from it and held against the resolved solution.",
    "homespun");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.footer("Exit status, the worst in this order: 2 bad input; 3 a solver did not converge where "
             "it had to; 1 a claim failed;\n4 a claim is open; 0 all claims hold. Claims are of "
             "the program, of the input, or of the method.\n`homespun COMMAND --help` teaches a "
             "command; `mpirun -n N homespun ...` works for every command that solves.");
  Action action, action_without_mpi;
  add_check_command(app, action_without_mpi, afterwards);
  add_homogenize_command(app, action);
  add_strain_command(app, action, afterwards, command_line);
  add_drape_command(app, action, afterwards, command_line);
  add_upsample_command(app, action_without_mpi, command_line);
  add_stress_command(app, action, afterwards, command_line);
  add_converge_command(app, action, afterwards, command_line);
  add_verify_command(app, action, afterwards, command_line);
  add_report_command(app, action_without_mpi, afterwards);
  add_cells_command(app, action_without_mpi, afterwards);
  add_load_command(app, action, afterwards, command_line);
  add_stability_command(app, action, afterwards, command_line);
  add_scaling_command(app, action_without_mpi, afterwards, command_line);
  try
  {
    std::vector<std::string> words = joined_lists({argv + 1, argv + argc});
    std::reverse(words.begin(), words.end()); // as CLI11 takes them
    app.parse(words);
  }
  catch (const CLI::ParseError &error)
  {
    const bool is_fault = error.get_exit_code() != 0;
    if (is_root)
      app.exit(error, std::cout, std::cerr);
    return is_fault ? 2 : 0;
  }
  if (action)
    mpi.start(argv[0]);
  const int status = guarded(action ? action : action_without_mpi, is_root);
  // A launcher ends all ranks when one of them ends with another status than zero, and the first
  // one may have a report to make yet: what the claims come to is its word alone.
  const bool is_of_claims =
    status == exit_status::claim_failed || status == exit_status::claim_open;
  return is_of_claims && !is_root ? exit_status::good : status;
}
} // namespace

int main(int argc, char **argv)
{
  homespun::verification::choose_blas_kernels();
  homespun::verification::limit_blas_threads();
  homespun::verification::AfterMpi afterwards;
  const int status = run(argc, argv, afterwards);
  return afterwards
           ? guarded([&]() { return homespun::verification::worse(status, afterwards()); }, true)
           : status;
}
