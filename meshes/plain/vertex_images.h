// SPDX-License-Identifier: MIT
#pragma once

#include "meshes/plain/lattice.h"

#include <vector>

namespace homespun::meshes
{
/// match_images() of some vertices of a mesh; of the classes of all its vertices (n) those of the
/// others hold themselves alone. The representative is the one that stands first in `some`.
ImageClasses match_images(const TriangleMesh &mesh, const std::vector<int> &some,
                          const Lattice &lattice);
} // namespace homespun::meshes
