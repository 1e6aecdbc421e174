// SPDX-License-Identifier: MIT
// How a cell lies on the panels of a garment, and what becomes of its triangles at their outlines.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <vector>

namespace homespun::meshes
{
/// How the cells lie on a panel.
struct Grain
{
  Eigen::RowVector2d origin = {0., 0.}; ///< rest point that is a lattice point [m]
  double angle              = 0.; ///< of the cell's first axis against the first rest axis [rad]

  /// From the cell's frame into the panel's.
  Eigen::Matrix2d rotation() const
  {
    Eigen::Matrix2d matrix;
    matrix << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    return matrix;
  }
};

/// What becomes of the fine triangles that an outline crosses.
enum class Outline
{
  clipped, ///< cut: the fine cloth covers every panel exactly, and the seams close
  whole    ///< left out: every triangle is one of the cell's, the outline is jagged, the seams gape
};

struct FineClothOptions
{
  std::vector<Grain> grains = {Grain()}; ///< one for all panels, or one per panel
  Outline outline           = Outline::clipped;
};

/// Up to which distance seam_distance is known, in cell sides sqrt(|Y|).
constexpr double seam_reach = 4.;

/// A fine vertex nearer than this to the outline is moved onto it, in cell sides: above the digits
/// of the usual files, far below any triangle of a cell.
constexpr double outline_tolerance = 1e-6;
} // namespace homespun::meshes
