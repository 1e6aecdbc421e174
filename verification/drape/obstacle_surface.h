// SPDX-License-Identifier: MIT
// The bodies of a scene as triangles, for pictures: what the cloth falls on is seen beside it. The
// contact itself knows exact planes and spheres (shell/contact/obstacles.h).
#pragma once

#include "meshes/files/obj_file.h"
#include "verification/drape/scene/scene.h"

#include <Eigen/Core>

namespace homespun::verification
{
/// All obstacles of a scene as one surface.
/// @param middle of the cloth, where planes are cut out [m]
/// @param size of the cloth; planes reach one and a half of it to each side [m]
/// @return without triangles where the scene has no obstacle
/// @throws BadInput where the file of a mesh cannot be read
meshes::Surface obstacle_surface(const Scene &scene, const Eigen::RowVector3d &middle, double size);
} // namespace homespun::verification
