// SPDX-License-Identifier: MIT
#include "verification/benchmark/benchmark_study.h"

#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_reading.h"
#include "meshes/plain/errors.h"
#include "shell/algebra/block_cholesky.h"
#include "shell/terms/membrane_term.h"
#include "verification/benchmark/machine_limits.h"
#include "verification/benchmark/repeated.h"
#include "verification/drape/drape_schedule.h"
#include "verification/drape/draped_cell.h"
#include "verification/record/json_files.h"
#include "verification/record/on_root.h"
#include "verification/record/progress.h"
#include "verification/record/provenance.h"
#include "verification/record/run_folder.h"
#include "verification/record/step_times.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <thread>

namespace homespun::verification
{
namespace
{
/// Flops of a triangle's force and derivative: the formulas of shell/membrane written without
/// waste, a root or a division counting as one; strain 36 multiply-adds, force 51, derivative 411.
constexpr double flops_of_triangle = 2. * (36. + 51. + 411.);

/// The matrix of a step of the coarse cloth: its membrane, and masses.
struct StepMatrix
{
  StepMatrix(const DrapedCell &draped, const SceneCloth &moving)
      : positions(moving.cloth().positions())
      , masses(moving.cloth().masses())
      , membrane(shell::membrane_term(draped.coarse, draped.effective.stiffness))
      , matrix(pairs(*membrane),
               marks(draped.coarse_motion().vertices(draped.coarse), draped.coarse.n_vertices()))
      , gradient(shell::Vectors::Zero(positions.rows(), 3))
  {
    membrane->attach(matrix);
    assemble();
  }

  static std::vector<std::array<int, 2>> pairs(const shell::Term &term)
  {
    std::vector<std::array<int, 2>> all;
    term.couple(all);
    return all;
  }

  static std::vector<bool> marks(const std::vector<int> &held, const int n_vertices)
  {
    std::vector<bool> is_held(static_cast<std::size_t>(n_vertices), false);
    for (const int vertex : held)
      is_held[static_cast<std::size_t>(vertex)] = true;
    return is_held;
  }

  void assemble()
  {
    matrix.clear();
    gradient.setZero();
    membrane->add_derivatives(positions, shell::Hessian::projected, gradient, matrix);
  }

  void add_masses(const double time_step)
  {
    for (int v = 0; v < gradient.rows(); ++v)
      matrix.add_multiple(matrix.slot(v, v), masses(v) / (time_step * time_step));
  }

  const shell::Vectors positions;
  const Eigen::VectorXd masses;
  const std::unique_ptr<shell::Term> membrane;
  shell::BlockMatrix matrix;
  shell::Vectors gradient;
};

class Benchmark
{
public:
  Benchmark(const BenchmarkOptions &options, const MPI_Comm communicator)
      : options(options)
      , communicator(communicator)
      , cell(homogenization::read_unit_cell(options.cell_file, communicator))
      , scene(read_scene(options.scene_file))
      , progress(!options.quiet && is_root(communicator), 4)
  {
  }

  std::vector<BenchmarkRow> run()
  {
    std::unique_ptr<RunFolder> folder;
    on_root(
      communicator,
      [&]()
      {
        const nlohmann::ordered_json inputs = {{"refine", options.refine}, {"runs", options.runs}};
        folder =
          open_run_folder(options.output, {"benchmark", inputs}, options.earlier, options.quiet);
      });
    cell_problems();
    const auto coarse_cell = homogenized_on_its_mesh();
    on_root(communicator,
            [&]()
            {
              machine();
              moving_cloth(coarse_cell);
              write();
              folder->finish();
            });
    return rows;
  }

private:
  /// @param limit a row that is there already, or nothing
  void add(const std::string &part, const MeasuredWork &measured, const std::string &unit,
           const std::string &limit = "", const int ranks = 1)
  {
    const StepTimes times = step_times(measured.seconds);
    BenchmarkRow row;
    row.part          = part;
    row.runs          = static_cast<int>(measured.seconds.size());
    row.seconds       = times.median;
    row.mean          = times.mean;
    row.percentile_95 = times.percentile_95;
    row.work          = measured.work;
    row.unit          = unit;
    row.limit         = limit;
    row.ranks         = ranks;
    for (const BenchmarkRow &other : rows)
      if (other.part == limit)
        row.of_limit = row.rate() / other.rate();
    rows.push_back(row);
  }

  homogenization::Homogenization solved(const int refine) const
  {
    homogenization::HomogenizationOptions solve;
    solve.order  = 1;
    solve.refine = static_cast<unsigned>(refine);
    solve.solver = homogenization::CellSolver::fastest;
    return homogenization::homogenize(cell, solve, communicator);
  }

  /// P1 on the refined mesh: three loads, from the mesh to C^H.
  void cell_problems()
  {
    progress.milestone("cell problems");
    MeasuredWork whole, assembly, setup, solve;
    for (int run = 0; run < options.runs; ++run)
    {
      homogenization::Homogenization result;
      whole.seconds.push_back(seconds_of([&]() { result = solved(options.refine); }));
      whole.work = assembly.work = setup.work = solve.work = static_cast<double>(result.n_dofs);
      assembly.seconds.push_back(result.seconds.assembly);
      setup.seconds.push_back(result.seconds.preconditioner);
      solve.seconds.push_back(result.seconds.solve);
      solver = homogenization::name_of(result.solver);
    }
    const int ranks = static_cast<int>(n_ranks_of(communicator));
    add("homogenize", whole, "DoF", "", ranks);
    add("homogenize: assembly", assembly, "DoF", "", ranks);
    add("homogenize: factor or multigrid", setup, "DoF", "", ranks);
    add("homogenize: solve", solve, "DoF", "", ranks);
    progress.done();
  }

  meshes::HomogenizedCell homogenized_on_its_mesh() const
  {
    return homogenization::homogenized_cell(cell, solved(0), provenance_line());
  }

  void machine()
  {
    progress.milestone("memory and multiplications");
    constexpr std::size_t large = 8u << 20; // numbers, 64 MB: in no cache
    add("copy", copy_limit(large * sizeof(double), options.runs), "B moved");
    add("triad", triad_limit(large, options.runs), "B moved");
    add("dgemm", product_limit(256, options.runs), "flop");
    progress.done();
  }

  /// The scene from its beginning to its end, a step up-sampled each time; the parts of a step in
  /// its last state.
  void moving_cloth(const meshes::HomogenizedCell &homogenized)
  {
    const DrapedCell draped(scene, cell, homogenized);
    const DrapeSchedule schedule(scene);
    const Upsampler3f upsampler = draped.upsampler<float>(Method("localized"));
    const HeldMotion motion     = draped.coarse_motion();
    Upsampler3f::Fine fine;
    MeasuredWork step, upsampling;
    step.work = draped.coarse.n_triangles();
    std::unique_ptr<SceneCloth> moving;
    progress.milestone("coarse steps");
    for (int run = 0; run < options.runs; ++run)
    {
      moving         = std::make_unique<SceneCloth>(scene, draped.coarse, draped.effective, motion);
      factorizations = 0;
      n_steps        = schedule.n_frames * schedule.steps_per_frame;
      for (int k = 0; k < n_steps; ++k)
      {
        step.seconds.push_back(
          seconds_of([&]() { factorizations += moving->step(schedule.step).newton_iterations; }));
        upsampling.seconds.push_back(
          seconds_of([&]() { upsampler.upsample(moving->cloth().positions(), fine); }));
      }
    }
    add("step", step, "triangle");
    progress.done();
    progress.milestone("parts of a step");
    parts_of_a_step(*moving, draped, schedule.step);
    upsampling.work    = 2. * static_cast<double>(fine.size()) * sizeof(float);
    n_fine             = draped.fine_triangles().rows();
    const auto written = static_cast<std::size_t>(fine.size()) * sizeof(float);
    add("copy of the fine positions", copy_limit(written, options.runs), "B moved");
    add("up-sampling", upsampling, "B moved", "copy of the fine positions");
    progress.done();
  }

  void parts_of_a_step(const SceneCloth &moving, const DrapedCell &draped, const double time_step)
  {
    StepMatrix step(draped, moving);
    n_coarse = draped.coarse.n_triangles();
    MeasuredWork assembly;
    assembly.seconds = repeated_seconds([&]() { step.assemble(); }, options.runs);
    assembly.work    = flops_of_triangle * n_coarse;
    add("step: assembly", assembly, "flop", "dgemm");

    step.add_masses(time_step);
    shell::BlockCholesky cholesky(step.matrix);
    MeasuredWork factor;
    bool is_definite = true;
    factor.seconds =
      repeated_seconds([&]() { is_definite = cholesky.factorize(step.matrix); }, options.runs);
    factor.work = 2. * cholesky.n_multiply_adds();
    if (!is_definite)
      throw meshes::NotConverged("the matrix of a step is not positive definite", {});
    add("step: factor", factor, "flop", "dgemm");

    // The factor is read forwards and backwards.
    const auto bytes = cholesky.n_entries() * sizeof(double);
    add("copy of the factor", copy_limit(bytes, options.runs), "B moved");
    MeasuredWork substitution;
    shell::Vectors result;
    substitution.seconds =
      repeated_seconds([&]() { cholesky.solve(step.gradient, result); }, options.runs);
    substitution.work = 2. * static_cast<double>(bytes);
    add("step: substitution", substitution, "B moved", "copy of the factor");
  }

  void write() const
  {
    Table<BenchmarkRow> table(options.output);
    for (const BenchmarkRow &row : rows)
      table.append(row);
    double load[3]      = {};
    const bool has_load = getloadavg(load, 3) == 3;
    write_json(
      options.output + "/benchmark.json",
      {{"command", options.command},
       {"cell", cell.name},
       {"scene", scene.name},
       {"refine", options.refine},
       {"solver", solver},
       {"coarse_triangles", n_coarse},
       {"fine_triangles", n_fine},
       {"steps", n_steps},
       {"factorizations_per_step", static_cast<double>(factorizations) / std::max(n_steps, 1)},
       {"processors", std::thread::hardware_concurrency()},
       {"load_of_machine", json_number(has_load ? load[0] : std::nan(""))},
       {"provenance", provenance(n_ranks_of(communicator))}});
  }

  const BenchmarkOptions options;
  const MPI_Comm communicator;
  const homogenization::UnitCell cell;
  const Scene scene;
  Progress progress;
  std::vector<BenchmarkRow> rows;
  std::string solver;
  int n_coarse = 0, n_steps = 0, factorizations = 0; ///< of one run of the scene
  Eigen::Index n_fine = 0;
};
} // namespace

std::vector<BenchmarkRow> run_benchmark(const BenchmarkOptions &options,
                                        const MPI_Comm communicator)
{
  return Benchmark(options, communicator).run();
}
} // namespace homespun::verification
