// SPDX-License-Identifier: MIT
// What terms share that act in each triangle of a membrane by itself.
#pragma once

#include "shell/algebra/index.h"
#include "shell/algebra/triangle_slots.h"
#include "shell/membrane/membrane.h"
#include "shell/terms/term.h"

#include <utility>
#include <vector>

namespace homespun::shell
{
/// A term with the blocks of the corners of each triangle.
class TriangleTerm : public Term
{
public:
  explicit TriangleTerm(Membrane &&membrane)
      : membrane(std::move(membrane))
  {
  }

  void couple(std::vector<std::array<int, 2>> &pairs) const override
  {
    couple_corners(membrane.triangles, pairs);
  }

  void attach(const BlockMatrix &matrix) override
  {
    places = places_of(membrane.triangles, matrix);
  }

protected:
  int n_triangles() const
  {
    return static_cast<int>(membrane.triangles.rows());
  }

  std::size_t phase_of(const int t) const
  {
    return index(membrane.phase[index(t)]);
  }

  Eigen::Matrix3d corners_of(const Vectors &positions, const int t) const
  {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k)
      corners.row(k) = positions.row(membrane.triangles(t, k));
    return corners;
  }

  /// @param forces on the corners, one per row
  template <typename Forces>
  void add_forces(const int t, const Forces &forces, Vectors &gradient) const
  {
    for (int k = 0; k < 3; ++k)
      gradient.row(membrane.triangles(t, k)) += forces.row(k);
  }

  void add(const int t, const TriangleDerivatives<3> &local, Vectors &gradient,
           BlockMatrix &matrix) const
  {
    add_forces(t, local.gradient, gradient);
    for (std::size_t b = 0; b < 6; ++b)
      matrix.add(places[index(t)][b], local.blocks[b]);
  }

  const Membrane membrane;
  std::vector<TriangleSlots> places; ///< (m)
};
} // namespace homespun::shell
