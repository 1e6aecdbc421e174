// SPDX-License-Identifier: MIT
// The coarse meshes of another program: the rest mesh, and whether each frame is one of it.
#pragma once

#include "localization/garment/unit_question.h"
#include "meshes/cloth/cloth_mesh.h"
#include "meshes/files/polygons.h"
#include "verification/upsample/frame_files.h"
#include "verification/upsample/upsample_options.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// The rest mesh as faces, which frames are held against, and as cloth.
struct RestMesh
{
  meshes::Polygons faces;
  meshes::ClothMesh cloth;
  localization::RestUnits units;
};

/// Reads a mesh with its positions in metres.
meshes::Polygons read_in_metres(const std::string &file, const UpsampleOptions &options);

/// @throws BadInput where it is no cloth
RestMesh read_rest(const UpsampleOptions &options);

/// @return the largest coordinate of all frames [m]
/// @throws BadInput with all that is wrong with any frame, and what has to be asked about its unit
double check_frames(const std::vector<FrameFile> &frames, const RestMesh &rest,
                    const UpsampleOptions &options);
} // namespace homespun::verification
