// SPDX-License-Identifier: MIT
#include "homogenization/fem/solution_pieces.h"

#include "homogenization/fem/elastic_solver.h"
#include "meshes/files/surface_files.h"
#include "meshes/plain/errors.h"

#include <deal.II/base/mpi.h>

#include <exception>
#include <filesystem>
#include <system_error>
#include <unordered_map>
#include <vector>

namespace homespun::homogenization
{
namespace
{
std::string file_of_piece(const std::string &name, const unsigned int rank)
{
  return name + "-" + std::to_string(rank) + ".vtu";
}

constexpr std::array<const char *, 3> names = {"chi_11 [m]", "chi_22 [m]", "chi_12 [m]"};

/// The triangles of this rank, with vertices of their own.
struct Piece
{
  Piece(const Discretization &discretization, const std::array<ElasticSolver::Vector, 3> &solutions)
  {
    const meshes::TriangleMesh &mesh = discretization.mesh;
    std::unordered_map<int, int> place_of; // by vertex of the whole mesh
    std::vector<int> corners, triangle_of_cell;
    std::vector<std::array<double, 8>> at; // x, y, chi of the three loads
    std::vector<dealii::types::global_dof_index> dofs(discretization.element.n_dofs_per_cell());
    for (const auto &cell : discretization.dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      const auto t = static_cast<int>(Discretization::triangle_of(cell));
      cell->get_dof_indices(dofs);
      for (int k = 0; k < 3; ++k)
      {
        const int v                = mesh.triangles(t, k);
        const auto [place, is_new] = place_of.emplace(v, static_cast<int>(at.size()));
        if (is_new)
        {
          at.push_back({mesh.vertices(v, 0), mesh.vertices(v, 1)});
          for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t c = 0; c < 2; ++c)
              at.back()[2 + 2 * a + c] = solutions[a](dofs[2 * static_cast<std::size_t>(k) + c]);
        }
        corners.push_back(place->second);
      }
      triangle_of_cell.push_back(t);
    }
    const auto n = static_cast<Eigen::Index>(at.size()),
               m = static_cast<Eigen::Index>(triangle_of_cell.size());
    positions.setZero(n, 3);
    for (const char *name : names)
      chi.push_back({name, meshes::FloatPoints::Zero(n, 3)});
    for (Eigen::Index v = 0; v < n; ++v)
      for (Eigen::Index c = 0; c < 2; ++c)
      {
        const std::array<double, 8> &its = at[static_cast<std::size_t>(v)];
        positions(v, c)                  = static_cast<float>(its[static_cast<std::size_t>(c)]);
        for (std::size_t a = 0; a < 3; ++a)
          chi[a].values(v, c) = static_cast<float>(its[2 + 2 * a + static_cast<std::size_t>(c)]);
      }
    triangles = Eigen::Map<const meshes::Triangles>(corners.data(), m, 3);
    Eigen::VectorXf material(m);
    for (Eigen::Index t = 0; t < m; ++t)
      material(t) =
        static_cast<float>(mesh.material(triangle_of_cell[static_cast<std::size_t>(t)]));
    of_triangles = {{"material", material},
                    {"rank", Eigen::VectorXf::Constant(
                               m, static_cast<float>(dealii::Utilities::MPI::this_mpi_process(
                                    discretization.communicator)))}};
  }

  meshes::FloatPoints positions;
  meshes::Triangles triangles;
  std::vector<meshes::VertexData> chi, of_triangles;
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
  using namespace dealii::Utilities::MPI;
  const unsigned int rank = this_mpi_process(discretization.communicator);
  std::string fault;
  try
  {
    const Piece piece(discretization, solutions);
    meshes::write_vtu(file_of_piece(name, rank), piece.positions, piece.triangles, piece.chi,
                      piece.of_triangles);
    if (rank == 0)
    {
      std::vector<std::string> files;
      for (unsigned int r = 0; r < n_mpi_processes(discretization.communicator); ++r)
        files.push_back(std::filesystem::path(file_of_piece(name, r)).filename().string());
      meshes::write_pvtu(name + ".pvtu", files, piece.chi, piece.of_triangles);
    }
  }
  catch (const std::exception &failure) // any: the other ranks wait below
  {
    fault = failure.what();
  }
  if (max(fault.empty() ? 0 : 1, discretization.communicator) == 1)
    throw meshes::BadInput(fault.empty() ? "another rank could not write its piece" : fault);
}
} // namespace homespun::homogenization
