// SPDX-License-Identifier: MIT
// The whole program with deal.II and MPI, `homespun-full`, which `homespun` hands over to.
#include "verification/program/all_commands.h"
#include "verification/program/command_line.h"
#include "verification/program/mpi_start.h"
#include "verification/record/blas.h"
#include "verification/record/provenance.h"
#include "verification/record/verdict.h"

namespace
{
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
  Program program;
  program.studies        = AllCommands::studies();
  program.before_solving = [&]() { mpi.start(argv[0]); };
  program.version        = []() { return version_text("/proc/self/exe"); };
  return run_command_line({argv + 1, argv + argc}, program, afterwards);
}
} // namespace

int main(int argc, char **argv)
{
  homespun::verification::choose_blas_kernels();
  homespun::verification::limit_blas_threads();
  homespun::verification::AfterMpi afterwards;
  const int status = run(argc, argv, afterwards);
  return afterwards ? homespun::verification::guarded(
                        [&]() { return homespun::verification::worse(status, afterwards()); }, true)
                    : status;
}
