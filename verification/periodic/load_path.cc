// SPDX-License-Identifier: MIT
#include "verification/periodic/load_path.h"

#include "meshes/plain/errors.h"
#include "verification/periodic/periodic_path.h"

#include <Eigen/Cholesky>

#include <array>
#include <cmath>
#include <limits>

namespace homespun::verification
{
namespace
{
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
  PeriodicPath states(assembly, control, {1., 3});
  for (int step = 1; step <= n_steps; ++step)
  {
    const double factor = static_cast<double>(step) / n_steps;
    try
    {
      const CellEquilibrium &state = states.at(factor);
      if (const Eigen::Matrix2d &F = state.gradient;
          !(F.determinant() > 0. && F(0, 0) > 0. && F(1, 1) > 0.))
      {
        path.why = "the equilibrium that Newton's method found is a cloth turned inside out: is "
                   "the stress in N/m?";
        return path;
      }
      path.last = state;
    }
    catch (const meshes::NotConverged &failure)
    {
      path.why = failure.what();
      return path;
    }
    path.levels.push_back({factor, control.strain(path.last.gradient),
                           control.stress(path.last.stress), path.last.energy,
                           is_stable(assembly, control.dead_loads(factor), path.last)});
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
  const Eigen::Matrix4d tangent      = macro_tangent(assembly, at_rest(assembly));
  constexpr std::array<int, 3> place = {0, 3, 1};
  Eigen::Matrix3d C;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      C(static_cast<long>(a), static_cast<long>(b)) = tangent(place[a], place[b]);
  return C;
}
} // namespace homespun::verification
