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
} // namespace

Method CoarseModel::used(const Method &method, const Law law, const Load &load,
                         const meshes::Sheet &sheet, const CellModel &cell,
                         const std::optional<Quads> &quads)
{
  Method left = under(method, law, load);
  if (!CoarseSpace::fits(sheet, element_of(left), quads))
    left = left.without(Term::p2);
  return cell.edges == nullptr ? left.without(Term::edges) : left;
}

CoarseModel::CoarseModel(const CellModel &cell, const meshes::Sheet &sheet, const Load &given,
                         const Method &asked, const Law law, const std::optional<Quads> &quads)
    : law(law)
    , method(used(asked, law, given, sheet, cell, quads))
    , cell(cell)
    , sheet(sheet)
    , parts(cell, sheet, method, law, method.has(Term::edges) ? edge_kinds(given) : EdgeKinds(),
            quads)
    , load(with_own_sides(given))
    , held(held_vertices(load, sheet, mesh().vertices))
    , solver(parts.space.solver(cell.cell.stiffness, law, held, parts.cubic))
{
}

/// A load with free sides, whose strains are those of the coarse cloth's own energy.
Load CoarseModel::with_own_sides(const Load &given) const
{
  if (!given.has_free_sides())
    return given;
  const Eigen::Matrix3d C = cell.cell.stiffness;
  const Law own_law       = homogenized_law(law, C);
  if (parts.cubic.empty())
    return given.with_free_strains([=](const double strain)
                                   { return free_strains_of(given, own_law, C, strain); });
  const shell::GuardedCubic cubic(parts.cubic.front(), C);
  return given.with_free_strains(
    [=](const double strain)
    {
      return free_strains_of(
        given, [&](const Eigen::Matrix2d &F) { return response_with(cubic, C, F); }, C, strain);
    });
}

CoarseState CoarseModel::solve(const double strain, const CoarseState *const earlier,
                               const shell::EquilibriumOptions &options) const
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
      for (const int v : held)
        start.row(v) = state.positions.row(v);
    }
    const shell::Equilibrium found = solver->solve(start, {}, options);
    state.positions                = found.positions;
    state.iterations               = found.iterations;
  }
  state.without_edges = state.positions;
  return parts.edges ? with_edges(*parts.edges, state) : state;
}

CoarseState CoarseModel::with_edges(const EdgeTerms<2> &terms, CoarseState state) const
{
  const Positions &before = state.without_edges, &rest = mesh().vertices;
  const Positions slip = terms.slip(before), forces = terms.forces(before);
  const bool is_linear           = law == Law::linear;
  const shell::Equilibrium moved = solver->solve((is_linear ? rest : before) + slip, forces);
  state.positions                = is_linear ? before + (moved.positions - rest) : moved.positions;
  state.iterations += moved.iterations;
  return state;
}

LoadForces CoarseModel::forces(const CoarseState &state) const
{
  return load_forces(load, sheet, mesh().vertices, solver->gradient(state.without_edges));
}

meshes::Points CoarseModel::upsample(const CoarseState &state) const
{
  localization::Upsampler<2, double>::Fine fine;
  upsampler<double>().upsample(on_grid(state), fine);
  return fine;
}
} // namespace homespun::verification
