// SPDX-License-Identifier: MIT
// The commands of the program. Each adds itself to the command line and, when chosen, leaves there
// what is to be run; the exit status is what that returns.
#pragma once

#include <CLI/App.hpp>

#include <functional>
#include <string>
#include <vector>

namespace homespun::verification
{
struct Studies;

/// What the chosen command does, made by the command line.
using Action = std::function<int()>;

/// What is left to do when MPI has ended, on the first rank: the report, which is drawn by several
/// processes and needs the cores that idle ranks would keep busy, or runs of mpirun. Returns an
/// exit status.
using AfterMpi = std::function<int()>;

/// What the commands add themselves to, and where the chosen one leaves what it checks, and its
/// work in one of three places.
struct CommandLine
{
  CLI::App &app;
  const Studies &studies;
  const std::string text; ///< the command line, for the records

  std::function<void()> check; ///< before all else: throws BadInput of the command line
  Action solve;                ///< with MPI
  Action without_mpi;          ///< on one process without MPI, on the ranks of a launcher with it
  Action at_once; ///< as `without_mpi`, and leaves no record of a run: needs no deal.II
  AfterMpi afterwards;
};

void add_check_command(CommandLine &line);
void add_homogenize_command(CommandLine &line);
void add_strain_command(CommandLine &line);
void add_drape_command(CommandLine &line);
void add_stress_command(CommandLine &line);
void add_converge_command(CommandLine &line);
void add_verify_command(CommandLine &line);
void add_report_command(CommandLine &line);
void add_cells_command(CommandLine &line);
void add_load_command(CommandLine &line);
void add_stability_command(CommandLine &line);
void add_upsample_command(CommandLine &line);

/// What a page saves of its figures beside their numbers.
enum class FigureFiles
{
  svg,
  with_pdf
};

/// Makes report.html from folders of results, with Debian's Python.
/// @throws BadInput where the results cannot be read or drawn
void make_report(const std::vector<std::string> &folders, const std::string &output, bool quiet,
                 FigureFiles files = FigureFiles::svg);
} // namespace homespun::verification
