// SPDX-License-Identifier: MIT
// The tables of a scene run: errors against the references, motion and energies, forces of what is
// held, and what terms cost.
#pragma once

#include "verification/record/fields.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

namespace homespun::verification
{
/// Error of a method at a frame, over the fine vertices.
struct DrapeRow
{
  static constexpr const char *file    = "drape.csv";
  static constexpr std::size_t n_keys  = 6;
  static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

  std::string scene, cell, variant, reference, method;
  int frame   = 0;
  double time = 0.;                                                   ///< [s]
  double mean = not_a_number, rms = not_a_number, max = not_a_number; ///< [m]
  double mean_per_cell = not_a_number, mean_per_fluctuation = not_a_number;
  double uncertainty  = not_a_number; ///< of the reference's mesh [m]
  double time_step    = not_a_number; ///< uncertainty of the error from the time step [m]
  double displacement = not_a_number; ///< mean of the reference's since the beginning [m]

  template <typename Column>
  static void columns(Column &&column)
  {
    column("scene", &DrapeRow::scene, Domain::name);
    column("cell", &DrapeRow::cell, Domain::name);
    column("variant", &DrapeRow::variant, Domain::name);
    column("reference", &DrapeRow::reference, Domain::name);
    column("method", &DrapeRow::method, Domain::name);
    column("frame", &DrapeRow::frame, Domain::needed_not_negative);
    column("time_s", &DrapeRow::time, Domain::needed_not_negative);
    column("error_mean_m", &DrapeRow::mean, Domain::not_negative);
    column("error_rms_m", &DrapeRow::rms, Domain::not_negative);
    column("error_max_m", &DrapeRow::max, Domain::not_negative);
    column("error_mean_per_cell", &DrapeRow::mean_per_cell, Domain::not_negative);
    column("error_mean_per_fluctuation", &DrapeRow::mean_per_fluctuation, Domain::not_negative);
    column("reference_uncertainty_m", &DrapeRow::uncertainty, Domain::not_negative);
    column("time_step_uncertainty_m", &DrapeRow::time_step, Domain::not_negative);
    column("displacement_mean_m", &DrapeRow::displacement, Domain::not_negative);
  }
};

/// A cloth in motion: of the coarse ones the variant, that is its law, `nodal-warping` or the
/// method that it belongs to; of the references `shell` or its law.
struct MovingCloth
{
  static constexpr const char *coarse = "coarse", *reference = "reference";

  std::string cell, kind, variant;
};

/// A cloth at a frame, or what a pin or a handle exerts on it there, from the first step on. What
/// does not apply is not a number.
struct MotionRow
{
  static constexpr const char *file    = "motion.csv";
  static constexpr std::size_t n_keys  = 6;
  static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

  std::string scene, cell, cloth, variant; ///< as MovingCloth has them
  int frame         = 0;
  std::string place = {}; ///< that is held, as the scene calls it; empty: the whole cloth
  double time       = 0.; ///< [s]
  double centre_x = not_a_number, centre_y = not_a_number,
         centre_z     = not_a_number; ///< vertex in the middle [m]
  double kinetic      = not_a_number; ///< [J]
  double elastic      = not_a_number; ///< of membrane and plate, not of terms without an energy [J]
  double gravity      = not_a_number; ///< potential of the weight, zero at the origin [J]
  double stretch      = not_a_number; ///< the largest [-]
  double step_seconds = not_a_number, upsampling_seconds = not_a_number; ///< medians so far [s]
  double force_x = not_a_number, force_y = not_a_number,
         force_z = not_a_number; ///< of a step of `linearly implicit` with the residual that its
                                 ///< one Newton iteration leaves [N]

  template <typename Column>
  static void columns(Column &&column)
  {
    column("scene", &MotionRow::scene, Domain::name);
    column("cell", &MotionRow::cell, Domain::name);
    column("cloth", &MotionRow::cloth, Domain::name);
    column("variant", &MotionRow::variant, Domain::name);
    column("frame", &MotionRow::frame, Domain::needed_not_negative);
    column("place", &MotionRow::place, Domain::text);
    column("time_s", &MotionRow::time, Domain::needed_not_negative);
    column("centre_x_m", &MotionRow::centre_x, Domain::real);
    column("centre_y_m", &MotionRow::centre_y, Domain::real);
    column("centre_z_m", &MotionRow::centre_z, Domain::real);
    column("kinetic_J", &MotionRow::kinetic, Domain::not_negative);
    column("elastic_J", &MotionRow::elastic, Domain::real);
    column("gravity_J", &MotionRow::gravity, Domain::real);
    column("max_stretch", &MotionRow::stretch, Domain::not_negative);
    column("seconds_coarse_step", &MotionRow::step_seconds, Domain::not_negative);
    column("seconds_upsampling", &MotionRow::upsampling_seconds, Domain::not_negative);
    column("force_x_N", &MotionRow::force_x, Domain::real);
    column("force_y_N", &MotionRow::force_y, Domain::real);
    column("force_z_N", &MotionRow::force_z, Domain::real);
  }
};

/// Time of a step and memory of a cloth, as its scene is, and with a term that the scene leaves out
/// forced upon it.
struct TermRow
{
  static constexpr const char *file    = "terms.csv";
  static constexpr std::size_t n_keys  = 3;
  static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

  std::string scene, cell, term;
  bool is_present       = false;
  double seconds        = not_a_number,
         forced_seconds = not_a_number; ///< medians; of a cloth that did not converge none [s]
  unsigned long bytes   = 0;
  std::optional<unsigned long> forced_bytes;
  double spread        = not_a_number,
         forced_spread = not_a_number; ///< half of the interquartile range [s]

  template <typename Column>
  static void columns(Column &&column)
  {
    column("scene", &TermRow::scene, Domain::name);
    column("cell", &TermRow::cell, Domain::name);
    column("term", &TermRow::term, Domain::name);
    column("present", &TermRow::is_present, Domain::flag);
    column("seconds_per_step", &TermRow::seconds, Domain::not_negative);
    column("seconds_per_step_forced", &TermRow::forced_seconds, Domain::not_negative);
    column("bytes", &TermRow::bytes, Domain::needed_not_negative);
    column("bytes_forced", &TermRow::forced_bytes, Domain::not_negative);
    column("seconds_spread", &TermRow::spread, Domain::not_negative);
    column("seconds_spread_forced", &TermRow::forced_spread, Domain::not_negative);
  }
};
} // namespace homespun::verification
