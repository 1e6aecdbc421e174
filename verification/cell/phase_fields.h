// SPDX-License-Identifier: MIT
// Strain and stress in the phases of a cell under the unit macro strains: where a cloth is loaded,
// and along what.
#pragma once

#include "homogenization/fem/homogenize.h"
#include "meshes/files/surface_files.h"

#include <Eigen/Core>

#include <vector>

namespace homespun::verification
{
/// c : (e_a − eps(chi_a)) (m,9), the membrane stresses 11, 22, 12 of each triangle under the unit
/// macro strains 11, 22, 12; their mean over the cell is C^H [N/m].
/// @param strains (m,9), as in Homogenization
homogenization::UnitStrains phase_stresses(const homogenization::UnitCell &cell,
                                           const homogenization::UnitStrains &strains);

/// The principal directions of a symmetric tensor in the plane, each as long as its principal value
/// and, where that is positive, to the right (straight up where it is vertical): rows, the larger
/// value first. One that points to the left is a compression.
/// @param components 11, 22, 12 of the tensor (of a strain half of the engineering shear)
Eigen::Matrix2d principal_vectors(const Eigen::Vector3d &components);

/// The same on the triangles for ParaView: of each macro strain the strain, the stress, and the two
/// principal vectors of each.
std::vector<meshes::VertexData> phase_field_data(const homogenization::UnitCell &cell,
                                                 const homogenization::UnitStrains &strains);
} // namespace homespun::verification
