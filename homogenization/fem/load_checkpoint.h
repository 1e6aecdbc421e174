// SPDX-License-Identifier: MIT
// Solutions of the cell problems that are done, so that a run that was killed does not solve them
// again.
#pragma once

#include "homogenization/fem/elastic_solver.h"

#include <string>

namespace homespun::homogenization
{
/// A file for each load and rank. What is read is a start for the solver, which goes on until the
/// residual is small enough.
class LoadCheckpoint
{
public:
  /// @param folder exists, and holds nothing of another problem; empty: nothing is kept
  LoadCheckpoint(std::string folder, MPI_Comm communicator);

  /// Takes up the solution of a load where every rank has its part, else leaves `owned` as it is.
  /// All ranks must call this.
  /// @return whether it did
  bool read(int load, ElasticSolver::Vector &owned) const;

  /// All ranks must call this.
  /// @throws BadInput, on all ranks, where one of them cannot write
  void write(int load, const ElasticSolver::Vector &owned) const;

private:
  std::string file_of(int load) const;

  const std::string folder;
  const MPI_Comm communicator;
};
} // namespace homespun::homogenization
