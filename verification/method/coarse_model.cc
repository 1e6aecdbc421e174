// SPDX-License-Identifier: MIT
#include "verification/method/coarse_model.h"

#include "meshes/plain/errors.h"
#include "verification/reference/free_sides.h"

#include <cassert>

namespace homespun::verification
{
namespace
{
/// The corotational law with a cubic energy; its tangent is that of the energy at the strain, but
/// for what the cubic stress itself turns: good enough for steps of Newton's method.
Response response_with(const shell::GuardedCubic &cubic, const Eigen::Matrix3d &C,
                       const Eigen::Matrix2d &F)
{
  const Eigen::Vector3d e = shell::biot_strain<2>(F);
  const Eigen::Matrix2d P = shell::energy_gradient<2>(F, C, cubic.gradient(e));
  Response result         = response(Law::biot, C + cubic.hessian(e), F);
  result.stress << P(0, 0), P(0, 1), P(1, 0), P(1, 1);
  return result;
}

std::vector<meshes::CubicForm> cubic_of(const meshes::HomogenizedCell &cell, const Method &method,
                                        const Law law)
{
  if (!method.is_of_second_order(law))
    return {};
  const auto found = cell.second_order.find(name_of(law));
  if (found == cell.second_order.end())
    throw meshes::BadInput("method " + method.name +
                           ": the cell has no second order under the law `" + name_of(law) +
                           "`: make its cell.h5 again with `homespun homogenize`, or leave the "
                           "method out");
  if (!method.has(Term::cubic))
    return {};
  return {found->second.energy};
}
} // namespace

Method CoarseModel::used(const Method &method, const Law law, const Load &load,
                         const meshes::Sheet &sheet, const CellModel &cell,
                         const int quads_per_cell)
{
  Method left = method.under(law, load);
  if (!CoarseSpace::fits(sheet, element_of(left), quads_per_cell))
    left = left.without(Term::p2);
  return cell.edges == nullptr ? left.without(Term::edges) : left;
}

CoarseModel::CoarseModel(const CellModel &cell, const meshes::Sheet &sheet, const Load &given,
                         const Method &asked, const Law law, const int quads_per_cell)
    : law(law)
    , method(used(asked, law, given, sheet, cell, quads_per_cell))
    , cell(cell)
    , sheet(sheet)
    , space(sheet, element_of(method), quads_per_cell)
    , load(with_own_sides(given))
    , held(held_vertices(load, sheet, mesh().vertices))
    , solver(space.solver(cell.cell.stiffness, held, cubic_of(cell.cell, method, law)))
    , options(method.options(law))
{
  if (method.has(Term::edges))
    edges.emplace(cell, sheet, load, space.grid, law);
  if (!method.has(Term::micro))
    return;
  if (method.has_fitted_modes(law))
    options.fitted = cell.fitted;
  if (edges)
    edges->give_edges(options);
}

/// A load with free sides, whose strains are those of the coarse cloth's own energy.
Load CoarseModel::with_own_sides(const Load &given) const
{
  if (!given.has_free_sides())
    return given;
  const Eigen::Matrix3d C                     = cell.cell.stiffness;
  const Law own_law                           = homogenized_law(law, C);
  const std::vector<meshes::CubicForm> energy = cubic_of(cell.cell, method, law);
  if (energy.empty())
    return given.with_free_strains([=](const double strain)
                                   { return free_strains_of(given, own_law, C, strain); });
  const shell::GuardedCubic cubic(energy.front(), C);
  return given.with_free_strains(
    [=](const double strain)
    {
      return free_strains_of(
        given, [&](const Eigen::Matrix2d &F) { return response_with(cubic, C, F); }, C, strain);
    });
}

void CoarseModel::put_held(const Positions &prescribed, Positions &positions) const
{
  for (const int v : held)
    positions.row(v) = prescribed.row(v);
}

shell::Equilibrium<2> CoarseModel::equilibrium(const Positions &start) const
{
  if (law != Law::linear)
    return solver->solve_equilibrium(law, start);
  shell::Equilibrium<2> result;
  result.positions  = solver->solve_linear(start);
  result.iterations = 1;
  return result;
}

CoarseState CoarseModel::solve(const double strain, const CoarseState *const earlier) const
{
  CoarseState state;
  state.strain    = strain;
  state.positions = moved_affinely(load, sheet, mesh().vertices, strain);
  if (!load.is_periodic())
  {
    Positions start = state.positions;
    if (earlier != nullptr)
    {
      assert(earlier->strain > 0.);
      // The prescribed motion is proportional to strain, so held vertices end where they should.
      const Positions displacement = earlier->without_edges - mesh().vertices;
      start                        = mesh().vertices + strain / earlier->strain * displacement;
      put_held(state.positions, start);
    }
    const shell::Equilibrium<2> found = equilibrium(start);
    state.positions                   = found.positions;
    state.iterations                  = found.iterations;
  }
  state.without_edges = state.positions;
  if (edges)
  {
    const shell::Equilibrium<2> moved = with_edges(*edges, space, *solver, state.without_edges);
    state.positions                   = moved.positions;
    state.iterations += moved.iterations;
  }
  return state;
}

LoadForces CoarseModel::forces(const CoarseState &state) const
{
  return load_forces(load, sheet, mesh().vertices, solver->gradient(law, state.without_edges));
}

meshes::Points CoarseModel::upsample(const CoarseState &state) const
{
  localization::Upsampler<2, double>::Fine fine;
  upsampler<double>().upsample(on_grid(state), fine);
  return fine;
}
} // namespace homespun::verification
