// SPDX-License-Identifier: MIT
// The tables of studies of an infinite cloth: the levels under given stresses and strains, and its
// Bloch margins along a load.
#pragma once

#include "verification/record/table.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace homespun::verification
{
/// A level of the path of an infinite cloth, or a point of a curve that somebody measured. Strains
/// and nominal stresses as in load_control.h.
struct LoadRow
{
  static constexpr const char *file   = "load.csv";
  static constexpr std::size_t n_keys = 4;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  /// Of a measured curve the name of its file, without the ending, and `measured`.
  std::string cell, law;
  /// `resolved`: the cell with its phases, on its given mesh; `coarse`: C^H in place of it, what a
  /// coarse cloth feels; `measured`: taken over from the file of --measured.
  std::string method;
  int step         = 0;                                        ///< from 1
  double factor    = none;                                     ///< part of what is prescribed
  double strain_11 = none, strain_22 = none, strain_12 = none; ///< [-]
  double stress_11 = none, stress_22 = none, stress_12 = none; ///< [N/m]
  /// How far the mesh leaves them from the limit of fine ones: 1.25 |this mesh - once refined| /
  /// (1 - 2^-q), q the order of the energy that the corners of the cell leave; zero of what is
  /// prescribed.
  double strain_11_bar = none, strain_22_bar = none, strain_12_bar = none;
  double stress_11_bar = none, stress_22_bar = none, stress_12_bar = none;
  double energy = none;  ///< per rest area [N/m]
  bool stable   = false; ///< of a measured curve it is not known

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &LoadRow::cell, Domain::name);
    column("law", &LoadRow::law, Domain::name);
    column("method", &LoadRow::method, Domain::name);
    column("step", &LoadRow::step, Domain::positive);
    column("factor", &LoadRow::factor, Domain::not_negative);
    column("strain_11", &LoadRow::strain_11, Domain::real);
    column("strain_22", &LoadRow::strain_22, Domain::real);
    column("strain_12", &LoadRow::strain_12, Domain::real);
    column("stress_11_N_per_m", &LoadRow::stress_11, Domain::real);
    column("stress_22_N_per_m", &LoadRow::stress_22, Domain::real);
    column("stress_12_N_per_m", &LoadRow::stress_12, Domain::real);
    column("strain_11_bar", &LoadRow::strain_11_bar, Domain::not_negative);
    column("strain_22_bar", &LoadRow::strain_22_bar, Domain::not_negative);
    column("strain_12_bar", &LoadRow::strain_12_bar, Domain::not_negative);
    column("stress_11_bar_N_per_m", &LoadRow::stress_11_bar, Domain::not_negative);
    column("stress_22_bar_N_per_m", &LoadRow::stress_22_bar, Domain::not_negative);
    column("stress_12_bar_N_per_m", &LoadRow::stress_12_bar, Domain::not_negative);
    column("energy_N_per_m", &LoadRow::energy, Domain::real);
    column("stable", &LoadRow::stable, Domain::flag);
  }
};

/// The columns of 11, 22 and 12.
using LoadComponents = std::array<double LoadRow::*, 3>;
inline constexpr LoadComponents
  strains_of_row     = {&LoadRow::strain_11, &LoadRow::strain_22, &LoadRow::strain_12},
  stresses_of_row    = {&LoadRow::stress_11, &LoadRow::stress_22, &LoadRow::stress_12},
  strain_bars_of_row = {&LoadRow::strain_11_bar, &LoadRow::strain_22_bar, &LoadRow::strain_12_bar},
  stress_bars_of_row = {&LoadRow::stress_11_bar, &LoadRow::stress_22_bar, &LoadRow::stress_12_bar};

/// A Bloch margin (bloch_margin.h): of a level of a path, of its first loss, of one wave, or beside
/// a pattern; or its lowest field. What a kind does not have is empty.
struct StabilityRow
{
  static constexpr const char *file   = "stability.csv";
  static constexpr std::size_t n_keys = 7;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  /// `level`: the lowest wave of a periodic state; `loss`: the first loss along the way, or else
  /// the last state, and its lowest wave; `wave`: each wave of the zone just beyond the loss, or
  /// else of the last state, on the given mesh; `pattern`: a state over several cells beside the
  /// periodic one, where a level is lost on the given mesh; `mode`: the lowest field at the strain
  /// of the waves, at a vertex of the cell.
  std::string kind;
  std::string cell, law, load;
  std::string way;      ///< `pulled` or `pressed`: the sign of the strain
  std::string mesh;     ///< `given` or `refined`, once
  int number    = 0;    ///< of the level, of the wave, of the level of a pattern, of the vertex
  double strain = none; ///< [-]; of first loss by the line between held_to and lost_at
  /// Of a level `unstable-proved`: a field of the discrete cloth shows it; `stable-up-to-mesh`: no
  /// wave that was asked does, on this mesh; `not-reached`: Newton's method found no state, or the
  /// two sides of its beta do not meet. Of a loss `lost`; `held` up to the last strain; `ended`: no
  /// state of the load beyond `held_to`. Of a pattern `found`: with less energy; `no-wave`: every
  /// wave of these cells is stable; `not-found`: where the lowest wave leads to, Newton's method
  /// did not come to an end.
  std::string outcome;
  /// Of a level `left`: the state is an equilibrium, but not the one that the load leads to from
  /// rest: on the way there a step back does not lead to the state before. Nothing: no such step
  /// was seen.
  std::string path;
  double beta  = none;          ///< [-]
  double lower = none;          ///< no wave that was asked is below, by Cholesky factors
  std::string wave;             ///< in words
  std::string waves;            ///< `long` (the limit) or `finite`
  double k1 = none, k2 = none;  ///< of a finite wave, in the reciprocal basis
  double angle = none;          ///< of a long one, from axis 1 [degrees]
  std::string scale;            ///< `macro` (long) or `micro` (finite)
  int cells_1 = 0, cells_2 = 0; ///< in which the wave is periodic, 0 x 0 of a long one; of a
                                ///< pattern those that are solved as one
  /// `stable` or `unstable`: whether no long wave of the 12 that are asked is lost, of this
  /// program's waves; and the least eigenvalue of their acoustic tensors in the homogenized
  /// tangent, relative to rest, by Newton's matrices. Nothing where the cell itself is no minimum.
  std::string long_waves;
  double acoustic = none;
  double held_to  = none; ///< largest strain that is stable up to the mesh [-]
  double lost_at  = none; ///< the strain of first loss is between that and this [-]
  /// 1.25 |given - refined| / (1 - 2^-q), q the order of the energy that the corners leave; not
  /// less than |lost_at - held_to|.
  double strain_bar      = none;
  double energy_periodic = none; ///< per rest area [N/m]
  double energy          = none; ///< with the pattern [N/m]
  double less_energy     = none; ///< (energy_periodic - energy) / energy_periodic [-]
  double largest         = none; ///< distance between the two states, in sides of the cell [-]
  double x = none, y = none;     ///< of the vertex in the periodic state [m]
  double u_real = none, u_imaginary = none; ///< along axis 1, the largest |(u, v)| is 1 [-]
  double v_real = none, v_imaginary = none; ///< along axis 2

  /// Of a loss, how far the last held strain and the first lost one are apart.
  double apart() const
  {
    return std::abs(lost_at - held_to);
  }

  template <typename Column>
  static void columns(Column &&column)
  {
    column("kind", &StabilityRow::kind, Domain::name);
    column("cell", &StabilityRow::cell, Domain::name);
    column("law", &StabilityRow::law, Domain::name);
    column("load", &StabilityRow::load, Domain::name);
    column("way", &StabilityRow::way, Domain::name);
    column("mesh", &StabilityRow::mesh, Domain::name);
    column("number", &StabilityRow::number, Domain::needed_not_negative);
    column("strain", &StabilityRow::strain, Domain::real);
    column("outcome", &StabilityRow::outcome, Domain::text);
    column("path", &StabilityRow::path, Domain::text);
    column("beta", &StabilityRow::beta, Domain::real);
    column("beta_lower", &StabilityRow::lower, Domain::real);
    column("wave", &StabilityRow::wave, Domain::text);
    column("waves", &StabilityRow::waves, Domain::text);
    column("k1", &StabilityRow::k1, Domain::real);
    column("k2", &StabilityRow::k2, Domain::real);
    column("angle_deg", &StabilityRow::angle, Domain::real);
    column("scale", &StabilityRow::scale, Domain::text);
    column("cells_1", &StabilityRow::cells_1, Domain::needed_not_negative);
    column("cells_2", &StabilityRow::cells_2, Domain::needed_not_negative);
    column("long_waves", &StabilityRow::long_waves, Domain::text);
    column("acoustic", &StabilityRow::acoustic, Domain::real);
    column("held_to", &StabilityRow::held_to, Domain::real);
    column("lost_at", &StabilityRow::lost_at, Domain::real);
    column("strain_bar", &StabilityRow::strain_bar, Domain::not_negative);
    column("energy_periodic_N_per_m", &StabilityRow::energy_periodic, Domain::real);
    column("energy_N_per_m", &StabilityRow::energy, Domain::real);
    column("less_energy", &StabilityRow::less_energy, Domain::real);
    column("largest_per_cell", &StabilityRow::largest, Domain::not_negative);
    column("x_m", &StabilityRow::x, Domain::real);
    column("y_m", &StabilityRow::y, Domain::real);
    column("u_real", &StabilityRow::u_real, Domain::real);
    column("u_imaginary", &StabilityRow::u_imaginary, Domain::real);
    column("v_real", &StabilityRow::v_real, Domain::real);
    column("v_imaginary", &StabilityRow::v_imaginary, Domain::real);
  }
};
} // namespace homespun::verification
