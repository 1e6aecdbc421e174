// SPDX-License-Identifier: MIT
// The commands of the program. Each adds itself to the command line and, when chosen, leaves what
// is to be run; the exit status is what that returns. Those whose action has `without_mpi` in its
// name run on one process without MPI, on the ranks of a launcher with it.
#pragma once

#include <CLI/App.hpp>

#include <functional>

namespace homespun::verification
{
/// What the chosen command does, made by the command line.
using Action = std::function<int()>;

/// What is left to do when MPI has ended, on the first rank: the report, which is drawn by several
/// processes and needs the cores that idle ranks would keep busy, or runs of mpirun. Returns an
/// exit status.
using AfterMpi = std::function<int()>;

void add_check_command(CLI::App &app, Action &action_without_mpi, AfterMpi &afterwards);
void add_homogenize_command(CLI::App &app, Action &action);
void add_strain_command(CLI::App &app, Action &action, AfterMpi &afterwards,
                        const std::string &command_line);
void add_drape_command(CLI::App &app, Action &action, AfterMpi &afterwards,
                       const std::string &command_line);
void add_stress_command(CLI::App &app, Action &action, AfterMpi &afterwards,
                        const std::string &command_line);
void add_converge_command(CLI::App &app, Action &action, AfterMpi &afterwards,
                          const std::string &command_line);
void add_verify_command(CLI::App &app, Action &action, AfterMpi &afterwards,
                        const std::string &command_line);
void add_report_command(CLI::App &app, Action &action_without_mpi, AfterMpi &afterwards);
void add_cells_command(CLI::App &app, Action &action_without_mpi, AfterMpi &afterwards);
void add_load_command(CLI::App &app, Action &action, AfterMpi &afterwards,
                      const std::string &command_line);
void add_stability_command(CLI::App &app, Action &action, AfterMpi &afterwards,
                           const std::string &command_line);
void add_upsample_command(CLI::App &app, Action &action_without_mpi,
                          const std::string &command_line);
void add_scaling_command(CLI::App &app, Action &action_without_mpi, AfterMpi &afterwards,
                         const std::string &command_line);

/// Makes report.html from folders of results, with Debian's Python.
/// @throws BadInput where the results cannot be read or drawn
void make_report(const std::vector<std::string> &folders, const std::string &output, bool quiet);
} // namespace homespun::verification
