// SPDX-License-Identifier: MIT
// The tables of a strain study: what stands in a row, once for all who write and read them.
#pragma once

#include "verification/record/table.h"
#include "verification/record/validity_table.h"

#include <limits>
#include <optional>
#include <string>

namespace homespun::verification
{
/// Below this, in strain x cell side, an error is zero: the tolerance of the references' solver.
constexpr double solved_to = 1e-9;

/// In place of a method's name: a level of which no equilibrium was found.
constexpr const char *unreached = "unreached";

/// strain.csv: the distance of one method from one reference at one level.
struct StrainRow
{
  static constexpr const char *file   = "strain.csv";
  static constexpr std::size_t n_keys = 5;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  std::string cell, load;
  double strain = 0.;
  std::string reference, method;
  int cells              = 0; ///< per side of the sheet
  int coarse_triangles   = 0;
  int fine_triangles     = 0;
  double mean            = none; ///< over the fine vertices [m]
  double rms             = none; ///< [m]
  double max             = none; ///< [m]
  double per_cell        = none; ///< mean over the cell side
  double per_fluctuation = none; ///< mean over the mean of |reference − resolved homogenized sheet|
  double uncertainty     = none;   ///< of the reference, mean over the vertices [m]
  double uncertainty_max   = none; ///< of the reference, at its worst vertex [m]
  double to_refined        = none; ///< of the reference from refined P2, mean over the vertices [m]
  double bar               = none; ///< of the mean error itself [m]
  double bar_safety        = none; ///< F of that bar; above 1.25 no convergence is seen
  double interior          = none; ///< mean over vertices of no cell at an edge [m]
  double edge              = none; ///< mean over the others [m]
  double seconds           = none; ///< of the method
  double seconds_reference = none;

  bool is_reached() const
  {
    return method != unreached;
  }

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &StrainRow::cell, Domain::name);
    column("load", &StrainRow::load, Domain::name);
    column("strain", &StrainRow::strain, Domain::positive);
    column("reference", &StrainRow::reference, Domain::name);
    column("method", &StrainRow::method, Domain::name);
    column("cells", &StrainRow::cells, Domain::positive);
    column("coarse_triangles", &StrainRow::coarse_triangles, Domain::positive);
    column("fine_triangles", &StrainRow::fine_triangles, Domain::positive);
    column("error_mean_m", &StrainRow::mean, Domain::not_negative);
    column("error_rms_m", &StrainRow::rms, Domain::not_negative);
    column("error_max_m", &StrainRow::max, Domain::not_negative);
    column("error_mean_per_cell", &StrainRow::per_cell, Domain::not_negative);
    column("error_mean_per_fluctuation", &StrainRow::per_fluctuation, Domain::not_negative);
    column("reference_uncertainty_m", &StrainRow::uncertainty, Domain::not_negative);
    column("reference_uncertainty_max_m", &StrainRow::uncertainty_max, Domain::not_negative);
    column("reference_to_refined_m", &StrainRow::to_refined, Domain::not_negative);
    column("error_bar_m", &StrainRow::bar, Domain::not_negative);
    column("error_bar_safety", &StrainRow::bar_safety, Domain::not_negative);
    column("error_interior_m", &StrainRow::interior, Domain::not_negative);
    column("error_edge_m", &StrainRow::edge, Domain::not_negative);
    column("seconds_method", &StrainRow::seconds, Domain::not_negative);
    column("seconds_reference", &StrainRow::seconds_reference, Domain::not_negative);
  }
};

/// gains.csv: what is left of the error of `affine`, in two factors: what a method's coarse cloth
/// is worth, and what up-sampling is worth on it. The base tells them apart (strain/gains.h). A
/// gain is not a number where an error is zero to what the solvers leave.
struct GainRow
{
  static constexpr const char *file   = "gains.csv";
  static constexpr std::size_t n_keys = 5;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  std::string cell, load;
  double strain = 0.;
  std::string reference, method, base;
  double of_coarse_cloth = none; ///< error of `affine` over that of the base
  double of_upsampling   = none; ///< error of the base over that of the method
  double total           = none; ///< error of `affine` over that of the method

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &GainRow::cell, Domain::name);
    column("load", &GainRow::load, Domain::name);
    column("strain", &GainRow::strain, Domain::positive);
    column("reference", &GainRow::reference, Domain::name);
    column("method", &GainRow::method, Domain::name);
    column("base", &GainRow::base, Domain::name);
    column("gain_of_coarse_cloth", &GainRow::of_coarse_cloth, Domain::not_negative);
    column("gain_of_upsampling", &GainRow::of_upsampling, Domain::not_negative);
    column("gain_total", &GainRow::total, Domain::not_negative);
  }
};

/// levels.csv: a level of a load against a law: what it cost, how much the reference fluctuates
/// there, and remarks, `|` between them; and, in rows of their own, whether the triangles of a part
/// of it are elliptic (ellipticity/ellipticity.h). What a row has not is empty.
struct LevelRow
{
  static constexpr const char *file      = "levels.csv";
  static constexpr const char *separator = " | "; ///< of remarks
  static constexpr std::size_t n_keys    = 5;
  static constexpr double none           = std::numeric_limits<double>::quiet_NaN();

  std::string cell, load, reference;
  double strain                = 0.;
  std::string part             = {}; ///< a phase, or `coarse cloth`; empty: the level itself
  std::optional<int> triangles = {}; ///< of that part
  std::optional<int> lost      = {}; ///< of them not elliptic
  double least          = none; ///< stiffness of the plane wave that costs least, over that at rest
  double seconds_coarse = none, seconds_upsample = none, seconds_fine = none;
  std::optional<int> coarse_iterations        = {};
  std::optional<unsigned int> fine_iterations = {};
  std::optional<unsigned long> fine_dofs      = {};
  std::optional<unsigned int> ranks           = {};
  double fluctuation          = none; ///< mean |reference − resolved homogenized sheet| [m]
  double fluctuation_bar      = none; ///< its change from a homogenized sheet half as fine [m]
  std::string homogenized_law = {};   ///< of that sheet
  double seconds_homogenized  = none;
  std::string stability       = {};   ///< of the reference, see Stability
  double seconds_stability    = none; ///< what it cost to find that out
  std::string note            = {};   ///< remarks

  /// Whether it has the numbers of a level that was solved.
  bool is_solved() const
  {
    return !stability.empty();
  }

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &LevelRow::cell, Domain::name);
    column("load", &LevelRow::load, Domain::name);
    column("reference", &LevelRow::reference, Domain::name);
    column("strain", &LevelRow::strain, Domain::positive);
    column("part", &LevelRow::part, Domain::text);
    column("triangles", &LevelRow::triangles, Domain::not_negative);
    column("not_elliptic", &LevelRow::lost, Domain::not_negative);
    column("least_wave", &LevelRow::least, Domain::real);
    column("seconds_coarse_solve", &LevelRow::seconds_coarse, Domain::not_negative);
    column("seconds_upsample", &LevelRow::seconds_upsample, Domain::not_negative);
    column("seconds_fine_step", &LevelRow::seconds_fine, Domain::not_negative);
    column("coarse_iterations", &LevelRow::coarse_iterations, Domain::not_negative);
    column("fine_iterations", &LevelRow::fine_iterations, Domain::not_negative);
    column("fine_dofs", &LevelRow::fine_dofs, Domain::not_negative);
    column("ranks", &LevelRow::ranks, Domain::not_negative);
    column("fluctuation_m", &LevelRow::fluctuation, Domain::not_negative);
    column("fluctuation_bar_m", &LevelRow::fluctuation_bar, Domain::not_negative);
    column("homogenized_law", &LevelRow::homogenized_law, Domain::text);
    column("seconds_homogenized_sheet", &LevelRow::seconds_homogenized, Domain::not_negative);
    column("reference_stability", &LevelRow::stability, Domain::text);
    column("seconds_stability", &LevelRow::seconds_stability, Domain::not_negative);
    column("note", &LevelRow::note, Domain::text);
  }
};

/// forces.csv: what a load takes of one cloth at one level. Of the methods
/// - resolved: the reference, every triangle with its own stiffness
/// - coarse: the coarse cloth, whether it is up-sampled or not: that changes no force
/// - affine: derivative of the energy that the resolved sheet has where the coarse motion,
///   interpolated, puts it; in linear theory not below that of `resolved`
/// The load takes a force along the motion of the moving clamp, positive where that does work; of
/// an infinite cloth the nominal stress that does the work stands for the force per width; where
/// its sides are free, the derivative of the affine motion's energy, of which they are a part.
struct ForceRow
{
  static constexpr const char *file   = "forces.csv";
  static constexpr std::size_t n_keys = 5;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  std::string cell, load;
  double strain = 0.;
  std::string reference, method;
  double force     = none; ///< [N]; of an infinite cloth none
  double per_width = none; ///< nominal, per rest width of the clamped edge [N/m]
  double bar       = none; ///< of the reference's force per width [N/m]
  double travel    = none; ///< of the moving clamp; of an infinite cloth none [m]
  double stress_11 = none, stress_22 = none, stress_12 = none,
         stress_21 = none; ///< mean nominal stress dW/dF over the rest area [N/m]

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &ForceRow::cell, Domain::name);
    column("load", &ForceRow::load, Domain::name);
    column("strain", &ForceRow::strain, Domain::positive);
    column("reference", &ForceRow::reference, Domain::name);
    column("method", &ForceRow::method, Domain::name);
    column("force_N", &ForceRow::force, Domain::real);
    column("force_per_width_N_per_m", &ForceRow::per_width, Domain::real);
    column("reference_uncertainty_N_per_m", &ForceRow::bar, Domain::not_negative);
    column("travel_m", &ForceRow::travel, Domain::not_negative);
    column("stress_11_N_per_m", &ForceRow::stress_11, Domain::real);
    column("stress_22_N_per_m", &ForceRow::stress_22, Domain::real);
    column("stress_12_N_per_m", &ForceRow::stress_12, Domain::real);
    column("stress_21_N_per_m", &ForceRow::stress_21, Domain::real);
  }
};

/// uncertainty.csv: distances between discretizations of one reference, means over the vertices and
/// largest, and those of their forces; or of the errors of one method, method and reference of the
/// same discretization, means alone. Not a number where one of them was not reached or not asked
/// for.
struct UncertaintyRow
{
  static constexpr const char *file         = "uncertainty.csv";
  static constexpr const char *of_reference = "reference"; ///< in the place of a method
  static constexpr std::size_t n_keys       = 6;
  static constexpr double none              = std::numeric_limits<double>::quiet_NaN();

  std::string cell, load, reference;
  double strain        = 0.;
  int cells            = 0; ///< per side of the sheet that was measured
  std::string method   = of_reference;
  double p1_to_p2      = none; ///< |P1 − P2| [m]
  double p1_to_refined = none; ///< |P1 − refined P2| [m]
  double p2_to_refined = none; ///< |P2 − refined P2| [m]
  double p1_to_p2_max = none, p1_to_refined_max = none, p2_to_refined_max = none; ///< [m]
  double bar = none, bar_max = none; ///< per strain and cell side
  double force_p1_to_p2 = none, force_p1_to_refined = none, force_p2_to_refined = none,
         force_bar = none; ///< fall of the force along the load, over that of P1 [-]

  bool is_of_reference() const
  {
    return method == of_reference;
  }

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &UncertaintyRow::cell, Domain::name);
    column("load", &UncertaintyRow::load, Domain::name);
    column("reference", &UncertaintyRow::reference, Domain::name);
    column("strain", &UncertaintyRow::strain, Domain::positive);
    column("cells", &UncertaintyRow::cells, Domain::positive);
    column("method", &UncertaintyRow::method, Domain::name);
    column("p1_minus_p2_m", &UncertaintyRow::p1_to_p2, Domain::not_negative);
    column("p1_minus_refined_p2_m", &UncertaintyRow::p1_to_refined, Domain::not_negative);
    column("p2_minus_refined_p2_m", &UncertaintyRow::p2_to_refined, Domain::not_negative);
    column("p1_minus_p2_max_m", &UncertaintyRow::p1_to_p2_max, Domain::not_negative);
    column("p1_minus_refined_p2_max_m", &UncertaintyRow::p1_to_refined_max, Domain::not_negative);
    column("p2_minus_refined_p2_max_m", &UncertaintyRow::p2_to_refined_max, Domain::not_negative);
    column("uncertainty_per_strain_and_side", &UncertaintyRow::bar, Domain::not_negative);
    column("uncertainty_max_per_strain_and_side", &UncertaintyRow::bar_max, Domain::not_negative);
    column("force_p1_minus_p2", &UncertaintyRow::force_p1_to_p2, Domain::real);
    column("force_p1_minus_refined_p2", &UncertaintyRow::force_p1_to_refined, Domain::real);
    column("force_p2_minus_refined_p2", &UncertaintyRow::force_p2_to_refined, Domain::real);
    column("force_uncertainty", &UncertaintyRow::force_bar, Domain::not_negative);
  }
};

/// runtime.csv: one way to the positions of a sheet.
struct RunTimeRow
{
  static constexpr const char *file   = "runtime.csv";
  static constexpr std::size_t n_keys = 5;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  std::string cell, load;
  double strain = 0.;
  std::string reference, way;
  long triangles     = 0;
  double mean        = none; ///< distance from the best solution [m]
  double per_cell    = none;
  double uncertainty = none; ///< of the best solution [m]
  double seconds     = none; ///< median of the runs
  double step        = none; ///< mean Newton step of the coarse cloth, of methods of their own [s]
  double upsample    = none; ///< up-sampling alone [s]
  int runs           = 0;
  unsigned int ranks = 1;
  int threads        = 1;
  std::string note   = {};

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &RunTimeRow::cell, Domain::name);
    column("load", &RunTimeRow::load, Domain::name);
    column("strain", &RunTimeRow::strain, Domain::positive);
    column("reference", &RunTimeRow::reference, Domain::name);
    column("way", &RunTimeRow::way, Domain::name);
    column("triangles", &RunTimeRow::triangles, Domain::not_negative);
    column("error_mean_m", &RunTimeRow::mean, Domain::not_negative);
    column("error_mean_per_cell", &RunTimeRow::per_cell, Domain::not_negative);
    column("reference_uncertainty_m", &RunTimeRow::uncertainty, Domain::not_negative);
    column("seconds", &RunTimeRow::seconds, Domain::not_negative);
    column("seconds_step", &RunTimeRow::step, Domain::not_negative);
    column("seconds_upsample", &RunTimeRow::upsample, Domain::not_negative);
    column("runs", &RunTimeRow::runs, Domain::not_negative);
    column("ranks", &RunTimeRow::ranks, Domain::positive);
    column("threads", &RunTimeRow::threads, Domain::positive);
    column("note", &RunTimeRow::note, Domain::text);
  }
};
} // namespace homespun::verification
