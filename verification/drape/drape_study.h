// SPDX-License-Identifier: MIT
// A scene run: the coarse cloth with the effective stiffness of each cell, up-sampled every step;
// beside it the full-resolution cloth, in the same code or by finite elements; the error of every
// vertex over time.
#pragma once

#include "verification/drape/drape_options.h"
#include "verification/record/verdict.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace homespun::verification
{
/// Runs a scene and writes drape.csv, motion.csv, drape.json, terms.csv, verdicts.json and the
/// frames. References go on from the last frame that a run which was killed left; coarse cloths,
/// which take seconds, are run again.
/// @throws BadInput with one message per fault before anything is written
std::vector<Verdict> run_drape_study(const DrapeOptions &options, MPI_Comm communicator);
} // namespace homespun::verification
