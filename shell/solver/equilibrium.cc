// SPDX-License-Identifier: MIT
#include "shell/solver/equilibrium.h"

#include "meshes/plain/epsilon.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/triangle_kinematics.h"
#include "shell/membrane/six_node_membrane.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace homespun::shell
{
namespace
{
/// Marks the held vertices, and makes sure that every other one hangs on one of them.
std::vector<bool> marked(const Eigen::Index n_nodes, const PlaneMatrix::Elements &elements,
                         const std::vector<int> &held_vertices)
{
  const auto n_vertices = static_cast<int>(n_nodes);
  if (held_vertices.empty())
    throw meshes::BadInput(
      "held vertices: none is given; expected at least one, else the cloth can move away without "
      "any force");
  std::vector<bool> is_held(static_cast<std::size_t>(n_vertices), false);
  for (const int v : held_vertices)
  {
    if (v < 0 || v >= n_vertices)
      throw meshes::BadInput("held vertex " + std::to_string(v) +
                             ": does not exist; expected 0 ... " + std::to_string(n_vertices - 1));
    is_held[static_cast<std::size_t>(v)] = true;
  }
  std::vector<int> part(is_held.size());
  std::iota(part.begin(), part.end(), 0);
  const auto root = [&](int v)
  {
    while (part[static_cast<std::size_t>(v)] != v)
      v = part[static_cast<std::size_t>(v)] =
        part[static_cast<std::size_t>(part[static_cast<std::size_t>(v)])];
    return v;
  };
  for (Eigen::Index e = 0; e < elements.rows(); ++e)
    for (Eigen::Index k = 0; k + 1 < elements.cols(); ++k)
      part[static_cast<std::size_t>(root(elements(e, k)))] = root(elements(e, k + 1));
  std::vector<bool> has_held(is_held.size(), false);
  for (int v = 0; v < n_vertices; ++v)
    if (is_held[static_cast<std::size_t>(v)])
      has_held[static_cast<std::size_t>(root(v))] = true;
  for (int v = 0; v < n_vertices; ++v)
    if (!has_held[static_cast<std::size_t>(root(v))])
      throw meshes::BadInput(
        "vertex " + std::to_string(v) +
        ": no triangles connect it to a held vertex; hold a vertex of its part, "
        "or remove the part");
  return is_held;
}

/// The forces at the free vertices: their norm, and the norm at which they count as zero.
struct FreeForces
{
  Positions<2> free_gradient; ///< held rows zero
  double norm = 0., accepted = 0., energy_round_off = 0.;
};

/// @param loads (n,2) [N]
template <typename Sheet>
FreeForces residual_at(const Sheet &membrane, const std::vector<bool> &is_held,
                       const Positions<2> &positions, const Positions<2> &loads,
                       const double relative_tolerance)
{
  MembraneGradient<2> force = membrane_gradient<2>(membrane, positions);
  force.gradient -= loads;
  force.magnitude += loads.rowwise().norm();
  for (std::size_t v = 0; v < is_held.size(); ++v)
    if (is_held[v])
      force.gradient.row(static_cast<Eigen::Index>(v)).setZero();
  FreeForces residual;
  residual.norm             = force.gradient.norm();
  residual.accepted         = relative_tolerance * force.magnitude.norm() + force.round_off.norm();
  residual.energy_round_off = force.energy_round_off;
  residual.free_gradient    = std::move(force.gradient);
  return residual;
}

int count_inverted(const Membrane &membrane, const Positions<2> &positions)
{
  int n = 0;
  for (int t = 0; t < static_cast<int>(membrane.triangles.rows()); ++t)
    n += !(meshes::sides_of_triangle<2>(membrane.triangles.row(t), positions).determinant() > 0.);
  return n;
}

/// Points of six-node triangles.
int count_inverted(const SixNodeMembrane &membrane, const Positions<2> &positions)
{
  return count_inverted(membrane.points, corners_of_points<2>(membrane, positions));
}

void require_rows(const Eigen::Index found, const std::size_t expected, const std::string &name)
{
  if (found != static_cast<Eigen::Index>(expected))
    throw meshes::BadInput(name + ": has " + std::to_string(found) + " rows; expected " +
                           std::to_string(expected) + ", one per vertex");
}

/// A load for every vertex, zero where none are given.
Positions<2> all_loads(const Positions<2> &loads, const std::size_t n_vertices)
{
  if (loads.rows() == 0)
    return Positions<2>::Zero(static_cast<Eigen::Index>(n_vertices), 2);
  require_rows(loads.rows(), n_vertices, "loads");
  if (const int v = first_not_finite<2>(loads); v >= 0)
    throw meshes::BadInput("vertex " + std::to_string(v) + ": its load is not finite");
  return loads;
}
} // namespace

template <typename Sheet>
MembraneSolver<Sheet>::MembraneSolver(Sheet sheet, const std::vector<int> &held_vertices)
    : membrane(std::move(sheet))
    , is_held(marked(membrane.vertices.rows(), membrane.triangles, held_vertices))
    , matrix(membrane.triangles, is_held)
{
}

template <typename Sheet>
bool MembraneSolver<Sheet>::factorize_at(const Positions<2> &positions) const
{
  matrix.clear();
  add_membrane_hessian(membrane, positions, Hessian::exact, matrix);
  return matrix.factorize();
}

template <typename Sheet>
Positions<2> MembraneSolver<Sheet>::solve_linear(const Positions<2> &prescribed,
                                                 const Positions<2> &loads) const
{
  require_rows(prescribed.rows(), is_held.size(), "prescribed positions");
  const Positions<2> all = all_loads(loads, is_held.size());
  if (!linear_matrix)
  {
    auto made = std::make_unique<PlaneMatrix>(membrane.triangles, is_held);
    add_membrane_hessian(membrane, membrane.vertices, Hessian::exact, *made);
    if (!made->factorize())
      throw meshes::BadInput(
        "held vertices: they leave a rigid motion of the sheet or of a part of it free, so that "
        "the linear problem has no unique answer; hold at least two vertices of every part");
    linear_matrix = std::move(made);
  }
  Positions<2> displacement = Positions<2>::Zero(prescribed.rows(), 2);
  for (std::size_t v = 0; v < is_held.size(); ++v)
    if (const auto row = static_cast<Eigen::Index>(v); is_held[v])
    {
      if (!prescribed.row(row).allFinite())
        throw meshes::BadInput("held vertex " + std::to_string(v) +
                               ": its prescribed position is not finite");
      displacement.row(row) = prescribed.row(row) - membrane.vertices.row(row);
    }
  // K u − f, element by element, so that the coupling of held to free vertices needs no matrix; the
  // second pass refines the first, which matters at high stiffness contrast.
  for (int pass = 0; pass < 2; ++pass)
  {
    const Positions<2> force = linear_membrane_gradient(membrane, displacement) - all;
    displacement -= linear_matrix->solve(force);
  }
  return membrane.vertices + displacement;
}

template <typename Sheet>
Positions<2> MembraneSolver<Sheet>::newton_step(const Positions<2> &positions,
                                                const Positions<2> &gradient,
                                                int &projected_steps) const
{
  if (factorize_at(positions))
    return -matrix.solve(gradient);
  ++projected_steps;
  matrix.clear();
  add_membrane_hessian(membrane, positions, Hessian::projected, matrix);
  // In the projected Hessian directions without stiffness remain, such as those out of the plane of
  // a flat sheet: the shift leaves them at rest where no force acts along them.
  const double size = matrix.mean_diagonal();
  double shift      = 0.;
  while (!matrix.factorize(shift) && shift < 1e6 * size)
    shift = std::max(10. * shift, 1e-10 * size);
  return -matrix.solve(gradient);
}

template <typename Sheet>
Equilibrium MembraneSolver<Sheet>::solve_equilibrium(const Positions<2> &start,
                                                     const EquilibriumOptions &options,
                                                     const Positions<2> &loads) const
{
  require_rows(start.rows(), is_held.size(), "start positions");
  const Positions<2> all = all_loads(loads, is_held.size());
  if (const int v = first_not_finite<2>(start); v >= 0)
    throw meshes::BadInput("vertex " + std::to_string(v) + ": its start position is not finite");

  Equilibrium result;
  result.positions = start;
  result.energy    = membrane_energy<2>(membrane, start);
  if (!std::isfinite(result.energy))
    throw meshes::BadInput("start positions: their energy is not finite, they lie too far apart");
  FreeForces residual = residual_at(membrane, is_held, start, all, options.relative_tolerance);
  while (true)
  {
    result.residual_history.push_back(residual.norm);
    result.residual = residual.norm;
    if (residual.norm <= residual.accepted)
      break;
    if (result.iterations == options.max_iterations)
      throw meshes::NotConverged("equilibrium: " + std::to_string(options.max_iterations) +
                                   " Newton steps leave forces on the free vertices; take smaller "
                                   "load steps or start closer",
                                 result.residual_history);
    const Positions<2> step =
      newton_step(result.positions, residual.free_gradient, result.projected_steps);
    const double slope = step.cwiseProduct(residual.free_gradient).sum();

    // Sufficient decrease of the energy, up to what rounding the positions changes it by.
    bool accepted = false;
    for (double length = 1.; slope < 0. && length > 1e-10 && !accepted; length *= 0.5)
    {
      const Positions<2> trial = result.positions + length * step;
      const double energy      = membrane_energy<2>(membrane, trial);
      const double work        = length * step.cwiseProduct(all).sum(); // of the loads
      const double slack =
        16. * meshes::epsilon * (result.energy + std::abs(work)) + residual.energy_round_off;
      if (energy - work <= result.energy + 1e-4 * length * slope + slack)
      {
        accepted         = true;
        result.positions = trial;
        result.energy    = energy;
      }
    }
    if (!accepted)
      throw meshes::NotConverged(
        "equilibrium: no step along the Newton direction lowers the energy",
        result.residual_history);
    residual = residual_at(membrane, is_held, result.positions, all, options.relative_tolerance);
    ++result.iterations;
  }
  result.inverted_triangles = count_inverted(membrane, result.positions);
  return result;
}

template class MembraneSolver<Membrane>;
template class MembraneSolver<SixNodeMembrane>;
} // namespace homespun::shell
