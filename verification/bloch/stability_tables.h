// SPDX-License-Identifier: MIT
// The tables of `homespun stability`.
#pragma once

#include "verification/record/table.h"

#include <limits>
#include <string>

namespace homespun::verification
{
/// The Bloch margin of a periodic state, on one mesh.
struct StabilityRow
{
  static constexpr const char *file   = "stability.csv";
  static constexpr std::size_t n_keys = 5;
  static constexpr double none        = std::numeric_limits<double>::quiet_NaN();

  std::string cell, law, load;
  std::string mesh;             ///< `given` or `refined`, once
  double strain = 0.;           ///< [-], negative where the cloth is pressed
  double beta   = none;         ///< bloch_margin.h [-]; nothing where there is no state
  double lower  = none;         ///< no wave that was asked is below, by Cholesky factors
  std::string waves;            ///< `long` (the limit) or `finite`; empty where there is no state
  double k1 = none, k2 = none;  ///< of a finite wave, in the reciprocal basis
  double angle = none;          ///< of a long one, from axis 1 [degrees]
  std::string scale;            ///< `macro` (long) or `micro` (finite)
  int cells_1 = 0, cells_2 = 0; ///< supercell in which the wave is periodic; 0 x 0 of a long one
  /// `unstable-proved`: a field of the discrete cloth shows it; `stable-up-to-mesh`: no wave that
  /// was asked does, on this mesh; `not-reached`: Newton's method found no state.
  std::string state;
  /// Whether no long wave of the 12 that are asked is lost: of this program's waves; and the least
  /// eigenvalue of their acoustic tensors in the homogenized tangent, relative to rest: by Newton's
  /// matrices. Nothing where the cell itself is no minimum.
  bool long_waves_stable = false;
  double acoustic        = none;

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &StabilityRow::cell, Domain::name);
    column("law", &StabilityRow::law, Domain::name);
    column("load", &StabilityRow::load, Domain::name);
    column("mesh", &StabilityRow::mesh, Domain::name);
    column("strain", &StabilityRow::strain, Domain::real);
    column("beta", &StabilityRow::beta, Domain::real);
    column("beta_lower", &StabilityRow::lower, Domain::real);
    column("waves", &StabilityRow::waves, Domain::text);
    column("k1", &StabilityRow::k1, Domain::real);
    column("k2", &StabilityRow::k2, Domain::real);
    column("angle_deg", &StabilityRow::angle, Domain::real);
    column("scale", &StabilityRow::scale, Domain::text);
    column("cells_1", &StabilityRow::cells_1, Domain::needed_not_negative);
    column("cells_2", &StabilityRow::cells_2, Domain::needed_not_negative);
    column("state", &StabilityRow::state, Domain::name);
    column("long_waves_stable", &StabilityRow::long_waves_stable, Domain::flag);
    column("acoustic", &StabilityRow::acoustic, Domain::real);
  }
};

/// The first loss along a path that is pulled or pressed.
struct LossRow
{
  static constexpr const char *file   = "loss.csv";
  static constexpr std::size_t n_keys = 5;
  static constexpr double none        = StabilityRow::none;

  std::string cell, law, load;
  std::string way;  ///< `pulled` or `pressed`: the sign of the strain
  std::string mesh; ///< `given` or `refined`
  /// `lost`; `held` up to the last strain; `ended`: no state beyond `held_to`.
  std::string outcome;
  double held_to = none; ///< largest strain that is stable up to the mesh [-]
  double lost_at = none; ///< the strain of first loss is between that and this [-]
  double strain  = none; ///< of first loss, by the line between the two [-]
  /// 1.25 |given - refined| / (1 - 2^-q), q the order of the energy that the corners leave.
  double strain_bar = none;
  /// Of the wave that is lost first, or else of the lowest one at the last strain.
  std::string wave;  ///< in words
  std::string waves; ///< as in stability.csv, and so the others
  double k1 = none, k2 = none, angle = none;
  std::string scale;
  int cells_1 = 0, cells_2 = 0;

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &LossRow::cell, Domain::name);
    column("law", &LossRow::law, Domain::name);
    column("load", &LossRow::load, Domain::name);
    column("way", &LossRow::way, Domain::name);
    column("mesh", &LossRow::mesh, Domain::name);
    column("outcome", &LossRow::outcome, Domain::name);
    column("held_to", &LossRow::held_to, Domain::real);
    column("lost_at", &LossRow::lost_at, Domain::real);
    column("strain", &LossRow::strain, Domain::real);
    column("strain_bar", &LossRow::strain_bar, Domain::not_negative);
    column("wave", &LossRow::wave, Domain::text);
    column("waves", &LossRow::waves, Domain::text);
    column("k1", &LossRow::k1, Domain::real);
    column("k2", &LossRow::k2, Domain::real);
    column("angle_deg", &LossRow::angle, Domain::real);
    column("scale", &LossRow::scale, Domain::text);
    column("cells_1", &LossRow::cells_1, Domain::needed_not_negative);
    column("cells_2", &LossRow::cells_2, Domain::needed_not_negative);
  }
};

/// The margin of one wave, at the strain of first loss or else at the last one: the zone.
struct ZoneRow
{
  static constexpr const char *file   = "zone.csv";
  static constexpr std::size_t n_keys = 8;

  std::string cell, law, load, way;
  std::string waves; ///< `long` or `finite`
  double k1 = 0., k2 = 0., angle = 0.;
  double strain = 0.;                 ///< [-]
  double beta   = StabilityRow::none; ///< [-]

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &ZoneRow::cell, Domain::name);
    column("law", &ZoneRow::law, Domain::name);
    column("load", &ZoneRow::load, Domain::name);
    column("way", &ZoneRow::way, Domain::name);
    column("waves", &ZoneRow::waves, Domain::name);
    column("k1", &ZoneRow::k1, Domain::real);
    column("k2", &ZoneRow::k2, Domain::real);
    column("angle_deg", &ZoneRow::angle, Domain::real);
    column("strain", &ZoneRow::strain, Domain::real);
    column("beta", &ZoneRow::beta, Domain::real);
  }
};

/// The lowest field at that strain, at a vertex of the cell.
struct ModeRow
{
  static constexpr const char *file   = "mode.csv";
  static constexpr std::size_t n_keys = 5;

  std::string cell, law, load, way;
  int vertex    = 0;
  double strain = 0.;                   ///< [-]
  double x = 0., y = 0.;                ///< of the periodic state [m]
  double u_real = 0., u_imaginary = 0.; ///< along axis 1, the largest |(u, v)| is 1 [-]
  double v_real = 0., v_imaginary = 0.; ///< along axis 2

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &ModeRow::cell, Domain::name);
    column("law", &ModeRow::law, Domain::name);
    column("load", &ModeRow::load, Domain::name);
    column("way", &ModeRow::way, Domain::name);
    column("vertex", &ModeRow::vertex, Domain::needed_not_negative);
    column("strain", &ModeRow::strain, Domain::real);
    column("x_m", &ModeRow::x, Domain::real);
    column("y_m", &ModeRow::y, Domain::real);
    column("u_real", &ModeRow::u_real, Domain::real);
    column("u_imaginary", &ModeRow::u_imaginary, Domain::real);
    column("v_real", &ModeRow::v_real, Domain::real);
    column("v_imaginary", &ModeRow::v_imaginary, Domain::real);
  }
};
} // namespace homespun::verification
