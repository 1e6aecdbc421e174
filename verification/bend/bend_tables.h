// SPDX-License-Identifier: MIT
// The tables of a study of bending.
#pragma once

#include "verification/record/table.h"

#include <limits>
#include <string>

namespace homespun::verification
{
/// bend.csv: the distance of one method from one reference under one load, in position and normal,
/// means over the vertices. The load is told by the curvature that it makes in linear theory. There
/// all are proportional to it and solved once, and turns are small; at large turns (`biot`) the
/// sheet bends less, to curvature_per_m.
struct BendRow
{
  static constexpr const char *file   = "bend.csv";
  static constexpr std::size_t n_keys = 5;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  std::string cell, load;
  /// Of the homogenized sheet in linear theory, root mean square, x cell side [-].
  double bending = 0.;
  std::string reference, method;
  int cells           = 0;    ///< per side of the sheet
  double side         = none; ///< of the cell, sqrt(|Y|) [m]
  int macro_triangles = 0;    ///< of the homogenized sheet
  int fine_triangles  = 0;    ///< of the reference
  double curvature    = none; ///< of the homogenized sheet, root mean square [1/m]
  double deflection   = none; ///< of the reference [m]
  double mean         = none; ///< of the position [m]
  double bar          = none; ///< of that mean: by finer meshes of cell, sheet and macro sheet [m]
  double interior     = none; ///< mean over vertices of no cell at an edge [m]
  double edge         = none; ///< mean over the others [m]
  double normal       = none; ///< distance of the unit normals, of small angles the angle [rad]
  double normal_bar   = none; ///< [rad]
  double normal_interior   = none; ///< [rad]
  double normal_edge       = none; ///< [rad]
  double seconds           = none; ///< of the homogenized sheets and all methods
  double seconds_reference = none;

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &BendRow::cell, Domain::name);
    column("load", &BendRow::load, Domain::name);
    column("curvature_times_cell", &BendRow::bending, Domain::positive);
    column("reference", &BendRow::reference, Domain::name);
    column("method", &BendRow::method, Domain::name);
    column("cells", &BendRow::cells, Domain::positive);
    column("cell_side_m", &BendRow::side, Domain::positive);
    column("macro_triangles", &BendRow::macro_triangles, Domain::positive);
    column("fine_triangles", &BendRow::fine_triangles, Domain::positive);
    column("curvature_per_m", &BendRow::curvature, Domain::positive);
    column("deflection_mean_m", &BendRow::deflection, Domain::not_negative);
    column("error_mean_m", &BendRow::mean, Domain::not_negative);
    column("error_bar_m", &BendRow::bar, Domain::not_negative);
    column("error_interior_m", &BendRow::interior, Domain::not_negative);
    column("error_edge_m", &BendRow::edge, Domain::not_negative);
    column("normal_error_mean_rad", &BendRow::normal, Domain::not_negative);
    column("normal_error_bar_rad", &BendRow::normal_bar, Domain::not_negative);
    column("normal_error_interior_rad", &BendRow::normal_interior, Domain::not_negative);
    column("normal_error_edge_rad", &BendRow::normal_edge, Domain::not_negative);
    column("seconds_methods", &BendRow::seconds, Domain::not_negative);
    column("seconds_reference", &BendRow::seconds_reference, Domain::not_negative);
  }
};

/// wrinkles.csv: the compression along an axis of the lattice, and the wavelength, at which an
/// infinite sheet on an elastic foundation leaves its plane; resolved on one cell, and by D^H.
/// Where no such wave was found what is resolved is empty.
struct WrinkleRow
{
  static constexpr const char *file   = "wrinkles.csv";
  static constexpr std::size_t n_keys = 3;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  std::string cell;
  int axis                       = 1;
  int cells_per_wave             = 0;    ///< of D^H
  double foundation              = none; ///< T (pi/L)^2 of a sheet of length L pulled by T [N/m^3]
  double wavelength              = none; ///< [m]
  double wavelength_bar          = none; ///< by a finer mesh [m]
  double homogenized_wavelength  = none; ///< of D^H [m]
  double compression             = none; ///< [N/m]
  double compression_bar         = none; ///< by a finer mesh [N/m]
  double homogenized_compression = none; ///< of D^H [N/m]
  double most_compression        = none; ///< guaranteed: of a wave without fluctuation [N/m]

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &WrinkleRow::cell, Domain::name);
    column("axis", &WrinkleRow::axis, Domain::positive);
    column("cells_per_wave", &WrinkleRow::cells_per_wave, Domain::positive);
    column("foundation_N_per_m3", &WrinkleRow::foundation, Domain::positive);
    column("wavelength_m", &WrinkleRow::wavelength, Domain::positive);
    column("wavelength_bar_m", &WrinkleRow::wavelength_bar, Domain::not_negative);
    column("homogenized_wavelength_m", &WrinkleRow::homogenized_wavelength, Domain::positive);
    column("compression_N_per_m", &WrinkleRow::compression, Domain::positive);
    column("compression_bar_N_per_m", &WrinkleRow::compression_bar, Domain::not_negative);
    column("homogenized_compression_N_per_m", &WrinkleRow::homogenized_compression,
           Domain::positive);
    column("most_compression_N_per_m", &WrinkleRow::most_compression, Domain::positive);
  }
};
} // namespace homespun::verification
