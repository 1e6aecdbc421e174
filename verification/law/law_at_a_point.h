// SPDX-License-Identifier: MIT
// What a law is at a point of a phase: a file of this folder for each law, and the table of them.
#pragma once

#include "meshes/plain/law.h"
#include "meshes/plain/yarn_axes.h"
#include "verification/law/response.h"

#include <Eigen/Core>

#include <array>

namespace homespun::verification
{
struct PhaseStiffness
{
  Eigen::Matrix3d C;      ///< [N/m], Voigt 11, 22, 12 with engineering shear
  meshes::YarnAxes yarns; ///< of C; found under a law of yarns alone
};

struct LawAtAPoint
{
  /// @param F deformation gradient (2,2)
  Response (*in_plane)(const PhaseStiffness &phase, const Eigen::Matrix2d &F);
  /// The same as a function of the metric, of a sheet in space; null: the law is none of space.
  MetricResponse (*by_metric)(const PhaseStiffness &phase, const SpaceGradient &F);
};

extern const LawAtAPoint linear_law, biot_law, green_law, yarn_law;

/// In the order of meshes::law_table.
inline constexpr std::array<const LawAtAPoint *, meshes::law_table.size()> laws_at_a_point = {
  &linear_law, &biot_law, &green_law, &yarn_law};
} // namespace homespun::verification
