// SPDX-License-Identifier: MIT
// How far an up-sampled sheet that bends is from the resolved one at large turns: both are cloths
// in space with the law `biot` (cloth_sheet.h), on the same triangles, those that are drawn, so
// that nothing differs but the material.
//
// At large turns clamps alone have a term of edges: the homogenized sheet's are turned by
// b_a K_a. Read again on the turned sheet, K swings where a clamp ends: it is that of the sheet
// whose clamps are not turned, times by how much the turn changes the clamp's moment. Free edges
// have layers and no beam. Of the loads those of one clamped edge are known: clamps that keep their
// distance stretch a sheet once it deflects by its thickness, and a moment on an edge is no dead
// load.
#pragma once

#include "verification/bend/bent_sheet.h"
#include "verification/bend/cloth_sheet.h"
#include "verification/bend/micro_deflection.h"

#include <string>

namespace homespun::verification
{
/// Why large turns of a cell under a load are not known, a clause; empty where they are.
std::string why_no_large_turns(const homogenization::UnitCell &cell, const BendingLoad &load);

/// A sheet at one load.
struct BentByTurns
{
  /// Up-sampled less resolved; empty of methods that are not known.
  BentSheet::OfMethods<BentState> error_of_method;
  double curvature         = 0.; ///< root mean square, of the homogenized sheet [1/m]
  double deflection        = 0.; ///< mean over the vertices of the resolved sheet [m]
  double seconds           = 0.; ///< of the homogenized sheets and all methods
  double seconds_reference = 0.;
};

/// A sheet of n x n cells, flat at first.
class BentCloth
{
public:
  /// @param cell, load with large turns
  BentCloth(const BendingCell &cell, const BendingLoad &load, int n);
  BentCloth(const BentCloth &) = delete; // its cloths refer to its sheet

  /// From where it is to a load.
  /// @param pressure on the material [N/m^2]
  /// @throws NotConverged
  BentByTurns at(double pressure);

  const meshes::Sheet sheet;
  ClothSheet resolved, homogenized, turned; ///< the last with its clamps turned

private:
  const BendingCell &cell;
  const MicroDeflection of_cell;
};
} // namespace homespun::verification
