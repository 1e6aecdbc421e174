// SPDX-License-Identifier: MIT
// The program as users call it. What needs no finite elements it answers by itself, at once: help,
// faults of the command line, versions, `check`, `report`, `cells`. For all else the process
// becomes `homespun-full`, with the same arguments: deal.II brings two hundred libraries, which
// take a quarter of a second to load.
#include "meshes/plain/errors.h"
#include "verification/command/data_folder.h"
#include "verification/program/command_line.h"
#include "verification/record/blas.h"
#include "verification/record/provenance.h"
#include "verification/record/verdict.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include <unistd.h>

namespace
{
/// CHOLMOD copies its blocks with four threads, whatever OMP_NUM_THREADS says, and those that find
/// nothing to do spin. One thread per rank unless said, before OpenMP is loaded.
void limit_threads()
{
  const char *const said = std::getenv("OMP_NUM_THREADS");
  const int threads      = said != nullptr ? std::max(1, std::atoi(said)) : 1;
  setenv("OMP_THREAD_LIMIT", std::to_string(threads).c_str(), 0);
}

/// Does not return where all is well.
void hand_over(char **argv)
{
  limit_threads();
  const std::string full = homespun::verification::full_program();
  execv(full.c_str(), argv);
  throw homespun::meshes::BadInput(
    full + ": cannot be run (" + std::strerror(errno) +
    "); expected the part of homespun that solves: install homespun again, or build its target "
    "`homespun`");
}
} // namespace

int main(int argc, char **argv)
{
  using namespace homespun::verification;
  AfterMpi afterwards;
  Program program;
  program.before_records = [&]() { hand_over(argv); };
  program.version        = []()
  {
    load_blas();
    choose_blas_kernels();
    limit_blas_threads();
    return version_text(full_program());
  };
  const int status = guarded(
    [&]()
    {
      // The ranks of a launcher, which waits for MPI, of which the first alone prints.
      if (is_launched())
        hand_over(argv);
      return run_command_line({argv + 1, argv + argc}, program, afterwards);
    },
    true);
  return afterwards ? guarded([&]() { return worse(status, afterwards()); }, true) : status;
}
