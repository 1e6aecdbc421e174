// SPDX-License-Identifier: MIT
#include "verification/bloch/margin_path.h"

#include "meshes/plain/errors.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace homespun::verification
{
namespace
{
constexpr double closest_sides = 1e-4; ///< of the strain of first loss
constexpr int most_cells       = 4;    ///< of a supercell along a lattice vector

/// The least eigenvalue of the acoustic tensors of a tangent, relative to those at rest.
double acoustic_margin(const Eigen::Matrix4d &tangent, const Eigen::Matrix4d &rest)
{
  if (!tangent.allFinite())
    return StabilityRow::none;
  double least = std::numeric_limits<double>::infinity();
  for (const Wave &wave : waves_of_the_zone())
  {
    if (wave.kind != Wave::Kind::long_limit)
      continue;
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

/// Walks along a load.
class Walk
{
public:
  Walk(const CellAssembly &assembly, const BlochMargin &bloch, const Load &load)
      : assembly(assembly)
      , bloch(bloch)
      , path(assembly, load)
      , rest(macro_tangent(assembly, path.at(0.)))
  {
  }

  MarginLevel level(const double strain, const MarginLevel &near)
  {
    const CellEquilibrium &state = path.at(strain);
    return {strain, state, bloch.of(state, &near.margin)};
  }

  StabilityRow row(const MarginLevel &level) const
  {
    const Margin &margin = level.margin;
    const bool is_long   = margin.wave.kind == Wave::Kind::long_limit;
    StabilityRow row;
    row.strain = level.strain;
    row.beta   = margin.beta;
    row.lower  = margin.lower;
    row.waves  = is_long ? "long" : "finite";
    row.scale  = is_long ? "macro" : "micro";
    if (is_long)
      row.angle = 180. / M_PI * margin.wave.angle;
    else
    {
      row.k1                      = margin.wave.k(0);
      row.k2                      = margin.wave.k(1);
      const Eigen::Vector2i cells = supercell_of(margin.wave, most_cells);
      row.cells_1                 = cells(0);
      row.cells_2                 = cells(1);
    }
    row.state    = margin.beta < 0. ? "unstable-proved" : "stable-up-to-mesh";
    row.acoustic = acoustic_margin(macro_tangent(assembly, level.state), rest);
    MarginSearch search(bloch.waves(),
                        assembly.vertex_tangent(level.state.gradient, level.state.fluctuation));
    const std::vector<Wave> all = waves_of_the_zone();
    row.long_waves_stable =
      std::all_of(all.begin(), all.end(),
                  [&](const Wave &wave)
                  { return wave.kind != Wave::Kind::long_limit || search.is_above(wave, 0.); });
    return row;
  }

private:
  const CellAssembly &assembly;
  const BlochMargin &bloch;
  StrainPath path;
  const Eigen::Matrix4d rest;
};

/// Brings the last stable and the first unstable level together.
void bisect(Walk &walk, MarginLevel &held, MarginLevel &lost)
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
    const MarginLevel next                = walk.level(held.strain + part * width, lost);
    (next.margin.beta < 0. ? lost : held) = next;
  }
}
} // namespace

MarginPath margin_path(const CellAssembly &assembly, const BlochMargin &bloch, const Load &load,
                       const std::vector<double> &strains)
{
  Walk walk(assembly, bloch, load);
  MarginPath path;
  MarginLevel last = walk.level(0., {});
  path.shown       = last;
  path.loss.way    = strains.back() < 0. ? "pressed" : "pulled";
  bool is_lost     = false;
  for (const double strain : strains)
  {
    MarginLevel level;
    try
    {
      level = walk.level(strain, last);
    }
    catch (const meshes::NotConverged &failure)
    {
      path.why = failure.what();
      StabilityRow row;
      row.strain = strain;
      row.state  = "not-reached";
      path.rows.push_back(row);
      break;
    }
    path.rows.push_back(walk.row(level));
    if (!is_lost && level.margin.beta < 0.)
    {
      is_lost          = true;
      MarginLevel lost = level;
      bisect(walk, last, lost);
      path.shown        = lost;
      path.loss.held_to = last.strain;
      path.loss.lost_at = lost.strain;
      const double beta = last.margin.beta;
      path.loss.strain =
        last.strain + (lost.strain - last.strain) * beta / (beta - lost.margin.beta);
    }
    last = level;
    if (!is_lost)
    {
      path.shown        = level;
      path.loss.held_to = level.strain;
    }
  }
  const StabilityRow row = walk.row(path.shown);
  path.loss.wave         = path.shown.margin.wave.text();
  path.loss.waves        = row.waves;
  path.loss.k1           = row.k1;
  path.loss.k2           = row.k2;
  path.loss.angle        = row.angle;
  path.loss.scale        = row.scale;
  path.loss.cells_1      = row.cells_1;
  path.loss.cells_2      = row.cells_2;
  path.loss.outcome      = is_lost ? "lost" : path.why.empty() ? "held" : "ended";
  return path;
}

std::vector<ZoneRow> zone_of(const CellAssembly &assembly, const BlochMargin &bloch,
                             const MarginLevel &level)
{
  MarginSearch search(bloch.waves(),
                      assembly.vertex_tangent(level.state.gradient, level.state.fluctuation));
  std::vector<ZoneRow> rows;
  for (const Wave &wave : waves_of_the_zone())
  {
    ZoneRow row;
    row.waves  = wave.kind == Wave::Kind::long_limit ? "long" : "finite";
    row.k1     = wave.k(0);
    row.k2     = wave.k(1);
    row.angle  = 180. / M_PI * wave.angle;
    row.strain = level.strain;
    row.beta   = search.lowered(search.start({wave}), {wave}).beta;
    rows.push_back(row);
  }
  return rows;
}

std::vector<ModeRow> mode_of(const CellAssembly &assembly, const MarginLevel &level)
{
  std::vector<ModeRow> rows;
  const Mode &mode                 = level.margin.mode;
  const meshes::TriangleMesh &mesh = assembly.cell.mesh;
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
    ModeRow row;
    row.vertex = v;
    row.strain = level.strain;
    const Eigen::RowVector2d place =
      mesh.vertices.row(v) * level.state.gradient.transpose() + level.state.fluctuation.row(v);
    row.x                        = place(0);
    row.y                        = place(1);
    const std::complex<double> u = mode(2 * v) / unit, w = mode(2 * v + 1) / unit;
    row.u_real      = u.real();
    row.u_imaginary = u.imag();
    row.v_real      = w.real();
    row.v_imaginary = w.imag();
    rows.push_back(row);
  }
  return rows;
}
} // namespace homespun::verification
