// SPDX-License-Identifier: MIT
// Studies of sheets: cells per sheet, coarse triangles per cell, time steps of the coarse cloth.
#include "meshes/cloth/cloth_mesh.h"
#include "meshes/plain/errors.h"
#include "shell/solver/cloth.h"
#include "shell/terms/inertial_terms.h"
#include "shell/terms/membrane_term.h"
#include "verification/converge/converge_cases.h"
#include "verification/method/coarse_model.h"
#include "verification/method/fluctuation.h"
#include "verification/reference/fine_reference.h"

#include <chrono>
#include <cmath>

namespace homespun::verification
{
using homogenization::UnitCell;

namespace
{
/// The linear reference is in proportion to the strain: any will do.
constexpr double linear_strain = 0.01;

double mean_distance(const meshes::Points &a, const meshes::Points &b)
{
  return (a - b).rowwise().norm().mean();
}

/// `localized` and `affine` against the linear reference on sheets of more and more cells.
ConvergenceResult add_cells(const UnitCell &cell, const meshes::HomogenizedCell &homogenized,
                            const Load &load, const ConvergenceSizes &sizes,
                            const MPI_Comm communicator)
{
  const double side                      = std::sqrt(cell.lattice.area());
  const std::vector<std::string> methods = {"affine", "localized"};
  std::vector<Series> per_sheet(2), per_cell(2), per_fluctuation(2);
  for (std::size_t m = 0; m < 2; ++m)
  {
    per_sheet[m].quantity       = methods[m] + ": mean error per strain [sheet sides]";
    per_cell[m].quantity        = methods[m] + ": mean error per strain [cell sides]";
    per_fluctuation[m].quantity = methods[m] + ": mean error [mean fluctuation]";
    for (Series *series : {&per_sheet[m], &per_cell[m], &per_fluctuation[m]})
      series->h_unit = "cell sides per sheet side";
  }
  const auto solve = [&](const int n)
  {
    const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n, n);
    FineReference reference(sheet, cell.stiffness_of_phase(), ReferenceOptions(), communicator);
    reference.start(load, Law::linear);
    const ReferenceStep fine = reference.advance(linear_strain);
    if (!fine.reached)
      throw meshes::NotConverged(load.name + ": " + fine.why, {});
    double fluctuation = 0.;
    for (std::size_t m = 0; m < 2; ++m)
    {
      const CoarseModel model({homogenized}, sheet, load, Method(methods[m]), Law::linear);
      const double error =
        mean_distance(model.upsample(model.solve(linear_strain)), fine.positions);
      if (m == 0)
        fluctuation = error; // what the coarse motion lacks
      const double in_cells = error / (linear_strain * side);
      const auto add        = [&](Series &series, const double value) {
        series.levels.push_back({1. / n, reference.n_dofs(), std::nullopt, value, fine.seconds});
      };
      add(per_sheet[m], in_cells / n);
      add(per_cell[m], in_cells);
      if (m == 1)
        add(per_fluctuation[m], error / fluctuation);
    }
  };
  ConvergenceResult result;
  for (const int n : sizes.cells_per_sheet)
    if (!result.solves([&]() { solve(n); }))
      break;
  if (per_sheet[0].levels.empty())
    return result;
  per_sheet[0].judgement =
    judge_errors(per_sheet[0].sizes(), per_sheet[0].errors(), about(1., 0.15));
  per_sheet[1].judgement = judge_errors(per_sheet[1].sizes(), per_sheet[1].errors(), {0.85, 2.15});
  const double ratio     = *per_fluctuation[1].levels.back().error;
  // Else affine lacks no fluctuation, and there is nothing to restore.
  const bool is_restored = fluctuates(homogenized, {1., 0., 0.}) ||
                           fluctuates(homogenized, {0., 1., 0.}) ||
                           fluctuates(homogenized, {0., 0., 1.});
  if (!is_restored)
    for (Series &series : per_sheet)
    {
      series.judgement->outcome = Outcome::inconclusive;
      series.judgement->why     = "nothing fluctuates: both errors are those of the coarse mesh";
    }
  result.add(per_sheet[0], "sheet-order.affine");
  result.add(per_sheet[1], "sheet-order.localized");
  result.add(per_cell[0]);
  result.add(per_cell[1]);
  result.add(per_fluctuation[1]);
  result.verdicts.push_back(judged("closer-on-the-largest-sheet", {},
                                   !is_restored ? Outcome::inconclusive
                                   : ratio < 1. ? Outcome::pass
                                                : Outcome::fail,
                                   ratio));
  return result;
}

/// A coarse sheet with any number of triangles, pulled as the load says.
struct CoarseSolution
{
  meshes::TriangleMesh mesh;
  shell::Positions<2> linear; ///< positions by linear theory [m]
  double energy;              ///< of the corotational equilibrium [J]
};

CoarseSolution solve_coarse(const meshes::HomogenizedCell &homogenized, const meshes::Sheet &sheet,
                            const Load &load, const int n, const double strain)
{
  CoarseSolution result;
  result.mesh                     = meshes::coarse_sheet(sheet.origin, sheet.sides() / n, n, n);
  const meshes::Points &rest      = result.mesh.vertices;
  const shell::Positions<2> start = moved_affinely(load, sheet, rest, strain);
  const shell::MembraneSolver solver(shell::membrane(result.mesh, {homogenized.stiffness}),
                                     held_vertices(load, sheet, rest));
  result.linear = solver.solve_linear(start);
  result.energy = solver.solve_equilibrium(result.linear).energy;
  return result;
}

ConvergenceResult refine_coarse_mesh(const UnitCell &cell,
                                     const meshes::HomogenizedCell &homogenized, const Load &load,
                                     const ConvergenceSizes &sizes, const MPI_Comm communicator)
{
  const int n_cells         = sizes.cells_of_coarse_study;
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n_cells, n_cells);
  const double side         = std::sqrt(cell.lattice.area());
  FineReference reference(sheet, cell.stiffness_of_phase(), ReferenceOptions(), communicator);
  reference.start(load, Law::linear);
  const ReferenceStep fine = reference.advance(linear_strain);
  if (!fine.reached)
    throw meshes::NotConverged(load.name + ": " + fine.why, {});

  Series energy, motion, localized;
  energy.quantity    = "energy of the coarse sheet at 1 % strain [J]";
  motion.quantity    = "change of the coarse motion by halving H: mean per strain [cell sides]";
  localized.quantity = "localized: mean error against the linear reference per strain [cell sides]";
  for (Series *series : {&energy, &motion, &localized})
    series->h_unit = "H in cell sides";
  meshes::Points before;
  const auto solve = [&](const double per_cell)
  {
    const auto start            = std::chrono::steady_clock::now();
    const int n                 = static_cast<int>(std::lround(n_cells * per_cell));
    const CoarseSolution coarse = solve_coarse(homogenized, sheet, load, n, linear_strain);
    const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const auto upsampled = [&](const char *method) -> meshes::Points
    {
      localization::Upsampler<2, double>::Fine positions;
      localization::Upsampler<2, double>(homogenized, coarse.mesh, sheet,
                                         Method(method).options(Law::linear))
        .upsample(coarse.linear, positions);
      return positions;
    };
    const auto n_dofs           = static_cast<unsigned long>(2 * coarse.mesh.n_vertices());
    const meshes::Points affine = upsampled("affine");
    if (!motion.levels.empty())
      motion.levels.back().error = mean_distance(affine, before) / (linear_strain * side);
    motion.levels.push_back({1. / per_cell, n_dofs, std::nullopt, std::nullopt, seconds});
    energy.levels.push_back({1. / per_cell, n_dofs, coarse.energy, std::nullopt, seconds});
    localized.levels.push_back(
      {1. / per_cell, n_dofs, std::nullopt,
       mean_distance(upsampled("localized"), fine.positions) / (linear_strain * side), seconds});
    before = affine;
  };
  ConvergenceResult result;
  for (const double per_cell : sizes.coarse_per_cell)
    if (!result.solves([&]() { solve(per_cell); }))
      break;
  if (motion.levels.empty())
    return result;
  motion.levels.pop_back(); // nothing finer to compare it with

  double rise = -1.; // relative
  for (std::size_t k = 1; k < energy.levels.size(); ++k)
    rise = larger(rise, *energy.levels[k].value / *energy.levels[k - 1].value - 1.);
  if (energy.levels.size() > 1)
    result.verdicts.push_back(at_most("coarse-energy-falls", {}, rise, 1e-10));
  const double floor      = 1e-11 * std::abs(*energy.levels.back().value);
  const OrderLimit limits = {0.9, 2.1};
  energy.judgement        = judge_values(energy.sizes(), energy.values(), limits, floor);
  energy.extrapolate(floor, 2., *energy.judgement);
  motion.judgement = judge_errors(motion.sizes(), motion.errors(), limits);
  result.add(energy, "coarse-order.energy");
  result.add(motion, "coarse-order.motion");
  result.add(localized);
  return result;
}

/// A coarse sheet of 8 x 8 cells lies flat, is held at its edge f2 = 1 and swings down for 40 ms if
/// it is 8 cm long, and others for as long in their own time, sqrt(length / g).
ConvergenceResult refine_time_step(const UnitCell &cell, const meshes::HomogenizedCell &homogenized,
                                   const shell::Integrator integrator,
                                   const ConvergenceSizes &sizes)
{
  constexpr int n                  = 8;
  const double side                = n * std::sqrt(cell.lattice.area());
  const double duration            = 0.04 * std::sqrt(side / 0.08); // [s]
  Eigen::Matrix<double, 3, 2> flat = Eigen::Matrix<double, 3, 2>::Identity();
  meshes::TriangleMesh rest =
    meshes::coarse_sheet(Eigen::RowVector2d::Zero(), cell.lattice.vectors, n, n);
  const meshes::ClothMesh mesh = meshes::placed_sheet(rest, flat, Eigen::RowVector3d::Zero());
  std::vector<int> held;
  for (int i = 0; i <= n; ++i)
    held.push_back(n * (n + 1) + i);
  const Eigen::VectorXd masses = shell::lumped_masses(mesh, {homogenized.areal_density});
  const auto end_of            = [&](const int n_steps)
  {
    shell::ClothOptions options;
    options.integrator       = integrator;
    options.newton_tolerance = 1e-11;
    shell::Cloth cloth(mesh.positions, masses, held, options);
    cloth.add(shell::membrane_term(mesh, {homogenized.stiffness}));
    cloth.add(shell::gravity_term(masses, {0., 0., -9.81}));
    for (int k = 0; k < n_steps; ++k)
      cloth.step(duration / n_steps);
    return meshes::SpacePoints(cloth.positions());
  };
  // A first-order method: twice the finest minus the next one is of second order.
  const int finest                    = 4 * sizes.time_steps.back();
  const meshes::SpacePoints reference = 2. * end_of(finest) - end_of(finest / 2);
  Series series;
  series.quantity  = "mean error of the positions [sheet sides]";
  series.h_unit    = "s";
  const auto solve = [&](const int n_steps)
  {
    const auto start                    = std::chrono::steady_clock::now();
    const meshes::SpacePoints positions = end_of(n_steps);
    const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    series.levels.push_back({duration / n_steps, static_cast<unsigned long>(3 * rest.n_vertices()),
                             std::nullopt, (positions - reference).rowwise().norm().mean() / side,
                             seconds});
  };
  ConvergenceResult result;
  for (const int n_steps : sizes.time_steps)
    if (!result.solves([&]() { solve(n_steps); }))
      break;
  series.judgement = judge_errors(series.sizes(), series.errors(), about(1.));
  result.add(series, "time-order");
  return result;
}

/// A coarse sheet of 2 x 2 cells, held nowhere, falls for half a second and is braked in proportion
/// to its velocity: it stays as it is and is where a point of its mass would be.
ConvergenceResult fall_damped(const UnitCell &cell, const meshes::HomogenizedCell &homogenized,
                              const ConvergenceSizes &sizes)
{
  constexpr double duration = 0.5, rate = 4., g = 9.81; // [s], [1/s], [m/s^2]
  // z'' = −g − rate z' from rest.
  const double exact           = -g / rate * (duration - (1. - std::exp(-rate * duration)) / rate);
  const meshes::ClothMesh mesh = meshes::placed_sheet(
    meshes::coarse_sheet(Eigen::RowVector2d::Zero(), cell.lattice.vectors, 2, 2),
    Eigen::Matrix<double, 3, 2>::Identity(), Eigen::RowVector3d::Zero());
  const Eigen::VectorXd masses     = shell::lumped_masses(mesh, {homogenized.areal_density});
  const meshes::SpacePoints fallen = mesh.positions.rowwise() + Eigen::RowVector3d(0., 0., exact);
  Series series;
  series.quantity  = "mean error of the positions [way that the sheet falls]";
  series.h_unit    = "s";
  const auto solve = [&](const int n_steps)
  {
    const auto start = std::chrono::steady_clock::now();
    shell::ClothOptions options;
    options.integrator       = shell::Integrator::implicit;
    options.newton_tolerance = 1e-11;
    shell::Cloth cloth(mesh.positions, masses, {}, options);
    cloth.add(shell::membrane_term(mesh, {homogenized.stiffness}));
    cloth.add(shell::gravity_term(masses, {0., 0., -g}));
    cloth.add(shell::mass_damping_term(masses, rate));
    for (int k = 0; k < n_steps; ++k)
      cloth.step(duration / n_steps);
    const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    series.levels.push_back(
      {duration / n_steps, static_cast<unsigned long>(mesh.positions.size()), std::nullopt,
       (cloth.positions() - fallen).rowwise().norm().mean() / -exact, seconds});
  };
  ConvergenceResult result;
  for (const int n_steps : sizes.time_steps)
    if (!result.solves([&]() { solve(n_steps); }))
      break;
  series.judgement = judge_errors(series.sizes(), series.errors(), about(1.));
  result.add(series, "damped-fall");
  return result;
}

template <typename Run>
std::vector<ConvergenceCase> of_sheet_loads(const UnitCell &cell, const std::string &study,
                                            const Run &run)
{
  std::vector<ConvergenceCase> cases;
  for (const std::string &name : Load::names_of(LoadKind::sheet))
    cases.push_back({cell.name, study, name, [run, load = Load(name)]() { return run(load); }});
  return cases;
}
} // namespace

std::vector<ConvergenceCase> scale_cases(const UnitCell &cell,
                                         const meshes::HomogenizedCell &homogenized,
                                         const ConvergenceSizes &sizes, const MPI_Comm communicator)
{
  return of_sheet_loads(cell, "scale",
                        [&cell, &homogenized, sizes, communicator](const Load &load)
                        { return add_cells(cell, homogenized, load, sizes, communicator); });
}

std::vector<ConvergenceCase> coarse_cases(const UnitCell &cell,
                                          const meshes::HomogenizedCell &homogenized,
                                          const ConvergenceSizes &sizes,
                                          const MPI_Comm communicator)
{
  return of_sheet_loads(cell, "coarse",
                        [&cell, &homogenized, sizes, communicator](const Load &load) {
                          return refine_coarse_mesh(cell, homogenized, load, sizes, communicator);
                        });
}

std::vector<ConvergenceCase> time_cases(const UnitCell &cell,
                                        const meshes::HomogenizedCell &homogenized,
                                        const ConvergenceSizes &sizes)
{
  std::vector<ConvergenceCase> cases;
  for (const auto &[name, integrator] :
       {std::pair("linearly implicit Euler", shell::Integrator::linearly_implicit),
        std::pair("implicit Euler", shell::Integrator::implicit)})
    cases.push_back({cell.name, "time", name,
                     [&cell, &homogenized, integrator = integrator, sizes]()
                     { return refine_time_step(cell, homogenized, integrator, sizes); }});
  cases.push_back({cell.name, "time", "damped fall", [&cell, &homogenized, sizes]() {
                     return fall_damped(cell, homogenized, sizes);
                   }});
  return cases;
}
} // namespace homespun::verification
