// SPDX-License-Identifier: MIT
#include "verification/record/peak_memory.h"

#include "verification/record/on_root.h"

#include <sys/resource.h>

namespace homespun::verification
{
std::vector<double> peak_memory_of_ranks(const MPI_Comm communicator)
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  const double mine = 1024. * static_cast<double>(usage.ru_maxrss);
  std::vector<double> all(is_root(communicator) ? n_ranks_of(communicator) : 0);
  MPI_Gather(&mine, 1, MPI_DOUBLE, all.data(), 1, MPI_DOUBLE, 0, communicator);
  return all;
}
} // namespace homespun::verification
