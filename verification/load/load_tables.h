// SPDX-License-Identifier: MIT
// The tables of `homespun load`: a row per level of a path, and the measured curves beside them.
#pragma once

#include "verification/record/table.h"

#include <limits>
#include <string>

namespace homespun::verification
{
/// A level of the path of an infinite cloth. Strains and nominal stresses as in load_control.h.
struct LoadRow
{
  static constexpr const char *file   = "load.csv";
  static constexpr std::size_t n_keys = 4;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  std::string cell, law;
  /// `resolved`: the cell with its phases, on its given mesh; `coarse`: C^H in place of it, what a
  /// coarse cloth feels.
  std::string method;
  int step         = 0;                                        ///< from 1
  double factor    = 0.;                                       ///< part of what is prescribed
  double strain_11 = none, strain_22 = none, strain_12 = none; ///< [-]
  double stress_11 = none, stress_22 = none, stress_12 = none; ///< [N/m]
  /// How far the mesh leaves them from the limit of fine ones: 1.25 |this mesh - once refined| /
  /// (1 - 2^-q), q the order of the energy that the corners of the cell leave; zero of what is
  /// prescribed.
  double strain_11_bar = none, strain_22_bar = none, strain_12_bar = none;
  double stress_11_bar = none, stress_22_bar = none, stress_12_bar = none;
  double energy = none; ///< per rest area [N/m]
  bool stable   = false;

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &LoadRow::cell, Domain::name);
    column("law", &LoadRow::law, Domain::name);
    column("method", &LoadRow::method, Domain::name);
    column("step", &LoadRow::step, Domain::positive);
    column("factor", &LoadRow::factor, Domain::positive);
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

/// A point of a curve that somebody measured, taken over from the file of --measured.
struct MeasuredRow
{
  static constexpr const char *file   = "measured.csv";
  static constexpr std::size_t n_keys = 2;

  std::string curve;    ///< name of the file, without its ending
  int point        = 0; ///< from 1
  double strain_11 = LoadRow::none, strain_22 = LoadRow::none, strain_12 = LoadRow::none; ///< [-]
  double stress_11 = LoadRow::none, stress_22 = LoadRow::none,
         stress_12 = LoadRow::none; ///< [N/m]

  template <typename Column>
  static void columns(Column &&column)
  {
    column("curve", &MeasuredRow::curve, Domain::name);
    column("point", &MeasuredRow::point, Domain::positive);
    column("strain_11", &MeasuredRow::strain_11, Domain::real);
    column("strain_22", &MeasuredRow::strain_22, Domain::real);
    column("strain_12", &MeasuredRow::strain_12, Domain::real);
    column("stress_11_N_per_m", &MeasuredRow::stress_11, Domain::real);
    column("stress_22_N_per_m", &MeasuredRow::stress_22, Domain::real);
    column("stress_12_N_per_m", &MeasuredRow::stress_12, Domain::real);
  }
};
} // namespace homespun::verification
