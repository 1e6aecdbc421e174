// SPDX-License-Identifier: MIT
#include "homogenization/fem/load_checkpoint.h"

#include "meshes/files/write_whole.h"
#include "meshes/plain/errors.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

namespace homespun::homogenization
{
using dealii::Utilities::MPI::max;
using dealii::Utilities::MPI::min;

LoadCheckpoint::LoadCheckpoint(std::string folder, const MPI_Comm communicator)
    : folder(std::move(folder))
    , communicator(communicator)
{
}

std::string LoadCheckpoint::file_of(const int load) const
{
  return folder + "/load-" + std::to_string(load) + "-rank-" +
         std::to_string(dealii::Utilities::MPI::this_mpi_process(communicator)) + "-of-" +
         std::to_string(dealii::Utilities::MPI::n_mpi_processes(communicator));
}

bool LoadCheckpoint::read(const int load, ElasticSolver::Vector &owned) const
{
  if (folder.empty())
    return false;
  std::ifstream input(file_of(load), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
  std::vector<double> numbers(static_cast<std::size_t>(owned.end() - owned.begin()));
  bool is_good = bytes.size() == numbers.size() * sizeof(double);
  if (is_good)
    std::memcpy(numbers.data(), bytes.data(), bytes.size());
  is_good = is_good && std::all_of(numbers.begin(), numbers.end(),
                                   [](const double x) { return std::isfinite(x); });
  if (min(is_good ? 1 : 0, communicator) == 0)
    return false;
  std::copy(numbers.begin(), numbers.end(), owned.begin());
  return true;
}

void LoadCheckpoint::write(const int load, const ElasticSolver::Vector &owned) const
{
  if (folder.empty())
    return;
  const std::vector<double> numbers(owned.begin(), owned.end());
  std::string bytes(numbers.size() * sizeof(double), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  std::string fault;
  try
  {
    meshes::write_whole(file_of(load), bytes);
  }
  catch (const std::exception &failure)
  {
    fault = failure.what();
  }
  if (max(fault.empty() ? 0 : 1, communicator) == 1)
    throw meshes::BadInput(fault.empty() ? "another rank could not write its checkpoint" : fault);
}
} // namespace homespun::homogenization
