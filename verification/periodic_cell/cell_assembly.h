// SPDX-License-Identifier: MIT
// One cell of an infinite cloth, P1 displacements on its mesh: y -> F y + w(y) with w periodic and
// zero at the anchor. Energy, forces and tangent by w and by the macroscopic gradient F. Eigen
// alone, written apart from the resolved reference.
#pragma once

#include "meshes/plain/homogenized_cell.h"
#include "verification/law/laws.h"
#include "verification/newton/tangent.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <vector>

namespace homespun::verification
{
/// Derivatives by F are in the order F11, F12, F21, F22.
class CellAssembly
{
public:
  /// @param cell whose mesh, lattice and anchor are used
  /// @param stiffness_of_phase (3,3) [N/m]
  CellAssembly(meshes::HomogenizedCell cell, std::vector<Eigen::Matrix3d> stiffness_of_phase,
               Law law);

  using Sparse = Eigen::SparseMatrix<double>;

  /// Means over the cell, of 1/|Y| integral W(F + grad w).
  struct Sums
  {
    double energy         = 0.; ///< [N/m]; infinite where a triangle is turned over under green
    Eigen::Vector4d force = Eigen::Vector4d::Zero(); ///< by F: the mean nominal stress P [N/m]
    Eigen::VectorXd residual;                        ///< by the unknowns of w [N/m^2]
    double force_size       = 0.;                    ///< of the residuals of all triangles
    double stress_size      = 0.;                    ///< mean of |P| [N/m]
    double energy_round_off = 0.; ///< what rounded gradients do to the energy at most
    double stress_round_off = 0.; ///< and to the mean stress at most [N/m]
    double round_off        = 0.; ///< norm of what they do to the forces of the triangles
    Sparse matrix;                ///< by w twice
    Eigen::Matrix<double, Eigen::Dynamic, 4> coupling;       ///< by w and F
    Eigen::Matrix4d macro_tangent = Eigen::Matrix4d::Zero(); ///< by F twice, w held [N/m]
  };
  Sums sums(const Eigen::Matrix2d &F, const meshes::Points &w, Tangent tangent) const;

  /// The second derivative of the energy of one cell by the positions of all its vertices, none
  /// tied to its images and none held: (2n,2n), two components a vertex, divided by |Y| [N/m^3].
  /// Rows of every triangle, so that its pattern is that of the mesh whatever the state.
  Sparse vertex_tangent(const Eigen::Matrix2d &F, const meshes::Points &w) const;

  /// The unknowns at the vertices of the cell.
  meshes::Points spread(const Eigen::VectorXd &unknowns) const;

  int size() const
  {
    return n_unknowns;
  }

  const meshes::HomogenizedCell cell;
  const std::vector<Eigen::Matrix3d> stiffness_of_phase;
  const Law law;

private:
  std::vector<int> unknown; ///< (n) first unknown of a vertex, −1 at the anchor
  std::vector<Eigen::Matrix<double, 3, 2>> hats; ///< gradients of the hats of each triangle [1/m]
  Eigen::VectorXd areas;                         ///< [m^2]
  int n_unknowns = 0;
};
} // namespace homespun::verification
