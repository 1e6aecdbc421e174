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
  int size = 0;                                         ///< rows, padding included

  /// @param barycentric coordinates in the coarse triangle
  /// @param modes of the cell at the vertex: the six columns of chi, and where they are taken the
  ///   twelve of the quadratic modes, those of equal strains halved, or of the fitted ones [m]
  template <typename ModesRow>
  void append(const Eigen::Vector3d &barycentric, const ModesRow &modes)
  {
    bool is_quadratic = false;
    if constexpr (ModesRow::ColsAtCompileTime == Eigen::Dynamic)
      is_quadratic = modes.size() > 6;
    if (size % lanes == 0)
    {
      weights.push_back({});
      chi_blocks.push_back({});
      if (is_quadratic)
        quadratic_blocks.push_back({});
    }
    const int lane               = size++ % lanes;
    weights.back().corner1[lane] = static_cast<Scalar>(barycentric(1));
    weights.back().corner2[lane] = static_cast<Scalar>(barycentric(2));
    for (int k = 0; k < 6; ++k)
      chi_blocks.back().column[k][lane] = static_cast<Scalar>(-modes(k));
    if constexpr (ModesRow::ColsAtCompileTime == Eigen::Dynamic)
      for (int k = 0; is_quadratic && k < 12; ++k)
        quadratic_blocks.back().column[k][lane] = static_cast<Scalar>(-modes(6 + k));
  }

  /// Ends a group.
  void pad()
  {
    size = (size + lanes - 1) / lanes * lanes;
  }
};
} // namespace homespun::localization
