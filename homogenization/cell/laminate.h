// SPDX-License-Identifier: MIT
// The closed form of a laminate: what C^H of a cell without corners must be, on any mesh that fits
// its layers.
#pragma once

#include "meshes/plain/lattice.h"
#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::homogenization
{
/// C^H of layers stacked along axis 2, of any anisotropy. The strain 11 and the stresses 22 and 12
/// are the same in all; with a = (22, 12), b = 11 and <> the mean,
///   C_aa = <c_aa^-1>^-1,  C_ba = <c_ba c_aa^-1> C_aa,
///   C_bb = <c_bb − c_ba c_aa^-1 c_ab> + C_ba C_aa^-1 C_ab.
/// @param layers [N/m] Voigt order 11, 22, 12 with engineering shear @param fractions of the
///   height, sum 1
/// Source: G. W. Milton, The Theory of Composites, 2002, section 9.2.
Eigen::Matrix3d laminate_stiffness(const std::vector<Eigen::Matrix3d> &layers,
                                   const std::vector<double> &fractions);

/// C^H of a cell without corners (corners.h): its interfaces are straight lines that never meet,
/// hence parallel, at any angle; or there is none.
/// @param stiffness_of_material [N/m]
Eigen::Matrix3d laminate_stiffness(const meshes::TriangleMesh &mesh, const meshes::Lattice &lattice,
                                   const std::vector<Eigen::Matrix3d> &stiffness_of_material);
} // namespace homespun::homogenization
