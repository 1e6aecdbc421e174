// SPDX-License-Identifier: MIT
#include "verification/bloch/strain_path.h"

#include "meshes/plain/errors.h"
#include "verification/newton/halved_parts.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
namespace
{
constexpr double longest_step = 0.02;
constexpr int most_halvings   = 5;
} // namespace

StrainPath::StrainPath(const CellAssembly &assembly, const Load &load)
    : assembly(assembly)
    , load(load)
{
  if (!load.is_periodic())
    throw meshes::BadInput("load: found `" + load.name +
                           "`, which is one of a sheet; expected one of an infinite cloth: "
                           "periodic-11, periodic-22, periodic-12, uniaxial-1 or uniaxial-2");
  if (load.has_free_sides())
  {
    // e and g are F22 and F12, or F11 and F21; no nominal stress works on them.
    loads.directions           = Eigen::Matrix<double, 4, Eigen::Dynamic>::Zero(4, 2);
    loads.stresses             = Eigen::VectorXd::Zero(2);
    const Eigen::Matrix2d rest = load.gradient(0., {0., 0.});
    for (int k = 0; k < 2; ++k)
    {
      const Eigen::Matrix2d along = load.gradient(0., Eigen::Vector2d::Unit(k)) - rest;
      loads.directions.col(k) << along(0, 0), along(0, 1), along(1, 0), along(1, 1);
    }
  }
  known[0.] = {Eigen::Matrix2d::Identity(),
               meshes::Points::Zero(assembly.cell.mesh.n_vertices(), 2)};
}

CellEquilibrium StrainPath::guess(const double strain) const
{
  const auto distance = [&](const auto &a, const auto &b)
  { return std::abs(a->first - strain) < std::abs(b->first - strain); };
  std::vector<std::map<double, CellEquilibrium>::const_iterator> places;
  for (auto place = known.begin(); place != known.end(); ++place)
    places.push_back(place);
  std::sort(places.begin(), places.end(), distance);
  CellEquilibrium state = places[0]->second;
  Eigen::Vector2d free  = Eigen::Vector2d::Zero();
  const auto free_of    = [&](const CellEquilibrium &of)
  {
    const Eigen::Vector4d F(of.gradient(0, 0), of.gradient(0, 1), of.gradient(1, 0),
                            of.gradient(1, 1));
    const Eigen::Vector4d I(1., 0., 0., 1.);
    return Eigen::Vector2d(loads.directions.transpose() * (F - I));
  };
  const bool is_free = load.has_free_sides();
  if (is_free)
    free = free_of(state);
  if (places.size() > 1)
  {
    const double part = (strain - places[0]->first) / (places[0]->first - places[1]->first);
    state.fluctuation += part * (places[0]->second.fluctuation - places[1]->second.fluctuation);
    if (is_free)
      free += part * (free - free_of(places[1]->second));
  }
  state.gradient = is_free ? load.gradient(strain, free) : load.gradient(strain);
  return state;
}

const CellEquilibrium &StrainPath::at(const double strain)
{
  while (true)
  {
    if (const auto found = known.find(strain); found != known.end())
      return found->second;
    double nearest = known.begin()->first;
    for (const auto &[there, state] : known)
      if (std::abs(there - strain) < std::abs(nearest - strain))
        nearest = there;
    const double way = strain - nearest;
    const double next =
      std::abs(way) <= 1.5 * longest_step ? strain : nearest + std::copysign(longest_step, way);
    const GoneWay gone = go_in_halves(most_halvings,
                                      [&](double, const double part)
                                      {
                                        const double there =
                                          part == 1. ? next : nearest + part * (next - nearest);
                                        CellEquilibrium trial = guess(there);
                                        find_equilibrium(assembly, loads, trial);
                                        known[there] = trial;
                                      });
    if (gone.reached < 1.)
      throw meshes::NotConverged(*gone.failure);
  }
}
} // namespace homespun::verification
