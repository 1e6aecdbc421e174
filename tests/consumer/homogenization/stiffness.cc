// SPDX-License-Identifier: MIT
// homespun's homogenization in another program: prints C^H of a cell, row by row [N/m].
//   stiffness CELL.prm
#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_reading.h"

#include <deal.II/base/mpi.h>

#include <iostream>

int main(int argc, char **argv)
try
{
  using namespace homespun::homogenization;
  if (argc != 2)
    throw std::invalid_argument("usage: stiffness CELL.prm");
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const Homogenization result = homogenize(read_unit_cell(argv[1]), {}, MPI_COMM_WORLD);
  std::cout << result.stiffness << '\n';
}
catch (const std::exception &error)
{
  std::cerr << error.what() << '\n';
  return 2;
}
