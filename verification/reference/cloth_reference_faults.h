// SPDX-License-Identifier: MIT
// What a resolved cloth cannot be made of.
#pragma once

#include "meshes/plain/triangle_mesh.h"
#include "verification/reference/cloth_reference_options.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace homespun::verification
{
/// Each fault as a sentence; empty where the input is sound.
std::vector<std::string> faults_of_cloth(const meshes::TriangleMesh &rest,
                                         const std::vector<Eigen::Matrix3d> &stiffness,
                                         const std::vector<double> &density,
                                         const ClothReferenceOptions &options);
} // namespace homespun::verification
