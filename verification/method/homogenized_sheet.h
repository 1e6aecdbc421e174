// SPDX-License-Identifier: MIT
// The homogenized sheet on a coarse mesh of any fineness, and what localization reads off it at the
// fine vertices: position, strain and lift, each of which an error budget turns apart from the
// others.
#pragma once

#include "localization/coarse_frames.h"
#include "localization/options.h"
#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/sheet.h"
#include "verification/method/sheet_solvers.h"
#include "verification/periodic_cell/nonlinear_cell.h"
#include "verification/reference/laws.h"
#include "verification/reference/loads.h"

#include <memory>
#include <vector>

namespace homespun::verification
{
/// What x = P + L w asks for at every fine vertex.
struct LocalState
{
  meshes::Points positions; ///< P (n,2) of the coarse motion [m]
  Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor>
    frames; ///< strain (3), lift row by row (4) [-]
};

/// P + L w with w = −(E11 chi_11 + E22 chi_22 + gamma12 chi_12), chi zero at the lattice points.
/// @param excess what is added to w (null: nothing)
meshes::Points localized(const LocalState &state, const meshes::HomogenizedCell &cell,
                         const meshes::Sheet &sheet, const NonlinearLocalization *excess = nullptr);

/// A sheet with one stiffness, cut into n1 x n2 quads of two triangles.
class HomogenizedSheet
{
public:
  HomogenizedSheet(const Eigen::Matrix3d &stiffness, const meshes::Sheet &sheet, const Load &load,
                   int n1, int n2);

  /// The affine motion that agrees with what is prescribed: of periodic loads the answer.
  shell::Positions<2> prescribed(double strain) const;

  /// Positions whose held rows are the prescribed ones.
  shell::Positions<2> with_held(shell::Positions<2> positions, double strain) const;

  /// Equilibrium under the homogenized law of a reference: small strain, or from `start`.
  /// @param start (n,2) [m]; its held rows are the prescribed ones
  /// @param iterations receives the Newton steps, if not null
  /// @throws NotConverged
  shell::Positions<2> solve(Law law, const shell::Positions<2> &start,
                            const shell::EquilibriumOptions &options = {},
                            int *iterations                          = nullptr) const;

  /// Equilibrium with the stress C e + S'(e), S' the excess over the linear theory: Newton's method
  /// with the Hessian of the homogenized law at `start`, which converges linearly since that is
  /// near.
  /// @param law of the reference
  /// @throws NotConverged
  shell::Positions<2> solve(Law law, const NonlinearLocalization &excess,
                            const shell::Positions<2> &start) const;

  /// Strain of every triangle, (m,3).
  Eigen::Matrix<double, Eigen::Dynamic, 3> strains(Law law,
                                                   const shell::Positions<2> &positions) const;

  /// Positions, strain and lift at the fine vertices: averaged to the coarse vertices, linear in
  /// between.
  LocalState at_fine_vertices(Law law, const shell::Positions<2> &positions) const;

  /// The same, but with strain and lift of the mean deformation gradient over each triangle of a
  /// coarser mesh, averaged to its vertices and linear there, as if that mesh carried this
  /// solution.
  /// @param coarser whose quads are each cut into r x r of this sheet
  LocalState at_fine_vertices(Law law, const shell::Positions<2> &positions,
                              const HomogenizedSheet &coarser) const;

  const meshes::TriangleMesh mesh;

private:
  std::vector<Eigen::Matrix2d> gradients(const shell::Positions<2> &positions) const;
  /// Frames of vertices from frames of triangles, weighted by rest area.
  Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor>
  blended(Law law, const std::vector<Eigen::Matrix2d> &gradient_of_triangle) const;
  /// Rows of vertices, linear in the triangles, at the fine vertices.
  template <typename Rows>
  Rows sampled(const Rows &of_vertices) const;

  const meshes::Sheet &sheet;
  const Load load;
  const int n1, n2;
  const std::vector<int> held;
  std::unique_ptr<SheetSolvers<>> solvers; ///< they do not exist under periodic loads
  std::vector<int> triangle;               ///< that holds a fine vertex
  std::vector<Eigen::Vector3d> weights;    ///< of its corners
};
} // namespace homespun::verification
