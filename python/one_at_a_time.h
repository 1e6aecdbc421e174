// SPDX-License-Identifier: MIT
// Long work in libraries that take one thread at a time: HDF5, MPI and what stands on them.
#pragma once

#include <pybind11/pybind11.h>

#include <mutex>

namespace homespun::python
{
/// While it lives, other threads run Python, and none of them is in those libraries. Of all modules
/// of the package: they have one lock. The interpreter is given away before the lock is taken, and
/// the lock before the interpreter is taken back: nobody waits for one and keeps the other.
class OneAtATime
{
  std::mutex &of_all = pybind11::get_or_create_shared_data<std::mutex>("homespun_one_at_a_time");
  const pybind11::gil_scoped_release others_run;
  const std::lock_guard<std::mutex> mine{of_all};
};
} // namespace homespun::python
