// SPDX-License-Identifier: MIT
#include "verification/periodic/margin_path.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/sheet.h"
#include "verification/periodic/periodic_path.h"
#include "verification/periodic/supercell.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>

namespace homespun::verification
{
namespace
{
constexpr PathSteps of_strain{0.02, 5};
constexpr double closest_sides = 1e-4; ///< of the strain of first loss
constexpr int most_cells       = 4;    ///< of a supercell along a lattice vector

/// The least eigenvalue of the acoustic tensors of a tangent, relative to those at rest.
double acoustic_margin(const Eigen::Matrix4d &tangent, const Eigen::Matrix4d &rest)
{
  if (!tangent.allFinite())
    return StabilityRow::none;
  double least = std::numeric_limits<double>::infinity();
  for (const Wave &wave : long_waves())
  {
    const double c = std::cos(wave.angle), s = std::sin(wave.angle);
    Eigen::Matrix<double, 4, 2> along; // a n^T in the order 11, 12, 21, 22
    along << c, 0., s, 0., 0., c, 0., s;
    const Eigen::Matrix2d there = along.transpose() * tangent * along;
    const Eigen::Matrix2d here  = along.transpose() * rest * along;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> solver(there, here,
                                                                           Eigen::EigenvaluesOnly);
    least = std::min(least, solver.eigenvalues()(0));
  }
  return least;
}

void describe(StabilityRow &row, const Wave &wave)
{
  row.wave  = wave.text();
  row.waves = wave.is_long() ? "long" : "finite";
  row.scale = wave.is_long() ? "macro" : "micro";
  if (wave.is_long())
  {
    row.angle = 180. / M_PI * wave.angle;
    return;
  }
  row.k1                      = wave.k(0);
  row.k2                      = wave.k(1);
  const Eigen::Vector2i cells = supercell_of(wave, most_cells);
  row.cells_1                 = cells(0);
  row.cells_2                 = cells(1);
}

/// @param row of the level, with its names
/// @param rest dP/dF at rest
void describe(StabilityRow &row, const MarginLevel &level, const BlochMargin &bloch,
              const Eigen::Matrix4d &rest)
{
  describe(row, level.margin.wave);
  row.beta            = level.margin.beta;
  row.lower           = level.margin.lower;
  row.outcome         = row.beta < 0. ? "unstable-proved" : "stable-up-to-mesh";
  row.acoustic        = acoustic_margin(macro_tangent(bloch.assembly, level.state), rest);
  row.long_waves      = "stable";
  MarginSearch search = bloch.search(level.state);
  for (const Wave &wave : long_waves())
    if (!search.is_above(wave, 0.))
      row.long_waves = "unstable";
}

/// Brings the last stable and the first unstable level together, as far as states and margins
/// between them are found.
void bisect(const std::function<MarginLevel(double, const MarginLevel &)> &level_at,
            MarginLevel &held, MarginLevel &lost)
{
  for (int step = 0; step < 40; ++step)
  {
    const double width = lost.strain - held.strain;
    if (std::abs(width) <= closest_sides)
      return;
    // Where the line between both is zero, and a little towards the side that is further away: once
    // the line is good, the next two steps are on both sides of the root.
    double part        = held.margin.beta / (held.margin.beta - lost.margin.beta);
    const double aside = 0.4 * closest_sides / std::abs(width);
    part               = std::clamp(part + (part < 0.5 ? aside : -aside), 0.02, 0.98);
    if (step % 4 == 3)
      part = 0.5;
    try
    {
      const MarginLevel next                = level_at(held.strain + part * width, lost);
      (next.margin.beta < 0. ? lost : held) = next;
    }
    catch (const meshes::NotConverged &)
    {
      return; // no closer than that
    }
  }
}

/// Levels from a strain on have left the path, which ended before them, unless it was lost earlier.
void mark_left(MarginPath &path, const double from)
{
  const auto has_left = [from](const double strain) { return std::abs(strain) >= std::abs(from); };
  StabilityRow &loss  = path.loss;
  const bool is_lost_before = loss.outcome == "lost" && !has_left(loss.lost_at);
  for (StabilityRow &row : path.rows)
    if (row.outcome != "not-reached" && has_left(row.strain))
      row.path = "left";
  if (is_lost_before)
    return;
  loss.outcome = "ended";
  loss.held_to = loss.lost_at = loss.strain = StabilityRow::none;
  for (const StabilityRow &row : path.rows)
    if (!has_left(row.strain))
      loss.held_to = row.strain;
}
} // namespace

StabilityRow row_of(const StabilityRow &path, const std::string &kind, const int number,
                    const double strain)
{
  StabilityRow row = path;
  row.kind         = kind;
  row.number       = number;
  row.strain       = strain;
  return row;
}

MarginPath margin_path(const BlochMargin &bloch, const LoadControl &control,
                       const std::vector<double> &strains, const StabilityRow &names)
{
  PeriodicPath states(bloch.assembly, control, of_strain);
  const Eigen::Matrix4d rest = macro_tangent(bloch.assembly, states.at(0.));
  const auto level_at        = [&](const double strain, const MarginLevel &near)
  {
    const CellEquilibrium &state = states.at(strain);
    return MarginLevel{strain, state, bloch.of(state, &near.margin)};
  };
  MarginPath path;
  MarginLevel last  = level_at(0., {});
  path.shown        = last;
  path.loss         = row_of(names, "loss", 0, StabilityRow::none);
  path.loss.outcome = "held";
  for (const double strain : strains)
  {
    StabilityRow row = row_of(names, "level", static_cast<int>(path.rows.size()) + 1, strain);
    MarginLevel level;
    const bool is_lost = path.loss.outcome == "lost";
    try
    {
      level = level_at(strain, last);
    }
    catch (const meshes::NotConverged &)
    {
      row.outcome = "not-reached";
      path.rows.push_back(row);
      if (!is_lost)
        path.loss.outcome = "ended";
      break;
    }
    describe(row, level, bloch, rest);
    path.rows.push_back(row);
    path.levels.push_back(level);
    if (!is_lost && level.margin.beta < 0.)
    {
      MarginLevel lost = level;
      bisect(level_at, last, lost);
      const double beta = last.margin.beta;
      path.loss.outcome = "lost";
      path.loss.held_to = last.strain;
      path.loss.lost_at = lost.strain;
      path.loss.strain =
        last.strain + (lost.strain - last.strain) * beta / (beta - lost.margin.beta);
      path.shown = lost;
    }
    else if (!is_lost)
    {
      path.shown        = level;
      path.loss.held_to = level.strain;
    }
    last = level;
  }
  describe(path.loss, path.shown.margin.wave);
  if (const std::optional<double> left = states.left_at(strains.front() < 0. ? -1. : 1.))
    mark_left(path, *left);
  return path;
}

std::vector<StabilityRow> waves_of(const BlochMargin &bloch, const MarginLevel &level,
                                   const StabilityRow &names)
{
  MarginSearch search = bloch.search(level.state);
  std::vector<StabilityRow> rows;
  for (const Wave &wave : waves_of_the_zone())
  {
    rows.push_back(row_of(names, "wave", static_cast<int>(rows.size()) + 1, level.strain));
    describe(rows.back(), wave);
    try
    {
      rows.back().beta = search.lowered(search.start({wave}), {wave}).beta;
    }
    catch (const meshes::NotConverged &) // the two sides of its beta do not meet: it has none
    {
    }
  }
  return rows;
}

std::vector<StabilityRow> mode_of(const meshes::TriangleMesh &mesh, const MarginLevel &level,
                                  const StabilityRow &names)
{
  std::vector<StabilityRow> rows;
  const Mode &mode = level.margin.mode;
  if (mode.size() != 2 * mesh.n_vertices())
    return rows;
  // Its largest displacement is one, and real along its larger component.
  std::complex<double> unit = 0.;
  double largest            = 0.;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    if (const double size = mode.segment<2>(2 * v).norm(); size > largest)
    {
      largest                       = size;
      const std::complex<double> u0 = mode(2 * v), u1 = mode(2 * v + 1);
      const std::complex<double> u = std::abs(u0) > std::abs(u1) ? u0 : u1;
      unit                         = size * u / std::abs(u);
    }
  for (int v = 0; v < mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d place =
      mesh.vertices.row(v) * level.state.gradient.transpose() + level.state.fluctuation.row(v);
    const std::complex<double> u = mode(2 * v) / unit, w = mode(2 * v + 1) / unit;
    StabilityRow &row = rows.emplace_back(row_of(names, "mode", v, level.strain));
    row.x             = place(0);
    row.y             = place(1);
    row.u_real        = u.real();
    row.u_imaginary   = u.imag();
    row.v_real        = w.real();
    row.v_imaginary   = w.imag();
  }
  return rows;
}

std::vector<StabilityRow> patterns_of(const BlochMargin &bloch, const LoadControl &control,
                                      const std::vector<MarginLevel> &levels,
                                      const std::optional<Eigen::Vector2i> &cells,
                                      const StabilityRow &names)
{
  std::vector<StabilityRow> rows;
  if (!meshes::makes_sheets(bloch.assembly.cell.mesh, bloch.assembly.cell.lattice))
    return rows;
  for (std::size_t k = 0; k < levels.size(); ++k)
  {
    const auto &[strain, state, margin] = levels[k];
    const Eigen::Vector2i n             = cells ? *cells : supercell_of(margin.wave, most_cells);
    if (margin.beta >= 0. || n.prod() == 1)
      continue;
    StabilityRow &row =
      rows.emplace_back(row_of(names, "pattern", static_cast<int>(k) + 1, strain));
    row.outcome = "not-found";
    row.cells_1 = n(0);
    row.cells_2 = n(1);
    try
    {
      const auto found = followed_pattern(bloch, Supercell(bloch.assembly.cell, n), state,
                                          control.dead_loads(strain));
      if (!found)
      {
        row.outcome = "no-wave";
        continue;
      }
      describe(row, found->wave.wave);
      row.cells_1         = n(0);
      row.cells_2         = n(1);
      row.outcome         = found->lower() > 0. ? "found" : "not-found";
      row.beta            = found->wave.beta;
      row.energy_periodic = found->periodic.energy;
      row.energy          = found->state.energy;
      row.less_energy     = found->lower();
      row.largest =
        (found->state.fluctuation - found->periodic.fluctuation).rowwise().norm().maxCoeff() /
        std::sqrt(bloch.assembly.cell.lattice.area());
    }
    catch (const meshes::NotConverged &)
    {
    }
  }
  return rows;
}
} // namespace homespun::verification
