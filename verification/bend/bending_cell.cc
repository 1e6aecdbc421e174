// SPDX-License-Identifier: MIT
#include "verification/bend/bending_cell.h"

#include <cmath>

namespace homespun::verification
{
BendingCell::BendingCell(const homogenization::UnitCell &cell)
    : cell(cell)
    , bending_stiffness_of_phase(cell.bending_stiffness_of_phase())
    , torus(homogenization::glued(cell.mesh, cell.lattice))
    , solved(homogenization::solve_plate_cell(torus, bending_stiffness_of_phase))
    , known(known_edges_of_plate(cell))
{
}

bool BendingCell::is_of_one_material() const
{
  // The slopes across the sides of the mesh.
  return solved.deflection.bottomRows(torus.n_edges()).cwiseAbs().maxCoeff() <
         1e-9 * std::sqrt(cell.lattice.area());
}
} // namespace homespun::verification
