// SPDX-License-Identifier: MIT
#include "homogenization/fem/solution_pieces.h"

#include "homogenization/fem/elastic_solver.h"
#include "meshes/plain/errors.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_out.h>

#include <filesystem>
#include <fstream>
#include <string>
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
  const unsigned int rank = Utilities::MPI::this_mpi_process(discretization.communicator);
  DataOut<2> output;
  output.attach_dof_handler(discretization.dof_handler);
  const std::vector<DataComponentInterpretation::DataComponentInterpretation> is_vector(
    2, DataComponentInterpretation::component_is_part_of_vector);
  DataOutBase::VtkFlags flags;
  constexpr std::array<const char *, 3> names = {"chi_11", "chi_22", "chi_12"};
  for (std::size_t a = 0; a < names.size(); ++a)
  {
    output.add_data_vector(solutions[a], std::vector<std::string>(2, names[a]),
                           DataOut<2>::type_dof_data, is_vector);
    flags.physical_units[names[a]] = "m";
  }
  dealii::Vector<float> material(discretization.triangulation.n_active_cells()), owner(material);
  for (const auto &cell : discretization.triangulation.active_cell_iterators())
  {
    material(cell->active_cell_index()) = static_cast<float>(cell->material_id());
    owner(cell->active_cell_index())    = static_cast<float>(cell->subdomain_id());
  }
  output.add_data_vector(material, "material", DataOut<2>::type_cell_data);
  output.add_data_vector(owner, "rank", DataOut<2>::type_cell_data);
  output.set_flags(flags);
  output.build_patches(discretization.mapping);
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
