// SPDX-License-Identifier: MIT
// What homogenization hands to the runtime: the cell, its characteristic displacements, its
// effective stiffness and its mass. Plain data; cell_file.h stores it.
#pragma once

#include "meshes/plain/lattice.h"
#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <string>

namespace homespun::meshes
{
/// Characteristic displacements, one vertex per row. Column 2 a + c holds component c of chi_a,
/// a = 0, 1, 2 for the unit macro strains 11, 22, 12 (engineering shear). Shape (n,6) [m].
using Chi = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// A homogenized periodic unit cell. Voigt order 11, 22, 12 with engineering shear.
///
/// Sign of chi: the total displacement under the macro strain E is E·y + w with
/// w = −(E11 chi_11 + E22 chi_22 + gamma12 chi_12) (paper Eq. 9). chi is anchored: zero at the
/// vertex `anchor` and its images, the lattice points.
struct HomogenizedCell
{
  TriangleMesh mesh;
  Lattice lattice;
  Chi chi;                                             ///< (n,6) [m]
  int anchor                = 0;                       ///< vertex where chi = 0
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero(); ///< C^H [N/m]
  double areal_density      = 0.;                      ///< [kg/m^2]
  std::string provenance;                              ///< how it was made, one line
};
} // namespace homespun::meshes
