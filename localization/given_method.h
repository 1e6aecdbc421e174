// SPDX-License-Identifier: MIT
// What a method is on the coarse cloth of somebody else: its up-sampling.
//
// The coarse motion is given, and with it whatever moved the cloth: the terms p2 and cubic of a
// method are its own. Up-sampling has micro, modes, curved, where the cell has its deflection, and,
// where edges of a sheet or of panels lie on lattice lines and are not sewn, edges. There the modes
// of a clamped edge belong to a coarse edge that lies d E off where it is held (meshes/plain/
// cell_edges.h). Somebody else's cloth lies where it is held: without slip these modes are worse
// than none, so that it is added (Slip::added).
#pragma once

#include "localization/method.h"
#include "localization/panel_edges.h"

#include <string>
#include <vector>

namespace homespun::localization
{
/// What is known of the coarse cloth.
struct GivenCloth
{
  /// Which edges on lattice lines are held along their whole length: left, right, where the first
  /// lattice coordinate of the cloth beside them begins and ends, bottom, top, of all panels; or
  /// `none`. The others are free. Empty: nobody says, and there are no terms of edges.
  std::vector<std::string> held;
  Slip slip = Slip::added;   ///< of_cloth: of one that moved by the terms of edges
  std::vector<Panel> panels; ///< of a garment (garment/garment_panels.h); none: of whole cells
};

struct GivenMethod
{
  Method used;          ///< what up-sampling has of the method
  Law law = Law::biot;  ///< whose modes it takes
  std::string left_out; ///< a sentence on what it has not, and where; empty where that is nothing
  UpsamplerOptions options;
};

/// Modes are those that are fitted, of the first law that the cell has them of, else quadratic ones
/// of `biot`.
/// @param cell to be kept by the caller until an up-sampler is made
/// @throws BadInput where the cell lacks what the method asks for, or terms of up-sampling that are
///   asked for by name have no meaning here
GivenMethod on_given(const Method &method, const meshes::HomogenizedCell &cell,
                     const GivenCloth &given);
} // namespace homespun::localization
