// SPDX-License-Identifier: MIT
// The moving cloth (shell/solver/cloth.h), part by part and step by step: a sheet of 20 cm that
// hangs from its upper edge, with 800, 5,000 and 50,000 triangles, and the resolved sheet of 380 x
// 380 x 2. One thread, but for step_on_all_cores: as many independent cloths as there are cores.
//
// Counters. flops: of the formulas written without waste, a root or a division counting as one;
// of_peak: of the multiply-adds that one thread reaches in registers. bytes: what must be read and
// written if nothing is moved twice; of_copy: of a copy of as many bytes, in the same cache.
// factorisations: per step.
#include "meshes/cloth/cloth_mesh.h"
#include "shell/solver/cloth.h"
#include "shell/terms/inertial_terms.h"
#include "shell/terms/membrane_term.h"
#include "shell/terms/plate_term.h"
#include "shell/terms/six_node_term.h"
#include "tests/benchmarks/machine.h"
#include "tests/meshes/plain/shapes.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <optional>

using namespace homespun;
using namespace homespun::shell;
using benchmarks::Fractions;

namespace
{
constexpr double time_step = 0.01, density = 0.2, side = 0.2;

/// Flops of one triangle. Strain: F 12 multiply-adds, C 9, J 9, U 6. Force besides: stress 9, P 24,
/// corners 18. Derivatives besides: derivative of the strain 36, D times it 54, its square 63,
/// turning 42, blocks 216.
constexpr double strain_flops = 2. * 36., force_flops = strain_flops + 2. * 51.,
                 derivative_flops = force_flops + 2. * 411.;

/// Stripes, soft and hard, of some cloth's stiffness [N/m].
Eigen::Matrix3d stiffness()
{
  Eigen::Matrix3d result;
  result << 568., 60., 0., 60., 200., 0., 0., 0., 70.;
  return result;
}

/// A sheet of n x n x 2 triangles that leans by 30° against the vertical, its upper edge held.
struct Hanging
{
  explicit Hanging(const int n)
      : mesh(meshes::placed_sheet(
          meshes::coarse_sheet({0., 0.}, side / n * Eigen::Matrix2d::Identity(), n, n), placement(),
          Eigen::RowVector3d::Zero()))
      , is_held(static_cast<std::size_t>(mesh.n_vertices()), false)
      , masses(lumped_masses(mesh, {density}))
  {
    for (int i = 0; i <= n; ++i)
    {
      held.push_back(n * (n + 1) + i);
      is_held[static_cast<std::size_t>(held.back())] = true;
    }
    // A tenth of a percent of the side out of the plane: no direction is without stiffness.
    for (int v = 0; v < mesh.n_vertices(); ++v)
      if (!is_held[static_cast<std::size_t>(v)])
        mesh.positions.row(v) +=
          2e-4 * std::sin(100. * mesh.rest.vertices(v, 0)) * Eigen::RowVector3d(0., 0.866, 0.5);
  }

  static Eigen::Matrix<double, 3, 2> placement()
  {
    Eigen::Matrix<double, 3, 2> result;
    result << 1., 0., 0., -0.5, 0., std::sqrt(0.75);
    return result;
  }

  std::unique_ptr<Cloth> cloth(const std::optional<PlateModel> plate,
                               const std::vector<meshes::CubicForm> &cubic = {}) const
  {
    auto result = std::make_unique<Cloth>(mesh.positions, masses, held, ClothOptions());
    result->add(membrane_term(mesh, {stiffness()}, 0., cubic));
    if (plate)
      result->add(plate_term(mesh, {PlateStiffness::isotropic(1e-6, 0.3)}, *plate));
    result->add(gravity_term(masses, {0., 0., -9.81}));
    result->add(mass_damping_term(masses, 1.));
    return result;
  }

  /// The same of triangles with six nodes, on the same vertices.
  std::unique_ptr<Cloth> six_node_cloth(const int n,
                                        const std::vector<meshes::CubicForm> &cubic) const
  {
    const SixNodeMesh six_nodes        = six_node_mesh(mesh.rest, n, n);
    const Eigen::VectorXd their_masses = six_node_masses(six_nodes, density);
    auto result = std::make_unique<Cloth>(mesh.positions, their_masses, held, ClothOptions());
    result->add(six_node_term(six_nodes, stiffness(), 0., cubic));
    result->add(gravity_term(their_masses, {0., 0., -9.81}));
    result->add(mass_damping_term(their_masses, 1.));
    return result;
  }

  meshes::ClothMesh mesh;
  std::vector<int> held;
  std::vector<bool> is_held;
  Eigen::VectorXd masses;
};

/// The matrix of a step of the hanging sheet, and a right side.
struct StepMatrix
{
  explicit StepMatrix(const int n)
      : sheet(n)
      , membrane(membrane_term(sheet.mesh, {stiffness()}))
      , matrix(laid_out(*membrane, sheet.is_held))
      , gradient(Vectors::Zero(sheet.mesh.n_vertices(), 3))
  {
    membrane->attach(matrix);
    assemble(Hessian::projected);
    for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
      matrix.add_multiple(matrix.slot(v, v), sheet.masses(v) / (time_step * time_step));
    right_side = (-9.81 * sheet.masses) * Eigen::RowVector3d(0., 0., 1.);
  }

  static BlockMatrix laid_out(const Term &term, const std::vector<bool> &is_held)
  {
    std::vector<std::array<int, 2>> pairs;
    term.couple(pairs);
    return BlockMatrix(pairs, is_held);
  }

  void assemble(const Hessian kind)
  {
    matrix.clear();
    gradient.setZero();
    membrane->add_derivatives(sheet.mesh.positions, kind, gradient, matrix);
  }

  double n_vertices() const
  {
    return sheet.mesh.n_vertices();
  }

  Hanging sheet;
  std::unique_ptr<Term> membrane;
  BlockMatrix matrix;
  Vectors gradient, right_side;
};

/// Triangles one after the other, so that no time is hidden behind a single one in a loop.
template <typename Work>
void element(benchmark::State &state, const double flops, const Work &work)
{
  const Hanging sheet(20);
  const Membrane rest = membrane(sheet.mesh, {stiffness()});
  std::vector<Eigen::Matrix3d> corners;
  for (int t = 0; t < sheet.mesh.n_triangles(); ++t)
  {
    corners.emplace_back();
    for (int k = 0; k < 3; ++k)
      corners.back().row(k) = sheet.mesh.positions.row(sheet.mesh.triangles(t, k));
  }
  benchmarks::multiply_add_peak();
  std::size_t t = 0;
  const Fractions fractions(state);
  for (auto _ : state)
  {
    auto result = work(rest.rest[t], corners[t], rest.stiffness[0]);
    benchmark::DoNotOptimize(result);
    t = t + 1 < corners.size() ? t + 1 : 0;
  }
  fractions.report(flops, 0.);
}

void triangle_strain(benchmark::State &state)
{
  element(state, strain_flops,
          [](const RestTriangle &rest, const Eigen::Matrix3d &corners, const MembraneStiffness &)
          { return biot_strain<3>(deformation_gradient<3>(rest, corners)); });
}

void triangle_force(benchmark::State &state)
{
  element(state, force_flops,
          [](const RestTriangle &rest, const Eigen::Matrix3d &corners, const MembraneStiffness &D)
          { return triangle_gradient<3>(rest, corners, D.D); });
}

template <Hessian kind>
void triangle_force_and_hessian(benchmark::State &state)
{
  element(state, derivative_flops,
          [](const RestTriangle &rest, const Eigen::Matrix3d &corners, const MembraneStiffness &D)
          { return triangle_derivatives<3>(rest, corners, D, kind); });
}

template <Hessian kind>
void assemble_membrane(benchmark::State &state)
{
  StepMatrix step(static_cast<int>(state.range(0)));
  benchmarks::multiply_add_peak();
  const double bytes = static_cast<double>(step.membrane->bytes()) +
                       2. * 72. * static_cast<double>(step.matrix.blocks.size()) +
                       3. * 24. * step.n_vertices();
  const Fractions fractions(state);
  for (auto _ : state)
    step.assemble(kind);
  fractions.report(derivative_flops * step.sheet.mesh.n_triangles(), bytes);
}

/// Bending's Hessian is a number per pair of vertices, added to the three places of a block's
/// diagonal.
void assemble_bending(benchmark::State &state)
{
  const Hanging sheet(static_cast<int>(state.range(0)));
  const auto bending = bending_term(sheet.mesh, {PlateStiffness::isotropic(1e-6, 0.3)});
  BlockMatrix matrix = StepMatrix::laid_out(*bending, sheet.is_held);
  bending->attach(matrix);
  Vectors gradient   = Vectors::Zero(sheet.mesh.n_vertices(), 3);
  const double bytes = static_cast<double>(bending->bytes()) +
                       2. * 72. * static_cast<double>(matrix.blocks.size()) +
                       3. * 24. * sheet.mesh.n_vertices();
  const Fractions fractions(state);
  for (auto _ : state)
  {
    matrix.clear();
    gradient.setZero();
    bending->add_derivatives(sheet.mesh.positions, Hessian::projected, gradient, matrix);
  }
  fractions.report(0., bytes);
}

void lay_out(benchmark::State &state)
{
  const StepMatrix step(static_cast<int>(state.range(0)));
  for (auto _ : state)
  {
    const BlockMatrix matrix = StepMatrix::laid_out(*step.membrane, step.sheet.is_held);
    const BlockCholesky cholesky(matrix);
    benchmark::DoNotOptimize(cholesky.bytes());
  }
}

void factorise(benchmark::State &state)
{
  StepMatrix step(static_cast<int>(state.range(0)));
  BlockCholesky cholesky(step.matrix);
  benchmarks::multiply_add_peak();
  cholesky.factorize(step.matrix);
  const Fractions fractions(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(cholesky.factorize(step.matrix));
  fractions.report(2. * cholesky.n_multiply_adds(), 0.);
  state.counters["factor_bytes"] = static_cast<double>(cholesky.bytes());
}

void solve(benchmark::State &state)
{
  StepMatrix step(static_cast<int>(state.range(0)));
  BlockCholesky cholesky(step.matrix);
  cholesky.factorize(step.matrix);
  Vectors result;
  // The factor is read forwards and backwards.
  const double bytes = 2. * 8. * static_cast<double>(cholesky.n_entries());
  benchmarks::copy_bandwidth(static_cast<std::size_t>(0.5 * bytes));
  const Fractions fractions(state);
  for (auto _ : state)
  {
    cholesky.solve(step.right_side, result);
    benchmark::DoNotOptimize(result.data());
  }
  fractions.report(4. * static_cast<double>(cholesky.n_entries()), bytes);
}

/// Steps of a cloth, with what they took.
void take_steps(benchmark::State &state, const std::unique_ptr<Cloth> &cloth, const int n_triangles)
{
  cloth->step(time_step); // lays out
  StepReport sum;
  for (auto _ : state)
  {
    const StepReport report = cloth->step(time_step);
    sum.newton_iterations += report.newton_iterations;
    sum.guarded += report.guarded;
  }
  const auto per_step = [&](const int amount)
  { return benchmark::Counter(amount, benchmark::Counter::kAvgIterations); };
  state.counters["triangles"] = benchmark::Counter(n_triangles, benchmark::Counter::kAvgThreads);
  state.counters["bytes"] =
    benchmark::Counter(static_cast<double>(cloth->bytes()), benchmark::Counter::kAvgThreads);
  state.counters["factorisations"] = per_step(sum.newton_iterations);
  state.counters["guarded"]        = per_step(sum.guarded);
}

/// Whole steps, linearly implicit, of a sheet that swings.
void step(benchmark::State &state, const std::optional<PlateModel> plate,
          const std::vector<meshes::CubicForm> &cubic = {})
{
  const Hanging sheet(static_cast<int>(state.range(0)));
  take_steps(state, sheet.cloth(plate, cubic), sheet.mesh.n_triangles());
}

/// A cubic energy as large as a cell's: a tenth of the stress at 10 % strain.
meshes::CubicForm cubic_energy()
{
  meshes::CubicForm cubic;
  cubic.derivatives << 1., -0.5, 0.3, 0.8, -0.2, 1.5, 1.2, 0.4, -1., 0.6;
  cubic.derivatives *= stiffness()(2, 2);
  return cubic;
}

/// The same with one.
void step_of_second_order(benchmark::State &state)
{
  step(state, std::nullopt, {cubic_energy()});
}

/// The same of triangles with six nodes; with everything, a cubic energy too.
template <bool with_cubic>
void step_of_six_nodes(benchmark::State &state)
{
  const int n = static_cast<int>(state.range(0));
  const Hanging sheet(n);
  take_steps(state,
             sheet.six_node_cloth(n, with_cubic ? std::vector<meshes::CubicForm>{cubic_energy()}
                                                : std::vector<meshes::CubicForm>()),
             sheet.mesh.n_triangles());
}

BENCHMARK(triangle_strain);
BENCHMARK(triangle_force);
BENCHMARK_TEMPLATE(triangle_force_and_hessian, Hessian::exact);
BENCHMARK_TEMPLATE(triangle_force_and_hessian, Hessian::projected);
#define HOMESPUN_SIZES ->Arg(20)->Arg(50)->Arg(158)->Unit(benchmark::kMillisecond)
BENCHMARK_TEMPLATE(assemble_membrane, Hessian::exact) HOMESPUN_SIZES;
BENCHMARK_TEMPLATE(assemble_membrane, Hessian::projected) HOMESPUN_SIZES;
BENCHMARK(assemble_bending) HOMESPUN_SIZES;
BENCHMARK(lay_out) HOMESPUN_SIZES;
BENCHMARK(factorise) HOMESPUN_SIZES;
BENCHMARK(solve) HOMESPUN_SIZES;
#define HOMESPUN_STEP(name, plate) BENCHMARK_CAPTURE(step, name, plate)
HOMESPUN_STEP(direct, std::nullopt) HOMESPUN_SIZES;
BENCHMARK(step_of_second_order) HOMESPUN_SIZES;
BENCHMARK_TEMPLATE(step_of_six_nodes, false) HOMESPUN_SIZES;
BENCHMARK_TEMPLATE(step_of_six_nodes, true) HOMESPUN_SIZES;
HOMESPUN_STEP(direct_bending, PlateModel::hinges) HOMESPUN_SIZES;
HOMESPUN_STEP(direct_edge_angles, PlateModel::edge_angles) HOMESPUN_SIZES;
HOMESPUN_STEP(direct_on_all_cores, std::nullopt)
HOMESPUN_SIZES->ThreadPerCpu()->UseRealTime();
HOMESPUN_STEP(direct, std::nullopt)->Arg(380)->Iterations(1)->Unit(benchmark::kMillisecond);
} // namespace
