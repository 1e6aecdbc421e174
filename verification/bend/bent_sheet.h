// SPDX-License-Identifier: MIT
// How far an up-sampled sheet that bends is from the resolved one, in linear theory. With k the
// root mean square of the macro curvature and eps = sqrt(|Y|), a fluctuation of the deflection has
// the size of k eps², one of the normal that of k eps.
#pragma once

#include "verification/bend/bending_cell.h"
#include "verification/bend/plate_sheet.h"

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace homespun::verification
{
/// The ways to up-sample a bent sheet: the homogenized deflection w0 alone, with w3 = K_a w_a of
/// the cell, with the terms of edges w1, with both and the layers at edges; last w0 at the corners
/// of two flat triangles per cell. The macro problem is the same of all.
inline constexpr std::array<const char *, 5> bending_methods = {"affine", "localized",
                                                                "affine+edges", "full", "flat"};

/// Whether a method has terms of edges.
bool has_edges(const std::string &method);

/// At each vertex of a sheet the position [m] and the unit normal, or differences of them.
using BentState = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// Its distances in position [m] and normal [rad], of a difference.
Eigen::VectorXd position_errors(const BentState &difference);
Eigen::VectorXd normal_errors(const BentState &difference);

/// Means over the vertices of a sheet.
struct BendingError
{
  double position = 0.; ///< [m]
  double normal   = 0.; ///< [rad]
};

BendingError mean_of(const BentState &difference);

/// The coarse mesh that flat triangles have, two per cell.
meshes::TriangleMesh coarse_mesh(const meshes::Sheet &sheet);

/// Flat triangles at the vertices of a sheet.
/// @param corners positions of the vertices of coarse_mesh() (n,3)
/// @return with normals of twice the length of the triangles' areas
BentState flat_triangles(const meshes::Sheet &sheet, const Eigen::MatrixX3d &corners);

/// Quads of the homogenized sheet along a side of a cell, even: at least 80 along one of the sheet,
/// since its clamps and corners need as many whatever the number of cells.
int macro_quads_per_cell(int n_cells);

/// A sheet bent to a macro curvature of which the root mean square is 1/m.
struct BentSheet
{
  /// A sheet of n x n cells; the homogenized one on a mesh of two triangles to a quad.
  /// @param quads_per_cell along a side; n times that is even
  BentSheet(const BendingCell &cell, const BendingLoad &load, int n, int quads_per_cell);

  template <typename Value>
  using OfMethods = std::array<Value, bending_methods.size()>;

  meshes::Sheet sheet;
  /// Up-sampled less resolved; empty of methods with terms of edges where those are not known.
  OfMethods<BentState> error_of_method;
  OfMethods<BendingError> of_macro_mesh; ///< by how much halved quads change its means
  double unit_load         = 0.;         ///< that bends it so, of the load's unit times m
  double deflection        = 0.;         ///< mean over the vertices of the resolved sheet [m]
  unsigned long n_dofs     = 0;          ///< of the reference
  int n_macro_triangles    = 0;
  double seconds           = 0.; ///< of the homogenized sheets and all methods
  double seconds_reference = 0.;
};
} // namespace homespun::verification
