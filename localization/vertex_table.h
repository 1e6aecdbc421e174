// SPDX-License-Identifier: MIT
// What up-sampling keeps of each fine vertex: where it lies in its coarse triangle, and its
// chi_blocks. Private to upsampler.
#pragma once

#include "localization/kernel.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::localization
{
/// Constants per vertex, in groups padded to whole blocks of lanes.
template <typename Scalar>
struct VertexTable
{
  std::vector<Weights<Scalar>> weights;
  std::vector<ChiBlock<Scalar>> chi_blocks;
  std::vector<QuadraticBlock<Scalar>> quadratic_blocks; ///< empty where all modes are linear
  std::vector<ChiBlock<Scalar>> free_blocks; ///< empty but with fitted_modes_and_free_edges
  std::vector<DeflectionBlock<Scalar>> deflection_blocks; ///< empty but of curved surfaces
  std::vector<ChiBlock<Scalar>> slope_blocks;             ///< the same
  int size = 0;                                           ///< rows, padding included

  /// @param barycentric coordinates in the coarse triangle
  /// @param modes of the cell at the vertex: the six columns of chi, and where they are taken the
  ///   twelve of the quadratic modes, those of equal strains halved, or of the fitted ones, and
  ///   with these what free edges take off chi, six [m]
  template <typename ModesRow>
  void append(const Eigen::Vector3d &barycentric, const ModesRow &modes)
  {
    bool is_quadratic = false, is_free = false;
    if constexpr (ModesRow::ColsAtCompileTime == Eigen::Dynamic)
    {
      is_quadratic = modes.size() > 6;
      is_free      = modes.size() > 18;
    }
    if (size % lanes == 0)
    {
      weights.push_back({});
      chi_blocks.push_back({});
      if (is_quadratic)
        quadratic_blocks.push_back({});
      if (is_free)
        free_blocks.push_back({});
    }
    const int lane               = size++ % lanes;
    weights.back().corner1[lane] = static_cast<Scalar>(barycentric(1));
    weights.back().corner2[lane] = static_cast<Scalar>(barycentric(2));
    for (int k = 0; k < 6; ++k)
      chi_blocks.back().column[k][lane] = static_cast<Scalar>(-modes(k));
    if constexpr (ModesRow::ColsAtCompileTime == Eigen::Dynamic)
    {
      for (int k = 0; is_quadratic && k < 12; ++k)
        quadratic_blocks.back().column[k][lane] = static_cast<Scalar>(-modes(6 + k));
      for (int k = 0; is_free && k < 6; ++k)
        free_blocks.back().column[k][lane] = static_cast<Scalar>(-modes(18 + k));
    }
  }

  /// What a vertex that was appended has of a curved surface.
  /// @param deflection per unit curvature (3) [m^2], then the slopes of w_a, column 2 a + c (6) [m]
  void append_deflection(const Eigen::Matrix<double, 1, 9> &deflection)
  {
    const int lane = (size - 1) % lanes;
    if (lane == 0)
    {
      deflection_blocks.push_back({});
      slope_blocks.push_back({});
    }
    for (int k = 0; k < 3; ++k)
      deflection_blocks.back().column[k][lane] = static_cast<Scalar>(deflection(k));
    for (int k = 0; k < 6; ++k)
      slope_blocks.back().column[k][lane] = static_cast<Scalar>(deflection(3 + k));
  }

  /// The constants from a row on with which a block begins.
  /// @param chi, free that are taken: those of the table, or others of the same vertices
  Blocks<Scalar> from(const int row, const std::vector<ChiBlock<Scalar>> &chi,
                      const std::vector<ChiBlock<Scalar>> &free) const
  {
    const auto block     = static_cast<std::size_t>(row / lanes);
    const auto beginning = [block](const auto &blocks)
    { return blocks.empty() ? nullptr : blocks.data() + block; };
    return {beginning(weights),           beginning(chi),
            beginning(quadratic_blocks),  beginning(free),
            beginning(deflection_blocks), beginning(slope_blocks)};
  }

  /// Ends a group.
  void pad()
  {
    size = (size + lanes - 1) / lanes * lanes;
  }
};
} // namespace homespun::localization
