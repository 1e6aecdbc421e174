// SPDX-License-Identifier: MIT
#include "verification/method/lightweight_cloth.h"

#include "meshes/plain/errors.h"
#include "shell/membrane/yarn_energy.h"
#include "verification/reference/free_sides.h"

#include <algorithm>
#include <array>

namespace homespun::verification
{
using localization::UpsamplerOptions;

namespace
{
/// The laws of the reference against which a method says something of its own.
enum class OfLaws
{
  all,
  nonlinear,
  second_order,           ///< that have one
  second_order_or_linear, ///< where it falls back to its other parts
  fitted,
  fitted_yarns, ///< `yarn` alone, whose modes reach where no second order does
  yarns
};

struct KnownMethod
{
  const char *name;
  CoarseChoice coarse;
  bool has_edges;
  OfLaws laws = OfLaws::all;
};

constexpr auto quadratic = CoarseEnergy::quadratic, cubic = CoarseEnergy::cubic;
constexpr auto three = CoarseElement::three_nodes, six = CoarseElement::six_nodes;

constexpr std::array<KnownMethod, 12> known_methods = {
  {{"affine", {quadratic, three}, false},
   {"localized", {quadratic, three}, false},
   {"quadratic", {cubic, three}, false, OfLaws::second_order},
   {"edges", {quadratic, three}, true},
   {"p2", {quadratic, six}, false},
   {"full", {cubic, six}, true, OfLaws::second_order_or_linear},
   {"first-order", {quadratic, six}, true, OfLaws::yarns},
   {"fitted", {cubic, three}, false, OfLaws::fitted},
   {"full-fitted", {quadratic, six}, true, OfLaws::fitted_yarns},
   {"localized-affine-lift", {quadratic, three}, false, OfLaws::nonlinear},
   {"localized-mean-anchor", {quadratic, three}, false},
   {"localized-piecewise", {quadratic, three}, false}}};

const KnownMethod &known(const std::string &name)
{
  const auto found = std::find_if(known_methods.begin(), known_methods.end(),
                                  [&](const KnownMethod &each) { return name == each.name; });
  if (found != known_methods.end())
    return *found;
  throw meshes::BadInput("unknown method `" + name + "`; expected " +
                         meshes::one_of(Method::names()));
}
} // namespace

const std::vector<std::string> &Method::names()
{
  static const std::vector<std::string> all = []()
  {
    std::vector<std::string> names;
    for (const KnownMethod &each : known_methods)
      names.emplace_back(each.name);
    return names;
  }();
  return all;
}

Method::Method(const std::string &name)
    : name(name)
    , of_coarse(known(name).coarse)
    , has_edges(known(name).has_edges)
    , has_fitted(known(name).laws == OfLaws::fitted || known(name).laws == OfLaws::fitted_yarns)
{
}

UpsamplerOptions Method::options(const Law law) const
{
  UpsamplerOptions options;
  options.microscopic = name != "affine";
  if (law == Law::linear)
  {
    options.strain = localization::Strain::linear;
    options.lift   = localization::Lift::identity;
  }
  else if (name == "localized-affine-lift")
    options.lift = localization::Lift::affine;
  // Fitted modes, in their place, belong to a study.
  if (is_of_second_order(law) && !has_fitted)
    options.second_order = name_of(law);
  if (name == "localized-mean-anchor" || has_edge_terms())
    options.anchor = localization::Anchor::mean;
  if (name == "localized-piecewise")
    options.blend = localization::Blend::piecewise;
  return options;
}

bool Method::is_of_second_order(const Law law) const
{
  // The cubic energy of a weave reaches a tenth of a per cent, its fitted modes go beyond.
  return is_of_second_order() && law != Law::linear && !(has_fitted && law == Law::yarn);
}

bool Method::has_fitted_modes(const Law law) const
{
  return has_fitted && law != Law::linear &&
         (law == Law::yarn || known(name).laws == OfLaws::fitted);
}

CoarseChoice Method::coarse(const Law law) const
{
  return {is_of_second_order(law) ? CoarseEnergy::cubic : CoarseEnergy::quadratic,
          of_coarse.element};
}

bool Method::has_meaning(const Law law) const
{
  switch (known(name).laws)
  {
  case OfLaws::nonlinear:
    return law != Law::linear;
  case OfLaws::second_order:
    return is_of_second_order(law);
  case OfLaws::second_order_or_linear:
    return is_of_second_order(law) || law == Law::linear;
  case OfLaws::fitted:
  case OfLaws::fitted_yarns:
    return has_fitted_modes(law);
  case OfLaws::yarns:
    return is_of_yarns(law);
  case OfLaws::all:
    break;
  }
  return true;
}

Method Method::without_edge_terms() const
{
  Method less    = *this;
  less.has_edges = false;
  return less;
}

Method Method::without_six_nodes() const
{
  Method less            = *this;
  less.of_coarse.element = CoarseElement::three_nodes;
  return less;
}

namespace
{
/// The law of yarns with a cubic energy.
Response response_with(const shell::GuardedCubic &cubic, const meshes::YarnAxes &yarns,
                       const Eigen::Matrix2d &F)
{
  const Eigen::Matrix2d P = shell::yarn_energy_gradient<2>(F, yarns, &cubic);
  const Eigen::Matrix4d A = shell::yarn_energy_hessian<2>(F, yarns, shell::Hessian::exact, &cubic);
  const Eigen::PermutationMatrix<4> row_by_row(Eigen::Vector4i(0, 2, 1, 3)); // from columns of F
  Response result;
  result.energy = shell::yarn_energy_density<2>(F, yarns, &cubic);
  result.stress << P(0, 0), P(0, 1), P(1, 0), P(1, 1);
  result.tangent = row_by_row.transpose() * A * row_by_row;
  return result;
}

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

/// A load with free sides, whose strains are those of the coarse cloth's own energy.
Load LightweightCloth::with_own_sides(const Load &load, const Eigen::Matrix3d &stiffness,
                                      const std::shared_ptr<Sides> &sides)
{
  if (!load.has_free_sides())
    return load;
  return load.with_free_strains(
    [load, stiffness, sides](const double strain)
    {
      if (!sides->cubic)
        return free_strains_of(load, sides->law, stiffness, strain);
      return free_strains_of(
        load,
        [&](const Eigen::Matrix2d &F)
        {
          return sides->yarns.are_there ? response_with(*sides->cubic, sides->yarns, F)
                                        : response_with(*sides->cubic, stiffness, F);
        },
        stiffness, strain);
    });
}

LightweightCloth::LightweightCloth(const meshes::HomogenizedCell &cell, const meshes::Sheet &sheet,
                                   const Load &load, const CoarseChoice choice)
    : coarse(meshes::coarse_sheet(sheet.origin, sheet.lattice.vectors, sheet.n1, sheet.n2))
    , cell(cell)
    , sheet(sheet)
    , choice(choice)
    , space(sheet, choice.element)
    , own_sides(std::make_shared<Sides>())
    , load(with_own_sides(load, cell.stiffness, own_sides))
    , solver(made_solver({}))
{
}

std::unique_ptr<CoarseSolver>
LightweightCloth::made_solver(const std::vector<meshes::CubicForm> &cubic) const
{
  return space.solver(cell.stiffness, held_vertices(load, sheet, coarse.vertices), cubic);
}

/// Each law has its own cubic energy, in the same strain.
void LightweightCloth::take_cubic(const Law law)
{
  if (choice.energy == CoarseEnergy::quadratic || law == law_of_cubic)
    return;
  const auto found = cell.second_order.find(name_of(law));
  if (found == cell.second_order.end())
    throw meshes::BadInput("cell: has no cubic energy under the law `" + name_of(law) +
                           "`, which methods of second order ask for: make its cell.h5 again with "
                           "`homespun homogenize`, or leave the method out");
  const std::vector<meshes::CubicForm> cubic = {found->second.energy};
  own_sides->yarns                           = homogenized_law(law, cell.stiffness) == Law::yarn
                                                 ? meshes::yarn_axes(cell.stiffness)
                                                 : meshes::YarnAxes();
  own_sides->cubic =
    own_sides->yarns.are_there
      ? std::make_unique<shell::GuardedCubic>(
          shell::cubic_of_yarn_strain(cubic.front(), own_sides->yarns), own_sides->yarns.C)
      : std::make_unique<shell::GuardedCubic>(cubic.front(), cell.stiffness);
  solver       = made_solver(cubic);
  law_of_cubic = law;
}

void LightweightCloth::put_held(const shell::Positions<2> &prescribed,
                                shell::Positions<2> &positions) const
{
  for (const int v : held_vertices(load, sheet, coarse.vertices))
    positions.row(v) = prescribed.row(v);
}

LoadForces LightweightCloth::forces_at(const Law law, const shell::Positions<2> &positions) const
{
  return load_forces(load, sheet, coarse.vertices, solver->gradient(law, positions));
}

shell::Positions<2> LightweightCloth::near(const CoarseStep &step, const Law law,
                                           const double strain) const
{
  own_sides->law            = homogenized_law(law, cell.stiffness);
  shell::Positions<2> moved = moved_affinely(load, sheet, coarse.vertices, strain);
  if (load.is_periodic())
    return moved;
  shell::Positions<2> start = step.positions;
  put_held(moved, start);
  return law == Law::linear ? solver->solve_linear(start)
                            : solver->solve_equilibrium(law, start).positions;
}

CoarseStep LightweightCloth::solve(const Law law, const double strain)
{
  CoarseStep step;
  take_cubic(law);
  own_sides->law = homogenized_law(law, cell.stiffness);
  step.positions = moved_affinely(load, sheet, coarse.vertices, strain);
  if (load.is_periodic())
  {
    step.forces = forces_at(law, step.positions);
    return step;
  }
  shell::Positions<2> start = step.positions;
  if (last_strain > 0. && last_law == law)
  {
    // The prescribed motion is proportional to strain, so held vertices end where they should.
    start = coarse.vertices + strain / last_strain * last_displacement;
    put_held(step.positions, start);
  }
  step.seconds = median_seconds(
    [&]()
    {
      if (law == Law::linear)
      {
        step.positions  = solver->solve_linear(start);
        step.iterations = 1;
      }
      else
      {
        const shell::Equilibrium<2> equilibrium = solver->solve_equilibrium(law, start);
        step.positions                          = equilibrium.positions;
        step.iterations                         = equilibrium.iterations;
      }
    });
  step.forces       = forces_at(law, step.positions);
  last_displacement = step.positions - coarse.vertices;
  last_strain       = strain;
  last_law          = law;
  return step;
}

UpsampledSheet LightweightCloth::upsample(const Method &method, const Law law,
                                          const shell::Positions<2> &coarse_positions,
                                          const meshes::FittedModes *const fitted) const
{
  UpsamplerOptions options = method.options(law);
  options.fitted           = fitted;
  const auto on_grid       = [&]() { return space.on_grid<2>(coarse_positions); };
  UpsampledSheet result;
  localization::Upsampler<2, double>::Fine in_double;
  localization::Upsampler<2, double>(cell, space.grid.mesh, sheet, options)
    .upsample(on_grid(), in_double);
  result.positions = in_double;

  const localization::Upsampler<2, float> in_float(cell, space.grid.mesh, sheet, options);
  localization::Upsampler<2, float>::Fine fine;
  in_float.upsample(on_grid(), fine); // memory and caches, as in every frame but the first
  result.seconds = median_seconds([&]() { in_float.upsample(on_grid(), fine); });
  return result;
}
} // namespace homespun::verification
