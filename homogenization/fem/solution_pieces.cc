// SPDX-License-Identifier: MIT
#include "homogenization/fem/solution_pieces.h"

#include "homogenization/fem/elastic_solver.h"
#include "meshes/plain/errors.h"

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <tuple>
#include <vector>

namespace homespun::homogenization
{
using namespace dealii;

namespace
{
std::string file_of_piece(const std::string &name, const unsigned int rank)
{
  return name + "-" + std::to_string(rank) + ".vtu";
}

/// What a rank writes of its triangles: six components of chi at the corners, material and rank.
class Pieces : public DataOutInterface<2>
{
public:
  using Patch = DataOutBase::Patch<2, 2>;

  Pieces(const Discretization &discretization,
         const std::array<ElasticSolver::Vector, 3> &solutions)
  {
    const unsigned int rank = Utilities::MPI::this_mpi_process(discretization.communicator);
    discretization.for_owned_triangles(
      [&](const unsigned int t, const std::vector<types::global_dof_index> &dofs)
      {
        Patch patch;
        patch.reference_cell = ReferenceCells::Triangle;
        patch.patch_index    = static_cast<unsigned int>(patches.size());
        patch.data.reinit(8, 3);
        for (unsigned int k = 0; k < 3; ++k)
        {
          const Eigen::RowVector2d point = discretization.point_of(t, k);
          patch.vertices[k]              = {point(0), point(1)};
          for (unsigned int a = 0; a < 3; ++a)
            for (unsigned int c = 0; c < 2; ++c)
              patch.data(2 * a + c, k) = static_cast<float>(solutions[a](dofs[2 * k + c]));
          patch.data(6, k) = static_cast<float>(discretization.mesh.material(t));
          patch.data(7, k) = static_cast<float>(rank);
        }
        patches.push_back(patch);
      });
    DataOutBase::VtkFlags flags;
    for (const char *const chi : names)
      flags.physical_units[chi] = "m";
    set_flags(flags);
  }

private:
  const std::vector<Patch> &get_patches() const override
  {
    return patches;
  }

  std::vector<std::string> get_dataset_names() const override
  {
    std::vector<std::string> all;
    for (const char *const chi : names)
      all.insert(all.end(), 2, chi);
    all.insert(all.end(), {"material", "rank"});
    return all;
  }

  std::vector<std::tuple<unsigned int, unsigned int, std::string,
                         DataComponentInterpretation::DataComponentInterpretation>>
  get_nonscalar_data_ranges() const override
  {
    std::vector<std::tuple<unsigned int, unsigned int, std::string,
                           DataComponentInterpretation::DataComponentInterpretation>>
      ranges;
    for (unsigned int a = 0; a < 3; ++a)
      ranges.emplace_back(2 * a, 2 * a + 1, names[a],
                          DataComponentInterpretation::component_is_part_of_vector);
    return ranges;
  }

  static constexpr std::array<const char *, 3> names = {"chi_11", "chi_22", "chi_12"};
  std::vector<Patch> patches;
};
} // namespace

void remove_pieces(const std::string &name)
{
  std::error_code ignored;
  std::filesystem::remove(name + ".pvtu", ignored);
  for (unsigned int r = 0; std::filesystem::remove(file_of_piece(name, r), ignored); ++r)
    ;
}

void write_pieces(const std::string &name, const Discretization &discretization,
                  const std::array<ElasticSolver::Vector, 3> &solutions)
{
  const Pieces output(discretization, solutions);
  const unsigned int rank = Utilities::MPI::this_mpi_process(discretization.communicator);
  std::ofstream piece(file_of_piece(name, rank));
  output.write_vtu(piece);
  int is_good = piece.flush().good();
  if (rank == 0)
  {
    std::vector<std::string> files;
    for (unsigned int r = 0; r < Utilities::MPI::n_mpi_processes(discretization.communicator); ++r)
      files.push_back(std::filesystem::path(file_of_piece(name, r)).filename().string());
    std::ofstream listing(name + ".pvtu");
    output.write_pvtu_record(listing, files);
    is_good = is_good && listing.flush().good();
  }
  if (Utilities::MPI::min(is_good, discretization.communicator) == 0)
    throw meshes::BadInput(name + ".pvtu and its pieces cannot be written; expected a folder with "
                                  "room: is the disk full?");
}
} // namespace homespun::homogenization
