// SPDX-License-Identifier: MIT
// Homogenization of larger and larger cells, one rank, everything but reading the mesh: time per
// DoF, iterations, and iterations against the contrast of the phases.
#include "tests/homogenization/cell/cells.h"

#include <deal.II/base/mpi.h>

#include <benchmark/benchmark.h>

#include <algorithm>

using namespace homespun;

namespace
{
/// Stripes cut by a block, so that the fields are not those of a laminate.
int pattern(const double f1, const double f2)
{
  return f2 < 0.5 ? (f1 > 0.25 && f1 < 0.5 ? 1 : 0) : 1;
}

void homogenize(benchmark::State &state, const unsigned int order, const double contrast)
{
  const int n                               = static_cast<int>(state.range(0));
  std::vector<homogenization::Phase> phases = tests::soft_and_hard();
  phases[1] = homogenization::isotropic("hard", contrast, 0.3, 1., 1.);
  const homogenization::UnitCell cell =
    tests::cell_of(tests::square_lattice(0.01), n, n, phases, pattern);
  homogenization::HomogenizationOptions options;
  options.order  = order;
  options.solver = homogenization::CellSolver::multigrid;
  homogenization::Homogenization result;
  for (auto _ : state)
    result = homogenization::homogenize(cell, options, MPI_COMM_SELF);
  const auto &seconds         = result.seconds;
  state.counters["triangles"] = cell.mesh.n_triangles();
  state.counters["dofs"]      = static_cast<double>(result.n_dofs);
  state.counters["iterations_max"] =
    *std::max_element(result.iterations.begin(), result.iterations.end());
  state.counters["setup_s"]    = seconds.setup;
  state.counters["assembly_s"] = seconds.assembly;
  state.counters["amg_s"]      = seconds.preconditioner;
  state.counters["solve_s"]    = seconds.solve;
}
} // namespace

BENCHMARK_CAPTURE(homogenize, p1, 1, 10.)
  ->Arg(128)
  ->Arg(256)
  ->Arg(512)
  ->Arg(1000)
  ->Iterations(1)
  ->Repetitions(3)
  ->ReportAggregatesOnly(false)
  ->Unit(benchmark::kSecond)
  ->UseRealTime();
BENCHMARK_CAPTURE(homogenize, p2, 2, 10.)
  ->Arg(64)
  ->Arg(256)
  ->Iterations(1)
  ->Unit(benchmark::kSecond)
  ->UseRealTime();
BENCHMARK_CAPTURE(homogenize, p1_contrast_1e0, 1, 1.000001)
  ->Arg(256)
  ->Iterations(1)
  ->Unit(benchmark::kSecond)
  ->UseRealTime();
BENCHMARK_CAPTURE(homogenize, p1_contrast_1e4, 1, 1e4)
  ->Arg(256)
  ->Iterations(1)
  ->Unit(benchmark::kSecond)
  ->UseRealTime();
BENCHMARK_CAPTURE(homogenize, p1_contrast_1e8, 1, 1e8)
  ->Arg(256)
  ->Iterations(1)
  ->Unit(benchmark::kSecond)
  ->UseRealTime();

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
