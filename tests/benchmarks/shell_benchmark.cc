// SPDX-License-Identifier: MIT
// The coarse cloth at the paper's size, 20 x 20 cells: 441 vertices, 800 triangles, one thread.
#include "shell/solver/equilibrium.h"
#include "tests/meshes/plain/shapes.h"

#include <benchmark/benchmark.h>

#include <cmath>

using namespace homespun;
using namespace homespun::shell;

namespace
{
/// The laminate of soft and hard stripes, E = 1 and 10, nu = 0.3 (homogenization/README.md).
Eigen::Matrix3d stripes()
{
  Eigen::Matrix3d stiffness;
  stiffness << 5.67982018, 0.599400599, 0., 0.599400599, 1.998002, 0., 0., 0., 0.699300699;
  return stiffness;
}

/// A sheet of n x n cells of 1 cm with its lower and upper edge held.
struct Strip
{
  explicit Strip(const int n)
      : mesh(meshes::coarse_sheet({0., 0.}, 0.01 * Eigen::Matrix2d::Identity(), n, n))
  {
    for (int i = 0; i <= n; ++i)
    {
      held.push_back(i);
      held.push_back(n * (n + 1) + i);
    }
  }

  /// The strip, its upper edge moved out by strain times length and the rest following evenly, with
  /// a wave in space so that no direction is without stiffness.
  template <int dim>
  Positions<dim> pulled(const double strain) const
  {
    Positions<dim> x = Positions<dim>::Zero(mesh.n_vertices(), dim);
    for (int v = 0; v < mesh.n_vertices(); ++v)
    {
      x(v, 0) = mesh.vertices(v, 0);
      x(v, 1) = (1. + strain) * mesh.vertices(v, 1);
      if constexpr (dim == 3)
        x(v, 2) = 1e-4 * std::sin(100. * mesh.vertices(v, 0));
    }
    return x;
  }

  meshes::TriangleMesh mesh;
  std::vector<int> held;
};

template <int dim>
DeformationGradient<dim> some_gradient()
{
  DeformationGradient<dim> F = DeformationGradient<dim>::Constant(0.07);
  F(0, 0)                    = 1.1;
  F(1, 1)                    = 0.95;
  return F;
}

template <int dim>
void element_energy(benchmark::State &state)
{
  DeformationGradient<dim> F = some_gradient<dim>();
  const Eigen::Matrix3d D    = stripes();
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(F.data());
    benchmark::ClobberMemory();
    benchmark::DoNotOptimize(energy_density<dim>(F, D));
  }
}

template <int dim>
void element_gradient(benchmark::State &state)
{
  DeformationGradient<dim> F = some_gradient<dim>();
  const Eigen::Matrix3d D    = stripes();
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(F.data());
    benchmark::ClobberMemory();
    auto P = energy_gradient<dim>(F, D);
    benchmark::DoNotOptimize(P.data());
  }
}

template <int dim, Hessian kind>
void element_hessian(benchmark::State &state)
{
  DeformationGradient<dim> F = some_gradient<dim>();
  const Eigen::Matrix3d D    = stripes();
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(F.data());
    benchmark::ClobberMemory();
    auto H = energy_hessian<dim>(F, D, kind);
    benchmark::DoNotOptimize(H.data());
  }
}

template <int dim>
void energy(benchmark::State &state)
{
  const Strip strip(static_cast<int>(state.range(0)));
  const Membrane sheet   = membrane(strip.mesh, {stripes()});
  const Positions<dim> x = strip.pulled<dim>(0.1);
  for (auto _ : state)
    benchmark::DoNotOptimize(membrane_energy<dim>(sheet, x));
  state.counters["triangles"] = strip.mesh.n_triangles();
}

template <int dim>
void gradient(benchmark::State &state)
{
  const Strip strip(static_cast<int>(state.range(0)));
  const Membrane sheet   = membrane(strip.mesh, {stripes()});
  const Positions<dim> x = strip.pulled<dim>(0.1);
  for (auto _ : state)
  {
    auto g = membrane_gradient<dim>(sheet, x);
    benchmark::DoNotOptimize(g.gradient.data());
  }
  state.counters["triangles"] = strip.mesh.n_triangles();
}

/// A matrix over the free vertices of a strip.
struct Assembled
{
  explicit Assembled(const int n)
      : strip(n)
      , sheet(membrane(strip.mesh, {stripes()}))
      , x(strip.pulled<2>(0.1))
      , matrix(strip.mesh.triangles, marks(strip))
  {
    assemble();
  }

  void assemble()
  {
    matrix.clear();
    add_membrane_hessian(sheet, x, Hessian::exact, matrix);
  }

  static std::vector<bool> marks(const Strip &strip)
  {
    std::vector<bool> held(static_cast<std::size_t>(strip.mesh.n_vertices()), false);
    for (const int v : strip.held)
      held[static_cast<std::size_t>(v)] = true;
    return held;
  }

  Strip strip;
  Membrane sheet;
  Positions<2> x;
  PlaneMatrix matrix;
};

void assembly(benchmark::State &state)
{
  Assembled cloth(static_cast<int>(state.range(0)));
  for (auto _ : state)
    cloth.assemble();
}

void factorisation(benchmark::State &state)
{
  Assembled cloth(static_cast<int>(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(cloth.matrix.factorize());
}

void substitution(benchmark::State &state)
{
  Assembled cloth(static_cast<int>(state.range(0)));
  cloth.matrix.factorize();
  for (auto _ : state)
  {
    auto step = cloth.matrix.solve(cloth.x);
    benchmark::DoNotOptimize(step.data());
  }
}

/// One load step of 1 % from an equilibrium; `per_iteration` is a Newton step with all it needs.
void newton(benchmark::State &state)
{
  const Strip strip(static_cast<int>(state.range(0)));
  const MembraneSolver solver(membrane(strip.mesh, {stripes()}), strip.held);
  const Equilibrium at_rest = solver.solve_equilibrium(strip.pulled<2>(0.1));
  Positions<2> start        = at_rest.positions;
  start.col(1) *= 1.11 / 1.10;
  int iterations = 0;
  for (auto _ : state)
    iterations = solver.solve_equilibrium(start).iterations;
  state.counters["iterations"]    = iterations;
  state.counters["per_iteration"] = benchmark::Counter(
    iterations, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void solve_linear(benchmark::State &state)
{
  const Strip strip(static_cast<int>(state.range(0)));
  const MembraneSolver solver(membrane(strip.mesh, {stripes()}), strip.held);
  const Positions<2> prescribed = strip.pulled<2>(0.1);
  solver.solve_linear(prescribed); // factors
  for (auto _ : state)
  {
    auto x = solver.solve_linear(prescribed);
    benchmark::DoNotOptimize(x.data());
  }
}

BENCHMARK_TEMPLATE(element_energy, 2);
BENCHMARK_TEMPLATE(element_energy, 3);
BENCHMARK_TEMPLATE(element_gradient, 2);
BENCHMARK_TEMPLATE(element_gradient, 3);
BENCHMARK_TEMPLATE(element_hessian, 2, Hessian::exact);
BENCHMARK_TEMPLATE(element_hessian, 3, Hessian::exact);
BENCHMARK_TEMPLATE(element_hessian, 2, Hessian::projected);
BENCHMARK_TEMPLATE(element_hessian, 3, Hessian::projected);
BENCHMARK_TEMPLATE(energy, 2)->Arg(20)->Unit(benchmark::kMicrosecond);
BENCHMARK_TEMPLATE(energy, 3)->Arg(20)->Unit(benchmark::kMicrosecond);
BENCHMARK_TEMPLATE(gradient, 2)->Arg(20)->Unit(benchmark::kMicrosecond);
BENCHMARK_TEMPLATE(gradient, 3)->Arg(20)->Unit(benchmark::kMicrosecond);
BENCHMARK(assembly)->Arg(20)->Arg(50)->Unit(benchmark::kMicrosecond);
BENCHMARK(factorisation)->Arg(20)->Arg(50)->Unit(benchmark::kMicrosecond);
BENCHMARK(substitution)->Arg(20)->Arg(50)->Unit(benchmark::kMicrosecond);
BENCHMARK(newton)->Arg(20)->Unit(benchmark::kMicrosecond);
BENCHMARK(solve_linear)->Arg(20)->Arg(50)->Unit(benchmark::kMicrosecond);
} // namespace
