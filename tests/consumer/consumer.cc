// SPDX-License-Identifier: MIT
// homespun in another program: a cloth that hangs at its highest vertices moves under gravity, and
// is up-sampled after every step.
//   consumer CELL.h5 CLOTH.obj OUTPUT.ply
#include "localization/garment/placed_garment.h"
#include "meshes/files/cell_file.h"
#include "meshes/files/obj_file.h"
#include "meshes/files/surface_files.h"
#include "meshes/garment/fine_cloth.h"
#include "shell/solver/cloth.h"
#include "shell/terms/inertial_terms.h"
#include "shell/terms/membrane_term.h"

#include <chrono>
#include <iostream>
int main(int argc, char **argv)
try
{
  using namespace homespun;
  if (argc != 4)
    throw std::invalid_argument("usage: consumer CELL.h5 CLOTH.obj OUTPUT.ply");
  const meshes::HomogenizedCell cell = meshes::read_cell(argv[1]);
  const meshes::ClothMesh garment    = meshes::read_cloth(argv[2]);
  const meshes::FineCloth fine       = meshes::fine_cloth(cell.mesh, cell.lattice, garment);
  const localization::Upsampler<3> upsampler(localization::placed_garment(cell, garment, fine));
  const double top = garment.positions.col(2).maxCoeff();
  std::vector<int> held;
  for (int v = 0; v < garment.n_vertices(); ++v)
    if (garment.positions(v, 2) > top - 1e-6)
      held.push_back(v);
  const Eigen::VectorXd masses = shell::lumped_masses(garment, {cell.areal_density});
  shell::Cloth cloth(garment.positions, masses, held);
  cloth.add(shell::membrane_term(garment, {cell.stiffness}));
  cloth.add(shell::gravity_term(masses, {0., 0., -9.81}));

  constexpr int n_steps = 100;
  using Clock           = std::chrono::steady_clock;
  std::chrono::duration<double, std::milli> stepping{0.}, upsampling{0.};
  localization::Upsampler<3>::Fine positions;
  for (int n = 0; n < n_steps; ++n)
  {
    const auto start = Clock::now();
    cloth.step(0.01);
    const auto stepped = Clock::now();
    upsampler.upsample(cloth.positions(), positions);
    stepping += stepped - start;
    upsampling += Clock::now() - stepped;
  }
  std::cout << garment.n_triangles() << " coarse triangles: " << stepping.count() / n_steps
            << " ms per step\n"
            << fine.rest.n_triangles() << " fine triangles: " << upsampling.count() / n_steps
            << " ms per up-sampling\n";
  meshes::write_ply(argv[3], positions, fine.rest.triangles);
}
catch (const std::exception &error)
{
  std::cerr << error.what() << '\n';
  return 2;
}
