// SPDX-License-Identifier: MIT
// Kirchhoff's plate, resolved by Clough-Tocher triangles: the deflection w that minimises
//   ½ integral kappa(w).D.kappa(w) − loads,   kappa = (w,11, w,22, 2 w,12),
// D per triangle. The triangles conform, so that the energy lies above the exact one; errors are
// O(h^4) in w and O(h^2) in kappa where w is smooth. A plate of the phases of a cell is the
// reference of bending, one of D^H the homogenized sheet, one on a glued cell the cell problem.
#pragma once

#include "homogenization/bracket/clough_tocher.h"
#include "homogenization/bracket/plate_mesh.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <array>
#include <vector>

namespace homespun::homogenization
{
/// A degree of freedom whose value is given.
struct HeldDof
{
  int dof;
  double value; ///< [m], of derivatives [-]
};

/// A plate and its degrees of freedom: w, w,1, w,2 at each vertex, 3 v + 0, 1, 2; then the
/// derivative along the normal in the middle of each side of the mesh.
class ThinPlate
{
public:
  /// Values of the twelve shapes of a triangle at a point, rows w, w,1, w,2, w,11, w,22, 2 w,12.
  using Shapes = Eigen::Matrix<double, 6, 12>;
  /// The same of a deflection.
  using Values = Eigen::Matrix<double, 6, 1>;

  /// @param bending_stiffness_of_material D [N m]
  ThinPlate(PlateMesh mesh, std::vector<Eigen::Matrix3d> bending_stiffness_of_material);

  int n_dofs() const;
  int dof_of_side(int side) const;
  std::array<int, 12> dofs_of(int triangle) const;

  /// By how much a barycentric coordinate may miss a line between pieces or triangles and be on it:
  /// coordinates of a mesh are rounded, those of macro meshes finer than a cell by more.
  static constexpr double snap = 2e-5;

  /// Where pieces of the triangle meet, across which curvatures jump, the mean of theirs.
  /// @param barycentric coordinates in the triangle
  Shapes shapes(int triangle, const Eigen::Vector3d &barycentric) const;
  Values values(int triangle, const Eigen::Vector3d &barycentric,
                const Eigen::VectorXd &deflection) const;

  double area(int triangle) const; ///< [m^2]

  /// kappa of the shapes at the field points of a triangle (equilibrated_stress.h), where products
  /// of two of them are integrated with the weight area/9.
  Eigen::Matrix<double, 27, 12> curvatures(int triangle) const;

  /// integral kappa.D.kappa of the shapes of a triangle.
  Eigen::Matrix<double, 12, 12> stiffness(int triangle) const;

  /// The first three rows of shapes() at points of a triangle.
  std::vector<Eigen::Matrix<double, 3, 12>>
  values_and_gradients(int triangle, const std::vector<WeightedPoint> &points) const;

  /// integral v, of a pressure of 1 [m^2 per m of v].
  Eigen::VectorXd pressure() const;

  /// integral kappa(v).m of moments that are constant in each triangle.
  /// @param moments_of_triangle (3,loads) [N]
  Eigen::MatrixXd of_moments(const std::vector<Eigen::MatrixXd> &moments_of_triangle) const;

  /// The deflections under loads (n_dofs,loads), with the same held degrees of freedom.
  /// @throws NotConverged where the plate moves freely
  Eigen::MatrixXd solve(const Eigen::MatrixXd &loads, const std::vector<HeldDof> &held) const;

  const PlateMesh mesh;
  const std::vector<Eigen::Matrix3d> bending_stiffness_of_material;

private:
  CloughTocher element(int triangle) const;
  Eigen::SparseMatrix<double> reduced(const std::vector<int> &unknown, int n,
                                      const Eigen::MatrixXd &held, Eigen::MatrixXd &right) const;
};

/// n n^T in the order of curvatures, 11, 22, 2 12: of a cylinder along whose normal n it curves;
/// its product with a moment is the moment across a line with that normal.
Eigen::Vector3d curvature_across(const Eigen::Vector2d &n);

/// Mean of D over the cell, holes counting as zero.
Eigen::Matrix3d mean_of_materials(const TorusMesh &mesh,
                                  const std::vector<Eigen::Matrix3d> &stiffness_of_material);

/// How a cell bends: min over periodic phi of 1/|Y| integral (K + kappa(phi)).D.(K + kappa(phi)).
struct PlateCell
{
  Eigen::Matrix3d stiffness; ///< D^H [N m]
  /// phi under K11, K22, 2 K12 (n_dofs,3), as a ThinPlate has it, of mean zero.
  Eigen::MatrixXd deflection;
};

/// Solves the cell problem; rims of holes are free.
PlateCell solve_plate_cell(const TorusMesh &mesh,
                           const std::vector<Eigen::Matrix3d> &bending_stiffness_of_material);
} // namespace homespun::homogenization
