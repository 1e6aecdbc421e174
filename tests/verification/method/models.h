// SPDX-License-Identifier: MIT
// A method on a sheet in one line.
#pragma once

#include "verification/method/coarse_model.h"

#include <string>

namespace homespun::tests
{
/// What holds the coarse cloth of `localized` at a strain.
inline verification::LoadForces coarse_forces(const meshes::HomogenizedCell &cell,
                                              const meshes::Sheet &sheet,
                                              const verification::Load &load,
                                              const verification::Law law, const double strain)
{
  const verification::CoarseModel model({cell}, sheet, load, verification::Method("localized"),
                                        law);
  return model.forces(model.solve(strain));
}

/// The coarse motion of a model at the fine vertices, nothing added (n,2) [m].
inline meshes::Points interpolated(const meshes::HomogenizedCell &cell,
                                   const verification::CoarseModel &model,
                                   const meshes::Sheet &sheet, const verification::Law law,
                                   const verification::CoarseState &state)
{
  const verification::CoarseSpace space(sheet, verification::element_of(model.method));
  localization::Upsampler<2, double>::Fine fine;
  localization::Upsampler<2, double>(cell, space.grid.mesh, sheet,
                                     verification::Method("affine").options(law))
    .upsample(space.on_grid<2>(state.positions), fine);
  return fine;
}

/// Fine positions of a method (n,2) [m].
inline meshes::Points upsampled(const std::string &method, const verification::CellModel &cell,
                                const meshes::Sheet &sheet, const verification::Load &load,
                                const verification::Law law, const double strain)
{
  const verification::CoarseModel model(cell, sheet, load, verification::Method(method), law);
  return model.upsample(model.solve(strain));
}
} // namespace homespun::tests
