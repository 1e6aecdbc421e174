// SPDX-License-Identifier: MIT
// Work for the first rank alone that may fail, without leaving the other ranks waiting for it.
#pragma once

#include "meshes/plain/errors.h"
#include "verification/record/claim.h"

#include <mpi.h>

#include <exception>
#include <stdexcept>
#include <vector>

namespace homespun::verification
{
/// Whether MPI runs: commands that solve nothing do not start it, and are one process.
inline bool is_mpi_running()
{
  int is_started = 0, is_ended = 0;
  MPI_Initialized(&is_started);
  MPI_Finalized(&is_ended);
  return is_started != 0 && is_ended == 0;
}

inline bool is_root(const MPI_Comm communicator)
{
  int rank = 0;
  if (is_mpi_running())
    MPI_Comm_rank(communicator, &rank);
  return rank == 0;
}

inline unsigned int n_ranks_of(const MPI_Comm communicator)
{
  int n = 1;
  if (is_mpi_running())
    MPI_Comm_size(communicator, &n);
  return static_cast<unsigned int>(n);
}

/// On the other ranks, where homespun itself is at fault on the first one, which tells.
class FirstRankAtFault : public std::logic_error
{
public:
  FirstRankAtFault()
      : std::logic_error("the first rank failed")
  {
  }
};

/// Runs `work` on the first rank, or on the only process of a program that has not started MPI.
/// All ranks must call this; where the work throws, all throw: the first rank what it caught, the
/// others the same kind (NotConverged, a fault of the program's own, else BadInput).
template <typename Work>
void on_root(const MPI_Comm communicator, Work &&work)
{
  enum Status : int
  {
    good,
    bad_input,
    not_converged,
    own_fault
  };
  int status = good;
  std::exception_ptr failure;
  if (is_root(communicator))
    try
    {
      work();
    }
    catch (const meshes::NotConverged &)
    {
      status  = not_converged;
      failure = std::current_exception();
    }
    catch (const std::logic_error &)
    {
      status  = own_fault;
      failure = std::current_exception();
    }
    catch (...)
    {
      status  = bad_input;
      failure = std::current_exception();
    }
  if (is_mpi_running())
    MPI_Bcast(&status, 1, MPI_INT, 0, communicator);
  if (failure)
    std::rethrow_exception(failure);
  if (status == not_converged)
    throw meshes::NotConverged("the first rank did not converge", {});
  if (status == own_fault)
    throw FirstRankAtFault();
  if (status == bad_input)
    throw meshes::BadInput("the first rank failed");
}

/// What the first rank answers. All ranks must call this.
inline bool answer_of_root(const bool answer, const MPI_Comm communicator)
{
  int shared = answer ? 1 : 0;
  MPI_Bcast(&shared, 1, MPI_INT, 0, communicator);
  return shared != 0;
}

/// Verdicts of work on the first rank: the worst outcome there becomes one of every rank, so that
/// all end with the same status. All ranks must call this.
inline void share_failure(std::vector<Verdict> &verdicts, const MPI_Comm communicator)
{
  int status = status_of(verdicts);
  MPI_Bcast(&status, 1, MPI_INT, 0, communicator);
  if (status != exit_status::good && status_of(verdicts) != status)
    verdicts.push_back(
      judged("first-rank", {},
             status == exit_status::claim_failed ? Outcome::fail : Outcome::inconclusive, 1.));
}
} // namespace homespun::verification
