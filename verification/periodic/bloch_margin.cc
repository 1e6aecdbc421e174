// SPDX-License-Identifier: MIT
#include "verification/periodic/bloch_margin.h"

#include <algorithm>
#include <utility>

namespace homespun::verification
{
namespace
{
/// Waves around one, a step of the zone away.
std::vector<Wave> around(const Wave &wave, const double step)
{
  constexpr double right_angle = 1.57079632679489662;
  if (wave.is_long())
    return {long_wave(wave.angle + right_angle * step * 4. / 3.),
            long_wave(wave.angle - right_angle * step * 4. / 3.)};
  std::vector<Wave> waves;
  for (const auto &[i, j] :
       {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}})
    if (const Wave next = bloch_wave(wave.k(0) + i * step, wave.k(1) + j * step);
        (next.k - next.k.array().round().matrix()).cwiseAbs().maxCoeff() > 1e-9) // no translation
      waves.push_back(next);
  return waves;
}
} // namespace

BlochMargin::BlochMargin(CellAssembly of_cell)
    : assembly(std::move(of_cell))
    , pencil(assembly.cell, stiffness(at_rest(assembly)))
{
}

CellAssembly::Sparse BlochMargin::stiffness(const CellEquilibrium &state) const
{
  return assembly.vertex_tangent(state.gradient, state.fluctuation);
}

MarginSearch BlochMargin::search(const CellEquilibrium &state) const
{
  return {pencil, stiffness(state)};
}

Margin BlochMargin::of(const CellEquilibrium &state, const Margin *near) const
{
  const CellAssembly::Sparse there = stiffness(state);
  MarginSearch search(pencil, there);
  Margin margin = search.start(long_waves());
  if (near && near->mode.size() == there.rows())
    if (const double beta = pencil.quotient(there, near->mode); beta < margin.beta)
    {
      margin      = *near;
      margin.beta = beta;
    }
  margin = search.lowered(margin, waves_of_the_zone());
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
  MarginSearch of_state = search(state);
  return of_state.lowered(of_state.start(waves), waves);
}
} // namespace homespun::verification
