// SPDX-License-Identifier: MIT
// The panels of a garment with their edges on lattice lines of the cells that are laid over them.
#pragma once

#include "localization/panel_edges.h"
#include "meshes/cloth/cloth_mesh.h"
#include "meshes/garment/fine_cloth.h"

#include <vector>

namespace homespun::localization
{
/// The panels at rest, each turned into the frame of its cells.
meshes::TriangleMesh in_frames_of_cells(const meshes::ClothMesh &coarse,
                                        const std::vector<meshes::Grain> &grains);

/// An edge is all that an outline has of a lattice line without a gap, to outline_tolerance; what
/// is sewn is none.
/// @param fine made by meshes::fine_cloth() from that coarse cloth
std::vector<Panel> garment_panels(const meshes::ClothMesh &coarse, const meshes::FineCloth &fine);
} // namespace homespun::localization
