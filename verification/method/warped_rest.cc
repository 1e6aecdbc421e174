// SPDX-License-Identifier: MIT
#include "verification/method/warped_rest.h"

#include "meshes/cloth/cloth_mesh.h"
#include "meshes/plain/errors.h"
#include "shell/solver/cloth.h"
#include "shell/terms/membrane_term.h"
#include "shell/terms/warping.h"

#include <cmath>

namespace homespun::verification
{
shell::Positions<2> warped_rest(const meshes::TriangleMesh &coarse,
                                const meshes::HomogenizedCell &cell,
                                const shell::Positions<2> &start, const std::vector<int> &held)
{
  Eigen::Matrix<double, 3, 2> flat = Eigen::Matrix<double, 3, 2>::Identity();
  const meshes::ClothMesh mesh     = meshes::placed_sheet(coarse, flat, Eigen::RowVector3d::Zero());
  const Eigen::VectorXd masses =
    shell::lumped_masses(mesh, std::vector<double>{cell.areal_density});
  shell::Vectors positions = shell::Vectors::Zero(start.rows(), 3);
  positions.leftCols<2>()  = start;
  shell::Cloth cloth(positions, masses, held);
  cloth.add(shell::nodal_warping_term(mesh, {cell.stiffness}, masses));
  const double side = std::sqrt(cell.lattice.area());
  std::vector<double> history;
  for (int step = 0; step < 500; ++step)
  {
    const shell::Vectors before = cloth.positions();
    cloth.step(1.);
    const shell::Vectors after = cloth.positions();
    cloth.set_state(after, shell::Vectors::Zero(after.rows(), 3), 0.);
    history.push_back((after - before).rowwise().norm().maxCoeff());
    if (history.back() <= 1e-7 * side)
      return after.leftCols<2>();
  }
  throw meshes::NotConverged("nodal warping: the cloth does not come to rest", history);
}
} // namespace homespun::verification
