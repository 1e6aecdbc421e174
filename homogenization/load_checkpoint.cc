// SPDX-License-Identifier: MIT
#include "homogenization/load_checkpoint.h"

#include "meshes/errors.h"
#include "meshes/write_whole.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <system_error>
#include <utility>
#include <vector>

namespace homespun::homogenization
{
using dealii::Utilities::MPI::max;
using dealii::Utilities::MPI::min;

LoadCheckpoint::LoadCheckpoint(std::string folder, const std::uint64_t fingerprint,
                               const MPI_Comm communicator)
    : folder(std::move(folder))
    , fingerprint(fingerprint)
    , communicator(communicator)
{
}

std::string LoadCheckpoint::file_of(const int load) const
{
  return folder + "/load-" + std::to_string(load) + "-rank-" +
         std::to_string(dealii::Utilities::MPI::this_mpi_process(communicator)) + "-of-" +
         std::to_string(dealii::Utilities::MPI::n_mpi_processes(communicator));
}

void LoadCheckpoint::clear(const std::string &folder)
{
  static const std::regex ours("load-[0-2]-rank-[0-9]+-of-[0-9]+");
  std::error_code ignored;
  std::vector<std::filesystem::path> files;
  for (std::filesystem::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored))
    if (std::regex_match(entry->path().filename().string(), ours))
      files.push_back(entry->path());
  for (const std::filesystem::path &file : files)
    std::filesystem::remove(file, ignored);
  std::filesystem::remove(folder, ignored); // fails where the user has something there
}

bool LoadCheckpoint::read(const int load, ElasticSolver::Vector &owned) const
{
  if (folder.empty())
    return false;
  std::ifstream input(file_of(load), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
  std::vector<double> numbers(static_cast<std::size_t>(owned.end() - owned.begin()));
  std::uint64_t of_file = 0;
  bool is_good          = bytes.size() == sizeof(of_file) + numbers.size() * sizeof(double);
  if (is_good)
  {
    std::memcpy(&of_file, bytes.data(), sizeof(of_file));
    std::memcpy(numbers.data(), bytes.data() + sizeof(of_file), bytes.size() - sizeof(of_file));
  }
  is_good =
    is_good && of_file == fingerprint &&
    std::all_of(numbers.begin(), numbers.end(), [](const double x) { return std::isfinite(x); });
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
  std::string bytes(sizeof(fingerprint) + numbers.size() * sizeof(double), '\0');
  std::memcpy(bytes.data(), &fingerprint, sizeof(fingerprint));
  std::memcpy(bytes.data() + sizeof(fingerprint), numbers.data(),
              bytes.size() - sizeof(fingerprint));
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
