// SPDX-License-Identifier: MIT
// Fine positions for the frames of another program's coarse simulation, with indicators of their
// error that need no reference (coarse_indicators.h). Nothing is judged.
#pragma once

#include "verification/upsample/upsample_options.h"

namespace homespun::verification
{
/// Writes NAME.FORMAT of each frame in metres, frames.pvd of .vtu, upsample.csv and upsample.json.
/// A frame whose file is the one it was made of stays as it is; more frames may be added to a
/// folder, of which frames.pvd and upsample.json name all.
/// @throws BadInput, before anything is written, where cell, rest mesh or any frame cannot be used
void run_upsample_study(const UpsampleOptions &options);
} // namespace homespun::verification
