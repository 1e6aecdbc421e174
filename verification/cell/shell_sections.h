// SPDX-License-Identifier: MIT
// The effective stiffness of a cell as the section of a shell in other programs: membrane C^H and
// bending D^H, which do not couple in a sheet that is alike on both faces.
#pragma once

#include <Eigen/Core>

#include <string>

namespace homespun::verification
{
/// What a shell of an effective cell is made of.
struct ShellSection
{
  std::string name;         ///< of the cell
  Eigen::Matrix3d membrane; ///< C^H [N/m], Voigt order 11, 22, 12 with engineering shear
  Eigen::Matrix3d bending;  ///< D^H [N m], of kappa11, kappa22, 2 kappa12
  double areal_density;     ///< [kg/m^2]
  double thickness;         ///< mean over the cell [m]; for the mass alone
};

/// `*SHELL GENERAL SECTION` of Abaqus: 21 entries of the symmetric half of the 6 x 6 matrix of
/// (11, 22, 12, kappa11, kappa22, kappa12), column by column, eight to a line. SI units. Transverse
/// shear is left to Abaqus.
std::string abaqus_section(const ShellSection &section);

/// `ELAS_COQUE` of Code_Aster, all 33 entries, L along axis 1; RHO is the areal density over the
/// mean thickness, for EPAIS of the same value. Transverse shear, which thin elements (DKT, DKTG)
/// do not have, stands at 5/6 C66 because the keyword must be positive.
std::string aster_section(const ShellSection &section);
} // namespace homespun::verification
