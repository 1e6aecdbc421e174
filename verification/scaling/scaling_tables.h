// SPDX-License-Identifier: MIT
// The table of `homespun scaling`: a row per run.
#pragma once

#include "verification/record/table.h"

#include <array>

namespace homespun::verification
{
/// One run of `homespun homogenize --no-bars`.
struct ScalingRun
{
  static constexpr const char *file   = "scaling.csv";
  static constexpr std::size_t n_keys = 3;

  int refine = 0, ranks = 0, repeat = 0;
  double dofs       = 0.;
  double iterations = 0.;                                            ///< mean of the three loads
  double setup = 0., assembly = 0., preconditioner = 0., solve = 0.; ///< [s], of the slowest rank
  double largest_rank = 0., all_ranks = 0.;                          ///< peak memory [bytes]
  double C11 = 0., C12 = 0., C13 = 0., C22 = 0., C23 = 0., C33 = 0.; ///< [N/m]

  double seconds() const
  {
    return setup + assembly + preconditioner + solve;
  }

  std::array<double, 6> stiffness() const
  {
    return {C11, C12, C13, C22, C23, C33};
  }

  template <typename Column>
  static void columns(Column &&column)
  {
    column("refine", &ScalingRun::refine, Domain::needed_not_negative);
    column("ranks", &ScalingRun::ranks, Domain::positive);
    column("repeat", &ScalingRun::repeat, Domain::needed_not_negative);
    column("dofs", &ScalingRun::dofs, Domain::positive);
    column("iterations", &ScalingRun::iterations, Domain::needed_not_negative);
    column("seconds_setup", &ScalingRun::setup, Domain::needed_not_negative);
    column("seconds_assembly", &ScalingRun::assembly, Domain::needed_not_negative);
    column("seconds_preconditioner", &ScalingRun::preconditioner, Domain::needed_not_negative);
    column("seconds_solve", &ScalingRun::solve, Domain::needed_not_negative);
    column("bytes_largest_rank", &ScalingRun::largest_rank, Domain::positive);
    column("bytes_all_ranks", &ScalingRun::all_ranks, Domain::positive);
    column("C_11", &ScalingRun::C11, Domain::real);
    column("C_12", &ScalingRun::C12, Domain::real);
    column("C_13", &ScalingRun::C13, Domain::real);
    column("C_22", &ScalingRun::C22, Domain::real);
    column("C_23", &ScalingRun::C23, Domain::real);
    column("C_33", &ScalingRun::C33, Domain::real);
  }
};
} // namespace homespun::verification
