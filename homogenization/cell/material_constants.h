// SPDX-License-Identifier: MIT
// The constants that a phase is made of, one by one: their values, and how its stiffness changes
// with them.
#pragma once

#include "homogenization/cell/material.h"

#include <string>
#include <vector>

namespace homespun::homogenization
{
/// E and nu are those of isotropic phases, E1, E2, nu12, G12 and the angle those of orthotropic
/// ones.
enum class MaterialConstant
{
  E,
  nu,
  E1,
  E2,
  nu12,
  G12,
  thickness,
  angle
};

/// `E`, `nu`, ... as users write them.
std::string name_of(MaterialConstant constant);

/// `Pa`, `1`, `m` or `deg`.
std::string unit_of(MaterialConstant constant);

/// Whether E1 = E2 and G12 = E/(2 (1 + nu)), to round-off.
bool is_isotropic(const Phase &phase);

/// E, nu and the thickness of an isotropic phase; all others and the thickness of an orthotropic
/// one; none of one that has layers.
std::vector<MaterialConstant> constants_of(const Phase &phase);

/// In its unit.
double value_of(const Phase &phase, MaterialConstant constant);

/// The phase with another value of a constant; an isotropic phase stays one.
Phase changed(const Phase &phase, MaterialConstant constant, double value);

/// Derivatives by a constant of plane_stress_stiffness() [N/m per unit] and bending_stiffness() [N
/// m per unit]: of Q = S^-1 with S11 = 1/E1, S22 = 1/E2, S12 = −nu12/E1, S66 = 1/G12 they are −Q dS
/// Q.
Eigen::Matrix3d plane_stress_derivative(const Phase &phase, MaterialConstant constant);
Eigen::Matrix3d bending_derivative(const Phase &phase, MaterialConstant constant);
} // namespace homespun::homogenization
