// SPDX-License-Identifier: MIT
#include "verification/method/lightweight_cloth.h"

#include "meshes/plain/errors.h"
#include "verification/reference/free_sides.h"

namespace homespun::verification
{
using localization::UpsamplerOptions;

const std::vector<std::string> &Method::names()
{
  static const std::vector<std::string> all = {"affine",
                                               "localized",
                                               "quadratic",
                                               "edges",
                                               "localized-affine-lift",
                                               "localized-mean-anchor",
                                               "localized-piecewise"};
  return all;
}

Method::Method(const std::string &name)
    : name(name)
{
  if (std::find(names().begin(), names().end(), name) == names().end())
    throw meshes::BadInput("unknown method `" + name +
                           "`; expected affine, localized, quadratic, edges, "
                           "localized-affine-lift, localized-mean-anchor or localized-piecewise");
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
  if (is_of_second_order() && has_meaning(law))
    options.second_order = name_of(law);
  if (name == "localized-mean-anchor" || name == "edges")
    options.anchor = localization::Anchor::mean;
  if (name == "localized-piecewise")
    options.blend = localization::Blend::piecewise;
  return options;
}

bool Method::has_meaning(const Law law) const
{
  if (is_of_second_order())
    return law == Law::biot || law == Law::green;
  return law != Law::linear || name != "localized-affine-lift";
}

bool Method::is_of_second_order() const
{
  return name == "quadratic";
}

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
        load, [&](const Eigen::Matrix2d &F) { return response_with(*sides->cubic, stiffness, F); },
        stiffness, strain);
    });
}

LightweightCloth::LightweightCloth(const meshes::HomogenizedCell &cell, const meshes::Sheet &sheet,
                                   const Load &load, const CoarseEnergy energy)
    : coarse(meshes::coarse_sheet(sheet.origin, sheet.lattice.vectors, sheet.n1, sheet.n2))
    , cell(cell)
    , sheet(sheet)
    , energy(energy)
    , own_sides(std::make_shared<Sides>())
    , load(with_own_sides(load, cell.stiffness, own_sides))
    , solvers(made_solvers({}))
{
}

std::unique_ptr<SheetSolvers>
LightweightCloth::made_solvers(const std::vector<meshes::CubicForm> &cubic) const
{
  std::vector<int> held;
  for (int v = 0; v < coarse.n_vertices(); ++v)
    if (!load.is_periodic() && load.holds(sheet.fraction(coarse.vertices.row(v))))
      held.push_back(v);
  shell::Membrane membrane = shell::membrane(coarse, {cell.stiffness});
  shell::add_cubic_energy(membrane, cubic);
  return std::make_unique<SheetSolvers>(std::move(membrane), std::move(held));
}

/// Each law has its own cubic energy, in the same strain.
void LightweightCloth::take_cubic(const Law law)
{
  if (energy == CoarseEnergy::quadratic || law == law_of_cubic)
    return;
  const auto found = cell.second_order.find(name_of(law));
  if (found == cell.second_order.end())
    throw meshes::BadInput("cell: has no cubic energy under the law `" + name_of(law) +
                           "`, which the method `quadratic` asks for: make its cell.h5 again with "
                           "`homespun homogenize`, or leave the method out");
  const std::vector<meshes::CubicForm> cubic = {found->second.energy};
  own_sides->cubic = std::make_unique<shell::GuardedCubic>(cubic.front(), cell.stiffness);
  solvers          = made_solvers(cubic);
  law_of_cubic     = law;
}

/// The affine motion that agrees with what is prescribed.
shell::Positions<2> LightweightCloth::prescribed(const double strain) const
{
  shell::Positions<2> positions = coarse.vertices;
  for (int v = 0; v < coarse.n_vertices(); ++v)
    if (load.is_periodic())
      positions.row(v) =
        sheet.origin + (coarse.vertices.row(v) - sheet.origin) * load.gradient(strain).transpose();
    else
      positions.row(v) +=
        load.displacement(sheet.fraction(coarse.vertices.row(v)), sheet.sides(), strain);
  return positions;
}

void LightweightCloth::put_held(const shell::Positions<2> &prescribed,
                                shell::Positions<2> &positions) const
{
  for (int v = 0; v < coarse.n_vertices(); ++v)
    if (load.holds(sheet.fraction(coarse.vertices.row(v))))
      positions.row(v) = prescribed.row(v);
}

LoadForces LightweightCloth::forces_at(const Law law, const shell::Positions<2> &positions) const
{
  const shell::Membrane &membrane = solvers->membrane(law);
  return load_forces(load, sheet, coarse.vertices,
                     law == Law::linear
                       ? shell::linear_membrane_gradient(membrane, positions - coarse.vertices)
                       : shell::membrane_gradient<2>(membrane, positions).gradient);
}

shell::Positions<2> LightweightCloth::near(const CoarseStep &step, const Law law,
                                           const double strain) const
{
  own_sides->law            = homogenized_law(law, cell.stiffness);
  shell::Positions<2> moved = prescribed(strain);
  if (load.is_periodic())
    return moved;
  shell::Positions<2> start = step.positions;
  put_held(moved, start);
  const shell::MembraneSolver<2> &solver = solvers->solver(law);
  return law == Law::linear ? solver.solve_linear(start)
                            : solver.solve_equilibrium(start).positions;
}

CoarseStep LightweightCloth::solve(const Law law, const double strain)
{
  CoarseStep step;
  take_cubic(law);
  own_sides->law = homogenized_law(law, cell.stiffness);
  step.positions = prescribed(strain);
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
  const shell::MembraneSolver<2> &solver = solvers->solver(law);
  step.seconds                           = median_seconds(
    [&]()
    {
      if (law == Law::linear)
      {
        step.positions  = solver.solve_linear(start);
        step.iterations = 1;
      }
      else
      {
        const shell::Equilibrium<2> equilibrium = solver.solve_equilibrium(start);
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
                                          const shell::Positions<2> &coarse_positions) const
{
  const UpsamplerOptions options = method.options(law);
  UpsampledSheet result;
  localization::Upsampler<2, double>::Fine in_double;
  localization::Upsampler<2, double>(cell, coarse, sheet, options)
    .upsample(coarse_positions, in_double);
  result.positions = in_double;

  const localization::Upsampler<2, float> in_float(cell, coarse, sheet, options);
  localization::Upsampler<2, float>::Fine fine;
  in_float.upsample(coarse_positions, fine); // memory and caches, as in every frame but the first
  result.seconds = median_seconds([&]() { in_float.upsample(coarse_positions, fine); });
  return result;
}
} // namespace homespun::verification
