// SPDX-License-Identifier: MIT
// How far an up-sampled sheet that bends is from the resolved one, in linear theory. With k the
// root mean square of the macro curvature and eps = sqrt(|Y|), a fluctuation of the deflection has
// the size of k eps², one of the normal that of k eps.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/cell/cell_edges.h"
#include "verification/converge/plate_sheet.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace homespun::verification
{
/// The ways to up-sample a bent sheet: the homogenized deflection w0 alone, with w3 = K_a phi_a of
/// the cell, with the terms of edges w1, with both.
inline constexpr std::array<const char *, 4> bending_methods = {"affine", "localized",
                                                                "affine+edges", "full"};

/// A cell as it bends: phi_a, D^H, and its edges or why they are not known.
struct BendingCell
{
  explicit BendingCell(const homogenization::UnitCell &cell);

  /// Whether its deflections are zero to round-off.
  bool is_of_one_material() const;

  const homogenization::UnitCell &cell;
  std::vector<Eigen::Matrix3d> bending_stiffness_of_phase;
  homogenization::TorusMesh torus;
  homogenization::PlateCell solved;
  KnownEdges known; ///< edges of its plate
};

/// Means over the vertices of a sheet.
struct BendingError
{
  double position; ///< |w − w_reference| [k eps²]
  double normal;   ///< |grad w − grad w_reference| [k eps]
};

struct BentSheetErrors
{
  std::array<BendingError, bending_methods.size()> of_method; ///< without edges the last two lack
  /// By how much halved quads change the deflection's error with all terms [k eps²].
  double of_macro_mesh = 0.;
  unsigned long n_dofs = 0; ///< of the reference
};

/// A sheet of n x n cells; the homogenized one on a mesh of two triangles to a quad.
/// @param quads_per_cell along a side, even
BentSheetErrors bending_errors(const BendingCell &cell, const BendingLoad &load, int n,
                               int quads_per_cell);
} // namespace homespun::verification
