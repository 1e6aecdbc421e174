// SPDX-License-Identifier: MIT
// Writes a cell file without homogenization: stripes of equal width across axis 1, 1 cm wide, whose
// characteristic displacements and stiffness are those of the laminate in closed form. D is the
// stiffness of a phase, <.> the mean over the cell:
//   C11 = 1/<1/D11>,  C12 = C11 <D12/D11>,  C22 = <D22 − D12²/D11> + C12²/C11,  C33 = 1/<1/D33>,
//   chi_11' = 1 − C11/D11,  chi_22' = (D12 − C12)/D11,  chi_12' = 1 − C33/D33 (component 2).
#include "meshes/files/cell_file.h"
#include "tests/meshes/plain/shapes.h"

#include <iostream>

int main(int argc, char **argv)
try
{
  using namespace homespun;
  if (argc != 2)
    throw std::invalid_argument("usage: make_cell CELL.h5");
  constexpr int n     = 8; // intervals per side, so that the stripes' border is a line of the mesh
  constexpr double nu = 0.3, side = 0.01;
  const Eigen::Array2d D11 = Eigen::Array2d(500., 5000.) / (1. - nu * nu); // soft, hard [N/m]
  const Eigen::Array2d D12 = nu * D11, D22 = D11, D33 = 0.5 * (1. - nu) * D11;

  meshes::HomogenizedCell cell;
  cell.lattice       = tests::square_lattice(side);
  cell.mesh          = tests::parallelogram(cell.lattice, n, n);
  cell.areal_density = 0.2;
  cell.provenance    = "two stripes, the laminate in closed form";
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
  {
    double x = 0.;
    for (int corner = 0; corner < 3; ++corner)
      x += cell.mesh.vertices(cell.mesh.triangles(t, corner), 0) / 3.;
    cell.mesh.material(t) = x < 0.5 * side ? 0 : 1;
  }

  const double C11 = 1. / D11.inverse().mean(), C12 = C11 * (D12 / D11).mean(),
               C22 = (D22 - D12.square() / D11).mean() + C12 * C12 / C11,
               C33 = 1. / D33.inverse().mean();
  cell.stiffness << C11, C12, 0., C12, C22, 0., 0., 0., C33;
  // The slopes of both stripes are opposite, as chi is periodic: a tent of the soft stripe's slope.
  const double slope_11 = 1. - C11 / D11(0), slope_22 = (D12(0) - C12) / D11(0),
               slope_12 = 1. - C33 / D33(0);
  cell.chi.setZero(cell.mesh.n_vertices(), 6);
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
  {
    const double x = cell.mesh.vertices(v, 0), tent = std::min(x, side - x);
    cell.chi(v, 0) = slope_11 * tent;
    cell.chi(v, 2) = slope_22 * tent;
    cell.chi(v, 5) = slope_12 * tent;
  }
  meshes::write_cell(cell, argv[1]);
}
catch (const std::exception &error)
{
  std::cerr << error.what() << '\n';
  return 2;
}
