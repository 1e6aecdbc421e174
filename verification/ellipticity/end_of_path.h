// SPDX-License-Identifier: MIT
// Why the equilibria of a sheet end where they do: a limit point, where the strain turns back; a
// lost ellipticity, where the law ends; or the solver, which stops though the path goes on. Found
// on a small sheet, on its mesh and on that mesh refined once, by following the path by its arc
// length with the inertia of its tangent.
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/ellipticity/ellipticity.h"
#include "verification/law/laws.h"
#include "verification/newton/arc_length.h"
#include "verification/reference/loads.h"

#include <optional>
#include <string>
#include <vector>

namespace homespun::verification
{
/// On one mesh.
struct EndOnMesh
{
  PathEnd end     = PathEnd::lost;
  double farthest = 0.; ///< largest strain of an equilibrium
  int n_negative  = 0;  ///< negative eigenvalues of the tangent behind it
  /// Its triangles there; nothing where no equilibrium was found at all.
  std::optional<PhaseEllipticity> triangles = {};
};

struct EndOfPath
{
  int n_cells = 0; ///< per side of the small sheet
  EndOnMesh as_given, refined;
};

enum class Ending
{
  limit_point,
  law,
  solver, ///< the path goes on
  unknown
};

/// The law ends where a triangle is not elliptic at the end of the path, or on the way to its limit
/// point; else a path that turns has a limit point, and one that goes on was left by the solver.
/// What ends a path that is lost is not known.
Ending ending_of(const EndOnMesh &mesh);

/// The same of both meshes, which may end differently: nothing then.
std::optional<Ending> ending_of(const EndOfPath &end);

/// @param strains that the study asks for, ascending, up to the one that was not reached
EndOfPath end_of_path(const homogenization::UnitCell &cell, const Load &load, Law law,
                      const std::vector<double> &strains, int n_cells);

/// What was found, for a note; a conclusion only where both meshes end alike.
std::string text_of(const EndOfPath &end);
} // namespace homespun::verification
