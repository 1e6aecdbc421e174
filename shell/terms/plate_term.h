// SPDX-License-Identifier: MIT
// Which plate a cloth has. Over hinges (bending.h) a step takes half the time, and is right
// on one kind of mesh; by edge angles (edge_angles.h) it converges on all.
#pragma once

#include "shell/terms/bending.h"
#include "shell/terms/edge_angles.h"

namespace homespun::shell
{
enum class PlateModel
{
  by_mesh, ///< hinges on a sheet without seams that is a lattice cut along one diagonal; else edge
           ///< angles
  hinges,  ///< or a refusal: the one that conserving steps can take
  edge_angles
};

/// Bending about a flat rest shape.
/// @param stiffness one per phase of mesh.rest [N m], positive definite
/// @throws BadInput as bending_term()
std::unique_ptr<Term> plate_term(const meshes::ClothMesh &mesh,
                                 const std::vector<PlateStiffness> &stiffness,
                                 PlateModel model = PlateModel::by_mesh);
} // namespace homespun::shell
