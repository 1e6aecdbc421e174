// SPDX-License-Identifier: MIT
// Whether a level of a study is one that its law is made for: which triangles of the resolved sheet
// and of the coarse cloth have lost ellipticity (laws/ellipticity.h), and from which strain on.
// Beyond it no minimiser need exist, so that the distance between two cloths says little of either.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/strain/compared_level.h"

#include <string>
#include <vector>

namespace homespun::verification
{
/// The part of a row that stands for the coarse cloth; the others are names of phases.
constexpr const char *coarse_cloth_part = "coarse cloth";

/// Writes a row for each group of phases of a resolved level, and a note where triangles are lost.
/// Of the law `linear`, whose tangent never changes, nothing.
/// @param cell of the sheet; its phases of one name are one group
void write_ellipticity(const StrainLevel &level, const ResolvedLevel &resolved,
                       const homogenization::UnitCell &cell, StrainOutput &output);

/// Where a reference got no further.
struct StoppedReference
{
  const ReferenceStep &step; ///< not reached
  Stability at_the_end;      ///< of its last equilibrium
  const meshes::Sheet &sheet;
  const homogenization::UnitCell &cell;
};

/// Writes that the reference got no further, and why, as far as its last equilibrium tells: which
/// triangle is not elliptic there, and what pulls or presses it; or that all are, whether it is a
/// minimum, and what ends the path of a sheet of 2 x 2 cells, followed by its arc length. Rows of
/// levels.csv of that equilibrium stand at its own strain, between the levels; where the law
/// ends that path on both meshes, two rows of the small sheet tell between which strains.
/// @param path strains that the study asks for, ascending; empty where the path is not followed
void write_stop(const StrainLevel &level, const StoppedReference &stopped,
                const std::vector<double> &path, StrainOutput &output);

/// write_ellipticity() of the coarse cloth; its note is written at the first level of a load that
/// needs it.
/// @param stiffness C^H (3,3) [N/m]
/// @param positions of the vertices of the coarse cloth [m]
void write_coarse_ellipticity(const StrainLevel &level, const meshes::TriangleMesh &coarse,
                              const Eigen::Matrix3d &stiffness, const meshes::Points &positions,
                              StrainOutput &output);
} // namespace homespun::verification
