// SPDX-License-Identifier: MIT
#include "homogenization/fem/solution_pieces.h"

#include "homogenization/fem/elastic_solver.h"
#include "meshes/plain/errors.h"

#include <deal.II/base/mpi.h>
#include <deal.II/numerics/data_out.h>

#include <filesystem>
#include <fstream>
#include <system_error>
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
  DataOut<2> output;
  output.attach_dof_handler(discretization.dof_handler);
  DataOutBase::VtkFlags flags;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const std::string chi            = std::array<const char *, 3>{"chi_11", "chi_22", "chi_12"}[a];
    flags.physical_units[chi]        = "m";
    constexpr auto is_part_of_vector = DataComponentInterpretation::component_is_part_of_vector;
    output.add_data_vector(solutions[a], std::vector<std::string>(2, chi),
                           DataOut<2>::type_dof_data, {is_part_of_vector, is_part_of_vector});
  }
  const unsigned int rank = Utilities::MPI::this_mpi_process(discretization.communicator);
  dealii::Vector<double> material(discretization.triangulation->n_active_cells()), ranks(material);
  for (const auto &cell : discretization.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      material(cell->active_cell_index()) =
        discretization.mesh.material(static_cast<Eigen::Index>(Discretization::triangle_of(cell)));
  ranks = rank;
  output.add_data_vector(material, "material");
  output.add_data_vector(ranks, "rank");
  output.build_patches();
  output.set_flags(flags);
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
