// SPDX-License-Identifier: MIT
// One include, one call: a square cloth of three by three cells of the laminate of make_cell.cc. A
// rigid motion moves its fine vertices rigidly; pulled by e across the stripes, 1 to 10 in
// stiffness, their border moves by (20/11 − 1) / 2 = 9/22 of e times the cell's side.
//   one_call CELL.h5
#include <homespun/homespun.h>
#include <homespun/meshes/files/cell_file.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <stdexcept>

int main(int argc, char **argv)
try
{
  if (argc != 2)
    throw std::invalid_argument("usage: one_call CELL.h5");
  const auto cell   = homespun::meshes::read_cell(argv[1]);
  const double side = 3. * std::sqrt(cell.lattice.area());
  homespun::meshes::Points rest(4, 2);
  rest << 0., 0., side, 0., side, side, 0., side;
  homespun::meshes::Triangles F(2, 3);
  F << 0, 1, 2, 0, 2, 3;
  homespun::meshes::SpacePoints V(4, 3); // a quarter turn about x, one metre up
  V << rest.col(0), Eigen::Vector4d::Zero(), rest.col(1).array() + 1.;

  const homespun::UpsampledCloth fine = homespun::upsample(V, F, cell, rest);
  const double off                    = fine.positions.col(1).cwiseAbs().maxCoeff(),
               low                    = std::abs(fine.positions.col(2).minCoeff() - 1.),
               high                   = std::abs(fine.positions.col(2).maxCoeff() - 1. - side),
               rigid                  = std::max({off, low, high});

  const double e     = 0.01;
  const auto at_rest = homespun::upsample(V, F, cell, rest).positions;
  V.col(0) *= 1. + e;
  const auto pulled  = homespun::upsample(V, F, cell, rest).positions;
  const double moved = (pulled.col(0) - (1. + e) * at_rest.col(0)).maxCoeff() / (e * side / 3.);
  std::cout << fine.triangles.rows() << " triangles, a rigid motion off by " << rigid
            << " m, the border of stripes moved by " << moved << " e times the cell's side\n";
  return fine.triangles.rows() >= 9 * cell.mesh.n_triangles() &&
             fine.material.size() == fine.triangles.rows() && rigid < 1e-6 &&
             std::abs(moved - 9. / 22.) < 1e-3
           ? 0
           : 1;
}
catch (const std::exception &error)
{
  std::cerr << error.what() << '\n';
  return 2;
}
