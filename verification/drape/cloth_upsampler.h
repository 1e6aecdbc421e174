// SPDX-License-Identifier: MIT
// Up-sampling of a moving coarse cloth, whatever its element: what Upsampler reads of six-node
// triangles is the grid of coarse_space.h, on which they are evaluated every frame.
#pragma once

#include "localization/garment/placed_garment.h"
#include "verification/method/coarse_space.h"

#include <optional>
#include <utility>

namespace homespun::verification
{
/// @tparam Scalar of the fine positions
template <typename Scalar>
class ClothUpsampler
{
public:
  using Fine = typename localization::Upsampler<3, Scalar>::Fine;

  /// @throws BadInput as Upsampler
  ClothUpsampler(const meshes::HomogenizedCell &cell, const CoarseSpace &space,
                 const meshes::Sheet &fine, const localization::UpsamplerOptions &options)
      : of_grid(cell, space.grid.mesh, fine, options)
  {
    if (space.element == CoarseElement::six_nodes)
      six_nodes.emplace(space);
  }

  ClothUpsampler(const meshes::HomogenizedCell &cell, const meshes::ClothMesh &coarse,
                 const meshes::FineCloth &fine, const localization::UpsamplerOptions &options)
      : of_grid(localization::placed_garment(cell, coarse, fine, options))
  {
  }

  /// @param nodes of the coarse cloth (n,3) [m]
  /// @param fine (n_fine,3) [m]
  /// @throws BadInput as Upsampler::upsample()
  void upsample(const shell::Positions<3> &nodes, Fine &fine) const
  {
    if (six_nodes)
      of_grid.upsample(six_nodes->on_grid<3>(nodes), fine);
    else
      of_grid.upsample(nodes, fine);
  }

private:
  std::optional<CoarseSpace> six_nodes;
  localization::Upsampler<3, Scalar> of_grid;
};
} // namespace homespun::verification
