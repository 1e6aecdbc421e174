// SPDX-License-Identifier: MIT
// The motions of a sheet without strain, which multigrid must know of.
#pragma once

#include "homogenization/fem/discretization.h"

#include <vector>

namespace homespun::homogenization
{
/// The translations and, in the plane, the rotation about the centre, mode after mode, on the owned
/// DoFs. The rotation is scaled by the size of the mesh so that the modes do not depend on the unit
/// of length.
std::vector<double> rigid_body_modes(const Discretization &discretization);
} // namespace homespun::homogenization
