// SPDX-License-Identifier: MIT
#include "verification/load/load_path.h"

#include "meshes/plain/errors.h"
#include "verification/newton/halved_parts.h"

#include <Eigen/Cholesky>

#include <array>
#include <cmath>
#include <limits>

namespace homespun::verification
{
namespace
{
constexpr int most_halvings = 3;

/// Points of the path, by their factor.
struct Point
{
  double factor;
  CellEquilibrium state;
};

CellEquilibrium at_rest(const CellAssembly &assembly)
{
  return {Eigen::Matrix2d::Identity(), meshes::Points::Zero(assembly.cell.mesh.n_vertices(), 2)};
}

/// On the line through two points; strains that are prescribed have their own value.
CellEquilibrium extrapolated(const Point &before, const Point &last, const LoadControl &control,
                             const double factor)
{
  CellEquilibrium state = last.state;
  if (last.factor > before.factor)
  {
    const double part = (factor - last.factor) / (last.factor - before.factor);
    state.gradient += part * (last.state.gradient - before.state.gradient);
    state.fluctuation += part * (last.state.fluctuation - before.state.fluctuation);
  }
  Eigen::Vector3d strain = control.strain(state.gradient);
  for (std::size_t k = 0; k < 3; ++k)
    if (const auto place = static_cast<long>(k); !control.is_stress[k])
      strain(place) = factor * control.value(place);
  state.gradient = control.gradient(strain);
  return state;
}

bool is_stable(const CellAssembly &assembly, const DeadLoads &loads, const CellEquilibrium &state)
{
  const Eigen::Matrix4d tangent = macro_tangent(assembly, state);
  if (!tangent.allFinite())
    return false;
  const Eigen::MatrixXd free = loads.directions.transpose() * tangent * loads.directions;
  return free.size() == 0 || Eigen::LLT<Eigen::MatrixXd>(free).info() == Eigen::Success;
}
} // namespace

LoadPath load_path(const CellAssembly &assembly, const LoadControl &control, const int n_steps)
{
  LoadPath path;
  Point last{0., at_rest(assembly)};
  Point before = last;
  for (int step = 1; step <= n_steps; ++step)
  {
    const double begin = last.factor, goal = static_cast<double>(step) / n_steps;
    const GoneWay way =
      go_in_halves(most_halvings,
                   [&](double, const double part)
                   {
                     const double next = part == 1. ? goal : begin + part * (goal - begin);
                     Point trial{next, extrapolated(before, last, control, next)};
                     find_equilibrium(assembly, control.dead_loads(next), trial.state);
                     before = last;
                     last   = trial;
                   });
    if (way.reached < 1.)
    {
      path.why = way.failure->what();
      return path;
    }
    path.last = last.state;
    path.levels.push_back({goal, control.strain(last.state.gradient),
                           control.stress(last.state.stress), last.state.energy,
                           is_stable(assembly, control.dead_loads(goal), last.state)});
  }
  return path;
}

WorkCheck check_work(const CellAssembly &assembly, const LoadControl &control, const LoadPath &path)
{
  const LoadLevel &level = path.levels.back();
  // Along the strains, whose derivative by their factor they are themselves.
  const auto energy = [&](const double factor)
  {
    CellEquilibrium state = path.last;
    state.gradient        = control.gradient(factor * level.strain);
    try
    {
      find_equilibrium(assembly, {}, state);
      return state.energy;
    }
    catch (const meshes::NotConverged &)
    {
      return std::numeric_limits<double>::quiet_NaN();
    }
  };
  constexpr double h  = 1e-3;
  const double narrow = (energy(1. + h) - energy(1. - h)) / (2. * h);
  const double wide   = (energy(1. + 2. * h) - energy(1. - 2. * h)) / (4. * h);
  const double work   = level.stress.dot(level.strain);
  // Energies are sums over the triangles, known to 1e-14 of their size; and rounded gradients,
  // which near rest are 1 and a small number, move them too.
  const double moved =
    assembly.sums(path.last.gradient, path.last.fluctuation, Tangent::none).energy_round_off;
  return {work, std::abs(narrow - work),
          std::abs(wide - narrow) + (1e-14 * level.energy + 2. * moved) / h};
}

Eigen::Matrix3d stiffness_at_rest(const CellAssembly &assembly)
{
  CellEquilibrium state              = at_rest(assembly);
  const Eigen::Matrix4d tangent      = macro_tangent(assembly, state);
  constexpr std::array<int, 3> place = {0, 3, 1};
  Eigen::Matrix3d C;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      C(static_cast<long>(a), static_cast<long>(b)) = tangent(place[a], place[b]);
  return C;
}
} // namespace homespun::verification
