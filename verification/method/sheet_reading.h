// SPDX-License-Identifier: MIT
// What localization reads off a homogenized sheet on a coarse mesh of any fineness at the fine
// vertices: position, strain and lift, each of which an error budget turns apart from the others.
// Written apart from the Upsampler, which the budget holds to it.
#pragma once

#include "localization/coarse_frames.h"
#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/sheet.h"
#include "verification/law/laws.h"
#include "verification/method/coarse_model.h"
#include "verification/periodic_cell/nonlinear_cell.h"

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

class SheetReading
{
public:
  /// @param sheet to be kept by the caller
  /// @param quads of the coarse mesh
  SheetReading(const meshes::Sheet &sheet, Quads quads);

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
                              const SheetReading &coarser) const;

  /// Equilibrium with the stress C e + S'(e), S' the excess over the linear theory: Newton's method
  /// with the Hessian of the homogenized law at `start`, which converges linearly since that is
  /// near.
  /// @param law of the reference
  /// @param load not one of an infinite cloth
  /// @param start in equilibrium without the excess (n,2) [m]
  /// @throws NotConverged
  shell::Positions<2> with_excess(Law law, const Eigen::Matrix3d &stiffness, const Load &load,
                                  const NonlinearLocalization &excess,
                                  const shell::Positions<2> &start) const;

private:
  /// Strain (3), lift row by row (4).
  using FrameRows = Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor>;
  std::vector<Eigen::Matrix2d> gradients(const shell::Positions<2> &positions) const;
  /// Frames of vertices from frames of triangles, weighted by rest area.
  FrameRows blended(Law law, const std::vector<Eigen::Matrix2d> &gradient_of_triangle) const;
  /// Rows of vertices, linear in the triangles, at the fine vertices.
  template <typename Rows>
  Rows sampled(const Rows &of_vertices) const;

  const meshes::Sheet &sheet;
  const int n1, n2; ///< quads
  const meshes::TriangleMesh mesh;
  std::vector<int> triangle;            ///< that holds a fine vertex
  std::vector<Eigen::Vector3d> weights; ///< of its corners
};
} // namespace homespun::verification
