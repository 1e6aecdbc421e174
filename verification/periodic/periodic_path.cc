// SPDX-License-Identifier: MIT
#include "verification/periodic/periodic_path.h"

#include "meshes/plain/errors.h"
#include "verification/newton/halved_parts.h"

#include <cmath>
#include <iterator>

namespace homespun::verification
{
PeriodicPath::PeriodicPath(const CellAssembly &assembly, const LoadControl &control,
                           const PathSteps steps)
    : assembly(assembly)
    , control(control)
    , steps(steps)
    , known{{0., at_rest(assembly)}}
{
}

std::pair<PeriodicPath::Known::const_iterator, PeriodicPath::Known::const_iterator>
PeriodicPath::nearest(const double factor) const
{
  auto first = known.end(), second = known.end();
  const auto is_nearer = [&](const auto &a, const auto &b)
  { return b == known.end() || std::abs(a->first - factor) < std::abs(b->first - factor); };
  for (auto place = known.begin(); place != known.end(); ++place)
    if (is_nearer(place, first))
    {
      second = first;
      first  = place;
    }
    else if (is_nearer(place, second))
      second = place;
  return {first, second};
}

CellEquilibrium PeriodicPath::guess(const double factor) const
{
  const auto [first, second] = nearest(factor);
  CellEquilibrium state      = first->second;
  Eigen::Vector3d strain     = control.strain(state.gradient);
  if (second != known.end())
  {
    const double part = (factor - first->first) / (first->first - second->first);
    state.fluctuation += part * (state.fluctuation - second->second.fluctuation);
    strain += part * (strain - control.strain(second->second.gradient));
  }
  return prescribed(std::move(state), strain, factor);
}

/// The state at strains of which those that are prescribed have their own value.
CellEquilibrium PeriodicPath::prescribed(CellEquilibrium state, Eigen::Vector3d strain,
                                         const double factor) const
{
  for (long k = 0; k < 3; ++k)
    if (!control.is_stress[static_cast<std::size_t>(k)])
      strain(k) = factor * control.value(k);
  state.gradient = control.gradient(strain);
  return state;
}

const CellEquilibrium &PeriodicPath::at(const double factor)
{
  while (true)
  {
    if (const auto found = known.find(factor); found != known.end())
      return found->second;
    const double begin = nearest(factor).first->first, way = factor - begin;
    const double next =
      std::abs(way) <= 1.5 * steps.longest ? factor : begin + std::copysign(steps.longest, way);
    const GoneWay gone =
      go_in_halves(steps.most_halvings,
                   [&](double, const double part)
                   {
                     const double there    = part == 1. ? next : begin + part * (next - begin);
                     CellEquilibrium trial = guess(there);
                     find_equilibrium(assembly, control.dead_loads(there), trial);
                     known[there] = trial;
                   });
    if (gone.reached < 1.)
      throw meshes::NotConverged(*gone.failure);
  }
}

std::optional<double> PeriodicPath::left_at(const double sign) const
{
  // Equilibria are found to round-off; where there are two, they are apart by parts of the cell.
  const double same = 1e-6 * std::sqrt(assembly.cell.lattice.area());
  for (auto before = known.find(0.), end = known.end(); before != end;)
  {
    auto next = before;
    if (sign < 0. ? next == known.begin() : std::next(next) == end)
      break;
    sign < 0. ? --next : ++next;
    CellEquilibrium back =
      prescribed(next->second, control.strain(next->second.gradient), before->first);
    try
    {
      find_equilibrium(assembly, control.dead_loads(before->first), back);
      if ((back.fluctuation - before->second.fluctuation).cwiseAbs().maxCoeff() > same)
        return next->first;
    }
    catch (const meshes::NotConverged &) // tells nothing
    {
    }
    before = next;
  }
  return {};
}
} // namespace homespun::verification
