// SPDX-License-Identifier: MIT
#include "verification/periodic/supercell.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/sheet.h"

#include <cmath>
#include <complex>

namespace homespun::verification
{
Supercell::Supercell(const meshes::HomogenizedCell &one, const Eigen::Vector2i &n)
    : n(n)
{
  const meshes::Sheet sheet = meshes::tile(one.mesh, one.lattice, n(0), n(1));
  cell.mesh                 = sheet.mesh;
  cell.lattice.vectors      = n.cast<double>().asDiagonal() * one.lattice.vectors;
  cell.anchor               = meshes::anchor_vertex(cell.mesh, cell.lattice);
  cell_vertex               = sheet.cell_vertex;
  of_lattice.resize(cell.mesh.n_vertices(), 2);
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
    of_lattice.row(v) =
      one.lattice.fractional(cell.mesh.vertices.row(v) - one.mesh.vertices.row(cell_vertex(v)))
        .array()
        .round()
        .cast<int>();
}

std::vector<Wave> Supercell::waves() const
{
  std::vector<Wave> result;
  for (int i = 0; i < n(0); ++i)
    for (int j = 0; j < n(1); ++j)
    {
      const int other = ((n(0) - i) % n(0)) * n(1) + (n(1) - j) % n(1); // −k
      if (const int here = i * n(1) + j; here > 0 && here <= other)
        result.push_back(bloch_wave(static_cast<double>(i) / n(0), static_cast<double>(j) / n(1)));
    }
  return result;
}

CellEquilibrium Supercell::repeated(const CellEquilibrium &state) const
{
  CellEquilibrium all = state;
  all.fluctuation.resize(cell.mesh.n_vertices(), 2);
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
    all.fluctuation.row(v) =
      state.fluctuation.row(cell_vertex(v)) - state.fluctuation.row(cell_vertex(cell.anchor));
  return all;
}

meshes::Points Supercell::real_part(const Mode &mode, const Wave &wave) const
{
  // The phase of a field is free: that which makes it real where it can be.
  const double turn = -0.5 * std::arg(mode.cwiseProduct(mode).sum());
  meshes::Points u(cell.mesh.n_vertices(), 2);
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
  {
    const double phase =
      2. * M_PI * of_lattice.row(v).cast<double>().dot(wave.k.transpose()) + turn;
    u.row(v) = (std::polar(1., phase) * mode.segment<2>(2 * cell_vertex(v))).real().transpose();
  }
  const Eigen::RowVector2d held = u.row(cell.anchor);
  u.rowwise() -= held;
  return u / u.rowwise().norm().maxCoeff();
}

std::optional<Pattern> followed_pattern(const BlochMargin &one, const Supercell &supercell,
                                        const CellEquilibrium &state, const DeadLoads &loads)
{
  Pattern pattern;
  pattern.wave = one.of(state, supercell.waves());
  if (pattern.wave.beta >= 0. || pattern.wave.mode.size() == 0)
    return {};
  const CellAssembly all(supercell.cell, one.assembly.stiffness_of_phase, one.assembly.law);
  pattern.periodic     = supercell.repeated(state);
  const auto energy_of = [&](const CellEquilibrium &at)
  { return all.sums(at.gradient, at.fluctuation, Tangent::none).energy; };
  pattern.periodic.energy   = energy_of(pattern.periodic);
  const meshes::Points wave = supercell.real_part(pattern.wave.mode, pattern.wave.wave);
  const double side         = std::sqrt(all.cell.lattice.area() / supercell.n.prod());
  // As much of the wave as takes most energy away: from there Newton's method only goes down.
  double best = pattern.periodic.energy;
  for (double part = 0.1; part > 1e-5; part *= 0.5)
  {
    CellEquilibrium trial = pattern.periodic;
    trial.fluctuation += part * side * wave;
    if (const double energy = energy_of(trial); energy < best)
    {
      best          = energy;
      pattern.state = trial;
    }
  }
  if (best >= pattern.periodic.energy)
    throw meshes::NotConverged("pattern: no part of the wave lowers the energy", {});
  find_equilibrium(all, loads, pattern.state);
  return pattern;
}
} // namespace homespun::verification
