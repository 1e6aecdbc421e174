// SPDX-License-Identifier: MIT
// A garment, as an Upsampler takes it: vertices in space are gathered to the rest vertices of the
// panels, so that each panel has strains in its own rest frame and averages over its own triangles
// only: the cell's own, turned by the grain, so that strains are those of the cell and its modes
// are taken as they are. Where an outline cuts a cell they are interpolated. They fade to zero at
// seams (not at free edges): there both sides lie on the same coarse edge, and the seam stays
// closed.
#pragma once

#include "localization/upsampler.h"
#include "meshes/cloth/cloth_mesh.h"
#include "meshes/garment/fine_cloth.h"

namespace homespun::localization
{
/// Places the fine cloth of a garment on its coarse cloth.
/// @param cell homogenized cell whose modes are superposed; its stiffness is not used
/// @param coarse panels at rest and how they are sewn; its positions are not used
/// @param fine made by meshes::fine_cloth() from that cell and that coarse cloth
/// @throws BadInput where the coarse cloth has faults, the three do not belong together, or options
///   contradict each other
PlacedVertices placed_garment(const meshes::HomogenizedCell &cell, const meshes::ClothMesh &coarse,
                              const meshes::FineCloth &fine, const UpsamplerOptions &options = {});
} // namespace homespun::localization
