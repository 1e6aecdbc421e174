// SPDX-License-Identifier: MIT
// A cloth that is curved where it is without moments: a cubic energy over the hinges of hinges.h
// (Garg et al., "Cubic shells", SCA 2007), which turns the flat rest shape of bending.h into a
// curved one.
#pragma once

#include "meshes/cloth/cloth_mesh.h"
#include "shell/membrane/plate_stiffness.h"
#include "shell/terms/term.h"

#include <memory>
#include <vector>

namespace homespun::shell
{
/// What turns the flat rest shape of bending_term() into a curved one; to be used beside it with
/// the same stiffness. Per hinge it adds −(stiffness) tan(theta0) sin(theta), sin(theta) from the
/// volume of its four vertices, a cubic of the positions (Garg et al., "Cubic shells", SCA 2007).
/// With the quadratic energy, (stiffness) (1 − cos(theta)), this is one of −cos(theta − theta0):
/// the hinge rests at theta0 against isometric motions; forces in the plane, small beside membrane
/// forces, remain. Where hinges are coupled the rest shape is met to the second order of their
/// angles.
/// @param curved_rest_positions (n,3) where the cloth is without moments; its triangles should have
///   the shapes of those at rest [m]
/// @throws BadInput as bending_term(), for positions that are not finite, and for hinges that are
///   bent by more than 80°
std::unique_ptr<Term> curved_rest_term(const meshes::ClothMesh &mesh,
                                       const std::vector<PlateStiffness> &stiffness,
                                       const Vectors &curved_rest_positions);
} // namespace homespun::shell
