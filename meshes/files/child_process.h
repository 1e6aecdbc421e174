// SPDX-License-Identifier: MIT
// Other programs that homespun runs: Python for the report and for meshes, Gmsh for cells, mpirun
// for its own ranks.
#pragma once

#include <string>
#include <vector>

namespace homespun::meshes
{
/// Runs a program, found by its name as a shell would, without a shell, on all cores (mpirun binds
/// a rank to one, and a child inherits that), and without the variables that MPI gives a rank, by
/// which a program with MPI would take itself for one of ours.
/// @param log receives what it prints; empty: it prints where homespun prints
/// @param variables "NAME=value" that it gets beside ours
/// @return its exit status, as a shell tells it: 127 where it could not be run, 128 and the signal
///   where it was killed by one
int run_child(const std::vector<std::string> &words, const std::string &log = "",
              const std::vector<std::string> &variables = {});

/// What to tell of a status of run_child() that means a signal; empty of any other.
std::string text_of_signal(int status);
} // namespace homespun::meshes
