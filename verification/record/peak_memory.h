// SPDX-License-Identifier: MIT
// How much memory a run took.
#pragma once

#include <mpi.h>

#include <vector>

namespace homespun::verification
{
/// Largest resident memory of each rank since it began [bytes]; empty on all ranks but the first.
/// All ranks must call this.
std::vector<double> peak_memory_of_ranks(MPI_Comm communicator);
} // namespace homespun::verification
