// SPDX-License-Identifier: MIT
#include "shell/solver/equilibrium.h"

#include "meshes/plain/epsilon.h"
#include "meshes/plain/errors.h"
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
std::vector<bool> marked(const Eigen::Index n_nodes, const meshes::Triangles &triangles,
                         const std::vector<int> &held_vertices)
{
  const auto n_vertices  = static_cast<int>(n_nodes),
             n_triangles = static_cast<int>(triangles.rows());
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
  for (int t = 0; t < n_triangles; ++t)
    for (int k = 0; k < 2; ++k)
      part[static_cast<std::size_t>(root(triangles(t, k)))] = root(triangles(t, k + 1));
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

Membrane with_cubic(Membrane membrane, const std::vector<meshes::CubicForm> &cubic)
{
  add_cubic_energy(membrane, cubic);
  return membrane;
}

/// The forces at the free vertices: their norm, and the norm at which they count as zero.
template <int dim>
struct FreeForces
{
  Positions<dim> free_gradient; ///< held rows zero
  double norm = 0., accepted = 0., energy_round_off = 0.;
};

/// @param loads (n,dim) [N]
template <int dim, typename Sheet>
FreeForces<dim> residual_at(const Sheet &membrane, const std::vector<bool> &is_held,
                            const Positions<dim> &positions, const Positions<dim> &loads,
                            const double relative_tolerance)
{
  MembraneGradient<dim> force = membrane_gradient<dim>(membrane, positions);
  force.gradient -= loads;
  force.magnitude += loads.rowwise().norm();
  for (std::size_t v = 0; v < is_held.size(); ++v)
    if (is_held[v])
      force.gradient.row(static_cast<Eigen::Index>(v)).setZero();
  FreeForces<dim> residual;
  residual.norm             = force.gradient.norm();
  residual.accepted         = relative_tolerance * force.magnitude.norm() + force.round_off.norm();
  residual.energy_round_off = force.energy_round_off;
  residual.free_gradient    = std::move(force.gradient);
  return residual;
}

template <int dim>
int count_inverted(const Membrane &membrane, const Positions<dim> &positions)
{
  int n = 0;
  if constexpr (dim == 2)
    for (int t = 0; t < static_cast<int>(membrane.triangles.rows()); ++t)
    {
      const auto x = [&](const int k) { return positions.row(membrane.triangles(t, k)); };
      const Eigen::Vector2d a = (x(1) - x(0)).transpose(), b = (x(2) - x(0)).transpose();
      n += a(0) * b(1) - a(1) * b(0) <= 0.;
    }
  return n;
}

/// Points of six-node triangles.
template <int dim>
int count_inverted(const SixNodeMembrane &membrane, const Positions<dim> &positions)
{
  return count_inverted<dim>(membrane.points, corners_of_points<dim>(membrane, positions));
}

void require_rows(const Eigen::Index found, const std::size_t expected, const std::string &name)
{
  if (found != static_cast<Eigen::Index>(expected))
    throw meshes::BadInput(name + ": has " + std::to_string(found) + " rows; expected " +
                           std::to_string(expected) + ", one per vertex");
}

/// A load for every vertex, zero where none are given.
template <int dim>
Positions<dim> all_loads(const Positions<dim> &loads, const std::size_t n_vertices)
{
  if (loads.rows() == 0)
    return Positions<dim>::Zero(static_cast<Eigen::Index>(n_vertices), dim);
  require_rows(loads.rows(), n_vertices, "loads");
  if (const int v = first_not_finite<dim>(loads); v >= 0)
    throw meshes::BadInput("vertex " + std::to_string(v) + ": its load is not finite");
  return loads;
}
} // namespace

template <int dim, typename Sheet>
MembraneSolver<dim, Sheet>::MembraneSolver(Sheet sheet, const std::vector<int> &held_vertices)
    : membrane(std::move(sheet))
    , is_held(marked(membrane.vertices.rows(), membrane.triangles, held_vertices))
    , matrix(membrane.triangles, is_held)
{
}

template <int dim, typename Sheet>
MembraneSolver<dim, Sheet>::MembraneSolver(const meshes::TriangleMesh &rest,
                                           std::vector<Eigen::Matrix3d> stiffness_of_phase,
                                           const std::vector<int> &held_vertices,
                                           const std::vector<meshes::CubicForm> &cubic)
    : MembraneSolver(with_cubic(shell::membrane(rest, stiffness_of_phase), cubic), held_vertices)
{
}

template <int dim, typename Sheet>
const Sheet &MembraneSolver<dim, Sheet>::rest_membrane() const
{
  return membrane;
}

template <int dim, typename Sheet>
bool MembraneSolver<dim, Sheet>::factorize_at(const Positions<dim> &positions) const
{
  matrix.clear();
  add_membrane_hessian<dim>(membrane, positions, Hessian::exact, matrix);
  return matrix.factorize();
}

template <int dim, typename Sheet>
Positions<dim> MembraneSolver<dim, Sheet>::linear_equilibrium(const Positions<dim> &prescribed,
                                                              const Positions<dim> &loads) const
{
  require_rows(prescribed.rows(), is_held.size(), "prescribed positions");
  const Positions<dim> all = all_loads<dim>(loads, is_held.size());
  if (!linear_matrix)
  {
    auto made = std::make_unique<FreeVertexMatrix<dim>>(membrane.triangles, is_held);
    add_membrane_hessian<dim>(membrane, membrane.vertices, Hessian::exact, *made);
    if (!made->factorize())
      throw meshes::BadInput(
        "held vertices: they leave a rigid motion of the sheet or of a part of it free, so that "
        "the linear problem has no unique answer; hold at least two vertices of every part");
    linear_matrix = std::move(made);
  }
  Positions<dim> displacement = Positions<dim>::Zero(prescribed.rows(), dim);
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
    const Positions<dim> force = linear_membrane_gradient(membrane, displacement) - all;
    displacement -= linear_matrix->solve(force);
  }
  return membrane.vertices + displacement;
}

template <int dim, typename Sheet>
Positions<dim> MembraneSolver<dim, Sheet>::newton_step(const Positions<dim> &positions,
                                                       const Positions<dim> &gradient,
                                                       int &projected_steps) const
{
  if (factorize_at(positions))
    return -matrix.solve(gradient);
  ++projected_steps;
  matrix.clear();
  add_membrane_hessian<dim>(membrane, positions, Hessian::projected, matrix);
  // In the projected Hessian directions without stiffness remain, such as those out of the plane of
  // a flat sheet: the shift leaves them at rest where no force acts along them.
  double shift = 0.;
  while (!matrix.factorize(shift) && shift < 1e6 * matrix.mean_diagonal())
    shift = std::max(10. * shift, 1e-10 * matrix.mean_diagonal());
  return -matrix.solve(gradient);
}

template <int dim, typename Sheet>
Equilibrium<dim> MembraneSolver<dim, Sheet>::solve_equilibrium(const Positions<dim> &start,
                                                               const EquilibriumOptions &options,
                                                               const Positions<dim> &loads) const
{
  require_rows(start.rows(), is_held.size(), "start positions");
  const Positions<dim> all = all_loads<dim>(loads, is_held.size());
  if (const int v = first_not_finite<dim>(start); v >= 0)
    throw meshes::BadInput("vertex " + std::to_string(v) + ": its start position is not finite");

  Equilibrium<dim> result;
  result.positions = start;
  result.energy    = membrane_energy<dim>(membrane, start);
  if (!std::isfinite(result.energy))
    throw meshes::BadInput("start positions: their energy is not finite, they lie too far apart");
  FreeForces<dim> residual =
    residual_at<dim>(membrane, is_held, start, all, options.relative_tolerance);
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
    const Positions<dim> step =
      newton_step(result.positions, residual.free_gradient, result.projected_steps);
    const double slope = step.cwiseProduct(residual.free_gradient).sum();

    // Sufficient decrease of the energy, up to what rounding the positions changes it by.
    bool accepted = false;
    for (double length = 1.; slope < 0. && length > 1e-10 && !accepted; length *= 0.5)
    {
      const Positions<dim> trial = result.positions + length * step;
      const double energy        = membrane_energy<dim>(membrane, trial);
      const double work          = length * step.cwiseProduct(all).sum(); // of the loads
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
    residual =
      residual_at<dim>(membrane, is_held, result.positions, all, options.relative_tolerance);
    ++result.iterations;
  }
  result.inverted_triangles = count_inverted<dim>(membrane, result.positions);
  return result;
}

// Member by member: the linear problem exists in the plane only.
template class MembraneSolver<2>;
template MembraneSolver<2, SixNodeMembrane>::MembraneSolver(SixNodeMembrane,
                                                            const std::vector<int> &);
template const SixNodeMembrane &MembraneSolver<2, SixNodeMembrane>::rest_membrane() const;
template bool MembraneSolver<2, SixNodeMembrane>::factorize_at(const Positions<2> &) const;
template Positions<2>
MembraneSolver<2, SixNodeMembrane>::linear_equilibrium(const Positions<2> &,
                                                       const Positions<2> &) const;
template Equilibrium<2> MembraneSolver<2, SixNodeMembrane>::solve_equilibrium(
  const Positions<2> &, const EquilibriumOptions &, const Positions<2> &) const;
template MembraneSolver<3>::MembraneSolver(const meshes::TriangleMesh &,
                                           std::vector<Eigen::Matrix3d>, const std::vector<int> &,
                                           const std::vector<meshes::CubicForm> &);
template MembraneSolver<3>::MembraneSolver(Membrane, const std::vector<int> &);
template const Membrane &MembraneSolver<3>::rest_membrane() const;
template bool MembraneSolver<3>::factorize_at(const Positions<3> &) const;
template Equilibrium<3> MembraneSolver<3>::solve_equilibrium(const Positions<3> &,
                                                             const EquilibriumOptions &,
                                                             const Positions<3> &) const;
} // namespace homespun::shell
