// SPDX-License-Identifier: MIT
// homespun in one include, for programs that have moved a cloth and want its fine positions. For
// many frames keep the Upsampler, as tests/consumer/consumer.cc does: laying the cell over the
// cloth takes longer than a frame.
#pragma once

#include "localization/garment/placed_garment.h"

namespace homespun
{
/// The fine cloth of one frame.
struct UpsampledCloth
{
  localization::Upsampler<3>::Fine positions; ///< (n,3) [m]
  meshes::Triangles triangles;                ///< (m,3) vertices in space, joined at seams
  Eigen::VectorXi material;                   ///< (m) phase of the cell
};

/// The paper's localization (Eqs. 9-12) of a cloth of any outline.
/// @param V (n,3) vertices of the coarse cloth as it was moved [m]
/// @param F (m,3) its triangles
/// @param cell with chi, as meshes::read_cell() reads it
/// @param rest (n,2) the same vertices flat and at rest, the axes of the cell along x and y [m]
/// @throws BadInput naming what does not belong together
inline UpsampledCloth upsample(const meshes::SpacePoints &V, const meshes::Triangles &F,
                               const meshes::HomogenizedCell &cell, const meshes::Points &rest)
{
  const meshes::ClothMesh coarse = {{rest, F, Eigen::VectorXi::Zero(F.rows())}, V, F};
  const meshes::FineCloth fine   = meshes::fine_cloth(cell.mesh, cell.lattice, coarse);
  const localization::Upsampler<3> upsampler(localization::placed_garment(cell, coarse, fine));
  UpsampledCloth result{{}, fine.sewn_triangles(), fine.rest.material};
  upsampler.upsample(V, result.positions);
  return result;
}
} // namespace homespun
