// SPDX-License-Identifier: MIT
#include "verification/bloch/bloch_margin.h"

#include <algorithm>

namespace homespun::verification
{
namespace
{
/// Waves around one, a step of the zone away.
std::vector<Wave> around(const Wave &wave, const double step)
{
  constexpr double right_angle = 1.57079632679489662;
  if (wave.kind == Wave::Kind::long_limit)
    return {long_wave(wave.angle + right_angle * step * 4. / 3.),
            long_wave(wave.angle - right_angle * step * 4. / 3.)};
  std::vector<Wave> waves;
  for (const auto &[i, j] :
       {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}})
    if (const Wave next = bloch_wave(wave.k(0) + i * step, wave.k(1) + j * step);
        next.k != Eigen::Vector2d::Zero())
      waves.push_back(next);
  return waves;
}
} // namespace

BlochMargin::BlochMargin(const CellAssembly &assembly)
    : assembly(assembly)
    , pencil(assembly.cell,
             assembly.vertex_tangent(Eigen::Matrix2d::Identity(),
                                     meshes::Points::Zero(assembly.cell.mesh.n_vertices(), 2)))
{
}

Margin BlochMargin::of(const CellEquilibrium &state, const Margin *near) const
{
  const auto stiffness = assembly.vertex_tangent(state.gradient, state.fluctuation);
  MarginSearch search(pencil, stiffness);
  const std::vector<Wave> all = waves_of_the_zone();
  std::vector<Wave> long_ones;
  for (const Wave &wave : all)
    if (wave.kind == Wave::Kind::long_limit)
      long_ones.push_back(wave);
  Margin margin = search.start(long_ones);
  if (near && near->mode.size() == stiffness.rows())
    if (const double beta = pencil.quotient(stiffness, near->mode); beta < margin.beta)
    {
      margin      = *near;
      margin.beta = beta;
    }
  margin = search.lowered(margin, all);
  for (double step = 1. / 16.; step >= 1. / 128.;)
  {
    const Margin next  = search.lowered(margin, around(margin.wave, step));
    const double lower = std::min(margin.lower, next.lower);
    if (next.beta < margin.beta)
      margin = next; // go on in this direction before the step is halved
    else
      step *= 0.5;
    margin.lower = lower;
  }
  return margin;
}

Margin BlochMargin::of(const CellEquilibrium &state, const std::vector<Wave> &waves) const
{
  MarginSearch search(pencil, assembly.vertex_tangent(state.gradient, state.fluctuation));
  return search.lowered(search.start(waves), waves);
}
} // namespace homespun::verification
