// SPDX-License-Identifier: MIT
// homespun verify: every study of some cells, and one page with all their claims; without a cell
// the self-tests of the program.
#pragma once

#include "verification/cell/study_options.h"
#include "verification/record/verdict.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace homespun::verification
{
/// Without cells: self-tests alone.
struct VerifyOptions : StudyOptions
{
  std::vector<std::string> parts; ///< of verify_parts(), in any order; none: default_parts()
};

struct Verification
{
  std::vector<Verdict> verdicts;    ///< of all parts, each claim begins with its part
  std::vector<std::string> folders; ///< of the parts that ran to their end, for one report
  int status = 0; ///< exit status: the worst of the claims and of parts that did not end
};

/// The parts: homogenize, strain, load and stability of a periodic cloth, converge, stress, drape.
const std::vector<std::string> &verify_parts();

/// What runs where nothing was asked for: of cells all parts; without a cell what speaks
/// of the program alone, the stability map of made cells.
std::vector<std::string> default_parts(const std::vector<std::string> &cell_files);

/// Runs the parts one after the other, each into a folder of its own below the output, and writes
/// verdicts.json with all claims. A part whose solver does not converge is a claim that failed, the
/// others still run, and the exit status says so.
/// @throws BadInput where a cell cannot be read or makes no sheet, or two share a name, before
///   anything runs
Verification verify(const VerifyOptions &options, MPI_Comm communicator);

/// The outcome in one line: FAIL with the first claim that failed, INCONCLUSIVE where
/// one is open, else PASS; with how many claims hold and how many are open.
std::string outcome_line(const std::vector<Verdict> &verdicts);
} // namespace homespun::verification
