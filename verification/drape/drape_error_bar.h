// SPDX-License-Identifier: MIT
// How far the error of a scene may itself be from that of fine meshes and small time steps:
// measured on a small sheet.
#pragma once

#include "verification/cell/discretization_distance.h"
#include "verification/drape/drape_schedule.h"
#include "verification/drape/draped_cell.h"

#include <mpi.h>

#include <cstddef>
#include <functional>
#include <vector>

namespace homespun::verification
{
/// Error bar on a small sheet, per frame. It goes with the local strain, as the fluctuation does,
/// and is carried over to the full sheet by the ratio of the two: of the largest ones up to a
/// frame, since where coarse and fine cloth cross the fluctuation of one frame may pass near zero.
struct DrapeErrorBar
{
  double order = 0.;                          ///< of P2, order_of_p2()
  std::vector<DiscretizationDistance> meshes; ///< of the reference [m]
  std::vector<double> halved_step; ///< mean |e(h) − e(h/2)|, e of drape_error_bar() [m]
  std::vector<double> fluctuation; ///< mean |refined P2 − coarse motion| [m]
  std::vector<double> coarse_step; ///< changes_by_halved_step(), where frames are kept [m]

  /// The bar by mesh, DiscretizationDistance::uncertainty(), or by time step on another sheet [m];
  /// not a number where it is not known.
  /// @param largest_there the largest fluctuation up to that frame [m]
  double of_mesh_at(std::size_t frame, double largest_there) const;
  double of_time_step_at(std::size_t frame, double largest_there) const;

  /// What the bar by time step of the reference alone has more than of_time_step_at() [m]: there
  /// cloths that go with one step share some of what it changes. Not a number where it is not
  /// known.
  double of_coarse_step_at(std::size_t frame) const;
};

/// Runs the scene on a small sheet: P1, P2, refined P2, and where the cloth moves P1 and the coarse
/// cloth once more with half of the time step. With e = up-sampled − P1, of first order in the time
/// step h because the reference's implicit Euler is, its distance from that of h -> 0 is
/// 2 |e(h) − e(h/2)|, times 1.25 as in the grid convergence index; means over the fine vertices.
/// The step changes the reference itself by |e(h) − e(h/2)| + |u(h) − u(h/2)| at most, where u, the
/// up-sampled whole coarse cloth, is that of changes_by_halved_step(): a small sheet moves in
/// another time.
/// Ends at the first frame that one of them does not reach.
/// @param law of the reference
/// @param n_cells of the small sheet, per side
/// @param tell of each frame before it is run
DrapeErrorBar drape_error_bar(const DrapedCell &draped, Law law, int n_cells,
                              const DrapeSchedule &schedule, MPI_Comm communicator,
                              const std::function<void(int frame)> &tell);

/// Mean |u(h) − u(h/2)| of each frame, u the up-sampled coarse cloth; zero of equilibria [m]. Ends
/// at the first frame that the cloth does not reach with half of the time step.
/// @param frames of the coarse cloth that is the method, run with the step of the schedule [m]
std::vector<double> changes_by_halved_step(const DrapedCell &draped,
                                           const std::vector<shell::Vectors> &frames,
                                           const DrapeSchedule &schedule);
} // namespace homespun::verification
