// SPDX-License-Identifier: MIT
#include "verification/method/lightweight_cloth.h"

#include "meshes/plain/errors.h"
#include "verification/reference/free_sides.h"

namespace homespun::verification
{
using localization::UpsamplerOptions;

const std::vector<std::string> &Method::names()
{
  static const std::vector<std::string> all = {"affine", "localized", "localized-affine-lift",
                                               "localized-mean-anchor", "localized-piecewise"};
  return all;
}

Method::Method(const std::string &name)
    : name(name)
{
  if (std::find(names().begin(), names().end(), name) == names().end())
    throw meshes::BadInput("unknown method `" + name +
                           "`; expected affine, localized, localized-affine-lift, "
                           "localized-mean-anchor or localized-piecewise");
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
  if (name == "localized-mean-anchor")
    options.anchor = localization::Anchor::mean;
  if (name == "localized-piecewise")
    options.blend = localization::Blend::piecewise;
  return options;
}

bool Method::has_meaning(const Law law) const
{
  return law != Law::linear || name != "localized-affine-lift";
}

namespace
{
/// A load with free sides, whose strains are those of C^H under the coarse cloth's own law.
Load with_own_sides(const Load &load, const Eigen::Matrix3d &stiffness,
                    const std::shared_ptr<Law> &law)
{
  if (!load.has_free_sides())
    return load;
  return load.with_free_strains([load, stiffness, law](const double strain)
                                { return free_strains_of(load, *law, stiffness, strain); });
}
} // namespace

Law LightweightCloth::own_law(const Law law)
{
  return law == Law::linear ? Law::linear : Law::biot;
}

LightweightCloth::LightweightCloth(const meshes::HomogenizedCell &cell, const meshes::Sheet &sheet,
                                   const Load &load)
    : coarse(meshes::coarse_sheet(sheet.origin, sheet.lattice.vectors, sheet.n1, sheet.n2))
    , cell(cell)
    , sheet(sheet)
    , law_of_sides(std::make_shared<Law>(Law::biot))
    , load(with_own_sides(load, cell.stiffness, law_of_sides))
    , membrane(shell::membrane(coarse, {cell.stiffness}))
{
  if (load.is_periodic())
    return;
  std::vector<int> held;
  for (int v = 0; v < coarse.n_vertices(); ++v)
    if (load.holds(sheet.fraction(coarse.vertices.row(v))))
      held.push_back(v);
  solver = std::make_unique<shell::MembraneSolver<2>>(
    coarse, std::vector<Eigen::Matrix3d>{cell.stiffness}, held);
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
  return load_forces(load, sheet, coarse.vertices,
                     law == Law::linear
                       ? shell::linear_membrane_gradient(membrane, positions - coarse.vertices)
                       : shell::membrane_gradient<2>(membrane, positions).gradient);
}

shell::Positions<2> LightweightCloth::near(const CoarseStep &step, const Law law,
                                           const double strain) const
{
  *law_of_sides             = own_law(law);
  shell::Positions<2> moved = prescribed(strain);
  if (load.is_periodic())
    return moved;
  shell::Positions<2> start = step.positions;
  put_held(moved, start);
  return law == Law::linear ? solver->solve_linear(start)
                            : solver->solve_equilibrium(start).positions;
}

CoarseStep LightweightCloth::solve(const Law law, const double strain)
{
  CoarseStep step;
  *law_of_sides  = own_law(law);
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
        const shell::Equilibrium<2> equilibrium = solver->solve_equilibrium(start);
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
