// SPDX-License-Identifier: MIT
// What solves the step of a coarse cloth fastest, over all steps of a scene: the house's block
// Cholesky, CHOLMOD's supernodes, and a factor kept over steps as preconditioner of conjugate
// gradients.
//
//   step_solvers CELL.prm SCENE.prm
//
// The scene is run once. The matrix of each of its steps is assembled again at the positions where
// the step began, and solved for a right side whose answer is known: the way that the cloth went in
// that step. Seconds are those of factor, substitution and iterations, without the assembly, which
// all share; errors are the largest over the vertices of what a solve misses of the way, added up
// over the steps.
#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_reading.h"
#include "shell/algebra/block_cholesky.h"
#include "shell/terms/membrane_term.h"
#include "verification/drape/drape_schedule.h"
#include "verification/drape/draped_cell.h"
#include "verification/drape/scene_cloth.h"

#include <deal.II/base/mpi.h>

#include <cholmod.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <numeric>

using namespace homespun;
using shell::BlockMatrix;
using shell::Vectors;

namespace
{
/// A step of the scene: where it began and the way of its free vertices.
struct Step
{
  Vectors begin, way;
};

/// Solves A x = b; x comes in as the way of the step before.
using Solve = std::function<void(const BlockMatrix &, const Vectors &, Vectors &)>;

/// What a solver took.
struct Took
{
  std::vector<double> seconds;
  double error      = 0.; ///< [m], added up over the steps
  double largest    = 0.; ///< of a step [m]
  int factors       = 0;
  double iterations = 0.; ///< a step
};

/// CHOLMOD's supernodal factor of the lower triangle, whose pattern is analysed once.
class Cholmod
{
public:
  explicit Cholmod(const BlockMatrix &matrix)
  {
    cholmod_start(&common);
    common.print          = 0;
    common.supernodal     = CHOLMOD_SUPERNODAL;
    const int n           = 3 * matrix.n_free();
    std::size_t n_entries = 0;
    for (int column = 0; column < matrix.n_free(); ++column)
      n_entries += 3 * rows_of(matrix, column).size() * 3;
    lower = cholmod_allocate_sparse(static_cast<std::size_t>(n), static_cast<std::size_t>(n),
                                    n_entries, 1, 1, -1, CHOLMOD_REAL, &common);
    auto *const first = static_cast<int *>(lower->p);
    auto *const rows  = static_cast<int *>(lower->i);
    int entry         = 0;
    for (int column = 0; column < matrix.n_free(); ++column)
      for (int j = 0; j < 3; ++j)
      {
        first[3 * column + j] = entry;
        for (const int block : rows_of(matrix, column))
          for (int i = 0; i < 3; ++i)
          {
            const int row = 3 * matrix.row[static_cast<std::size_t>(block)] + i;
            if (row < 3 * column + j)
              continue;
            rows[entry++] = row;
            places.push_back({block, i, j});
          }
      }
    first[n] = entry;
    copy(matrix);
    factor = cholmod_analyze(lower, &common);
    right  = cholmod_allocate_dense(static_cast<std::size_t>(n), 1, static_cast<std::size_t>(n),
                                    CHOLMOD_REAL, &common);
  }

  ~Cholmod()
  {
    cholmod_free_dense(&right, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_free_sparse(&lower, &common);
    cholmod_finish(&common);
  }
  Cholmod(const Cholmod &)            = delete;
  Cholmod &operator=(const Cholmod &) = delete;

  void solve(const BlockMatrix &matrix, const Vectors &b, Vectors &x)
  {
    copy(matrix);
    cholmod_factorize(lower, factor, &common);
    auto *const values = static_cast<double *>(right->x);
    for (int place = 0; place < matrix.n_free(); ++place)
      for (int i = 0; i < 3; ++i)
        values[3 * place + i] = b(matrix.vertex_at[static_cast<std::size_t>(place)], i);
    cholmod_dense *found     = cholmod_solve(CHOLMOD_A, factor, right, &common);
    const auto *const answer = static_cast<const double *>(found->x);
    x.setZero(b.rows(), 3);
    for (int place = 0; place < matrix.n_free(); ++place)
      for (int i = 0; i < 3; ++i)
        x(matrix.vertex_at[static_cast<std::size_t>(place)], i) = answer[3 * place + i];
    cholmod_free_dense(&found, &common);
  }

private:
  struct Place
  {
    int block, i, j;
  };

  /// Blocks of a column whose rows are free.
  static std::vector<int> rows_of(const BlockMatrix &matrix, const int column)
  {
    std::vector<int> blocks;
    for (int k = matrix.first[static_cast<std::size_t>(column)];
         k < matrix.first[static_cast<std::size_t>(column) + 1]; ++k)
      if (matrix.row[static_cast<std::size_t>(k)] < matrix.n_free())
        blocks.push_back(k);
    return blocks;
  }

  void copy(const BlockMatrix &matrix)
  {
    auto *values = static_cast<double *>(lower->x);
    for (const Place &place : places)
      *values++ = matrix.blocks[static_cast<std::size_t>(place.block)](place.i, place.j);
  }

  cholmod_common common;
  cholmod_sparse *lower  = nullptr;
  cholmod_factor *factor = nullptr;
  cholmod_dense *right   = nullptr;
  std::vector<Place> places;
};

/// Conjugate gradients with the factor of an earlier step, which is made anew where more than
/// `patience` iterations were needed.
class KeptFactor
{
public:
  KeptFactor(const BlockMatrix &matrix, const double tolerance, const int patience)
      : cholesky(matrix)
      , tolerance(tolerance)
      , patience(patience)
  {
  }

  void solve(const BlockMatrix &matrix, const Vectors &b, Vectors &x)
  {
    if (is_stale)
    {
      cholesky.factorize(matrix);
      ++factors;
      is_stale = false;
      cholesky.solve(b, x);
      return;
    }
    matrix.multiply(x, image);
    residual            = b - image;
    const double target = tolerance * b.norm();
    double product      = 0.;
    for (int iteration = 0; residual.norm() > target; ++iteration)
    {
      cholesky.solve(residual, preconditioned);
      const double before = product;
      product             = residual.cwiseProduct(preconditioned).sum();
      if (iteration == 0)
        direction = preconditioned;
      else
        direction = preconditioned + product / before * direction;
      matrix.multiply(direction, image);
      const double step = product / direction.cwiseProduct(image).sum();
      x += step * direction;
      residual -= step * image;
      ++iterations;
      is_stale = iteration + 1 >= patience;
    }
  }

  int factors = 0, iterations = 0;

private:
  shell::BlockCholesky cholesky;
  const double tolerance;
  const int patience;
  bool is_stale = true;
  Vectors residual, preconditioned, direction, image;
};

/// The scene, step by step, and the matrix of each.
class Scene
{
public:
  Scene(const std::string &cell_file, const std::string &scene_file)
      : cell(homogenization::read_unit_cell(cell_file, MPI_COMM_WORLD))
      , scene(verification::read_scene(scene_file))
      , draped(scene, cell, homogenized(), meshes::Law::biot)
      , time_step(verification::DrapeSchedule(scene).step)
      , membrane(shell::membrane_term(draped.coarse, draped.effective.stiffness))
  {
    const verification::DrapeSchedule schedule(scene);
    const verification::HeldMotion motion = draped.coarse_motion();
    verification::SceneCloth moving(scene, draped.coarse, draped.effective, motion);
    masses = moving.cloth().masses();
    std::vector<bool> is_held(static_cast<std::size_t>(masses.size()), false);
    for (const int vertex : motion.vertices(draped.coarse))
      is_held[static_cast<std::size_t>(vertex)] = true;
    for (int k = 0; k < schedule.n_frames * schedule.steps_per_frame; ++k)
    {
      Step step{moving.cloth().positions(), {}};
      moving.step(schedule.step);
      step.way = moving.cloth().positions() - step.begin;
      for (std::size_t v = 0; v < is_held.size(); ++v)
        if (is_held[v])
          step.way.row(static_cast<Eigen::Index>(v)).setZero();
      steps.push_back(std::move(step));
    }
    std::vector<std::array<int, 2>> pairs;
    membrane->couple(pairs);
    matrix = std::make_unique<BlockMatrix>(pairs, is_held);
    membrane->attach(*matrix);
  }

  /// @return mean seconds of an assembly
  Took measure(const Solve &solve)
  {
    Took took;
    Vectors gradient = Vectors::Zero(masses.size(), 3), b, x = gradient;
    for (const Step &step : steps)
    {
      assemble(step.begin, gradient);
      matrix->multiply(step.way, b);
      const auto start = std::chrono::steady_clock::now();
      solve(*matrix, b, x);
      took.seconds.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      const double missed = (x - step.way).rowwise().norm().maxCoeff();
      took.error += missed;
      took.largest = std::max(took.largest, missed);
    }
    return took;
  }

  void assemble(const Vectors &positions, Vectors &gradient)
  {
    matrix->clear();
    gradient.setZero();
    membrane->add_derivatives(positions, shell::Hessian::projected, gradient, *matrix);
    for (int v = 0; v < masses.size(); ++v)
      matrix->add_multiple(matrix->slot(v, v), masses(v) / (time_step * time_step));
  }

  double total_way() const
  {
    double way = 0.;
    for (const Step &step : steps)
      way += step.way.rowwise().norm().maxCoeff();
    return way;
  }

  std::unique_ptr<BlockMatrix> matrix;
  std::vector<Step> steps;

private:
  meshes::HomogenizedCell homogenized() const
  {
    homogenization::HomogenizationOptions options;
    options.order = 1;
    return homogenization::homogenized_cell(
      cell, homogenization::homogenize(cell, options, MPI_COMM_WORLD), "benchmark");
  }

  const homogenization::UnitCell cell;
  const verification::Scene scene;
  const verification::DrapedCell draped;
  const double time_step;
  const std::unique_ptr<shell::Term> membrane;
  Eigen::VectorXd masses;
};

void report(const std::string &name, Took took)
{
  std::vector<double> &seconds = took.seconds;
  std::sort(seconds.begin(), seconds.end());
  const auto n      = static_cast<double>(seconds.size());
  const double mean = std::accumulate(seconds.begin(), seconds.end(), 0.) / n;
  std::printf("%-40s %8.4f %8.4f %8.4f %7d %6.2f %10.1e %10.1e\n", name.c_str(),
              1e3 * seconds[seconds.size() / 2], 1e3 * mean,
              1e3 * seconds[static_cast<std::size_t>(0.95 * n)], took.factors, took.iterations,
              took.largest, took.error);
}

void compare(Scene &scene)
{
  const int n_steps = static_cast<int>(scene.steps.size());
  std::printf("%d steps, %d free vertices; the ways add up to %.3g m\n", n_steps,
              scene.matrix->n_free(), scene.total_way());
  std::printf("%-40s %8s %8s %8s %7s %6s %10s %10s\n", "", "median", "mean", "95 %", "factors",
              "iter.", "error", "added up");
  std::printf("%-40s %8s %8s %8s %7s %6s %10s %10s\n", "", "ms", "ms", "ms", "", "a step", "m",
              "m");
  for (int round = 0; round < 3; ++round)
  {
    shell::BlockCholesky house(*scene.matrix);
    Took took = scene.measure(
      [&](const BlockMatrix &A, const Vectors &b, Vectors &x)
      {
        house.factorize(A);
        house.solve(b, x);
      });
    took.factors = n_steps;
    report("block Cholesky of the house", took);

    Cholmod cholmod(*scene.matrix);
    took         = scene.measure([&](const BlockMatrix &A, const Vectors &b, Vectors &x)
                         { cholmod.solve(A, b, x); });
    took.factors = n_steps;
    report("CHOLMOD, supernodal", took);

    for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8})
      for (const int patience : {2, 4, 6})
      {
        KeptFactor kept(*scene.matrix, tolerance, patience);
        took            = scene.measure([&](const BlockMatrix &A, const Vectors &b, Vectors &x)
                             { kept.solve(A, b, x); });
        took.factors    = kept.factors;
        took.iterations = static_cast<double>(kept.iterations) / n_steps;
        char name[80];
        std::snprintf(name, sizeof(name), "kept factor, to %.0e, anew after %d", tolerance,
                      patience);
        report(name, took);
      }
  }
}
} // namespace

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc != 3)
  {
    std::fprintf(stderr, "found %d arguments; expected CELL.prm SCENE.prm\n", argc - 1);
    return 2;
  }
  Scene scene(argv[1], argv[2]);
  compare(scene);
  return 0;
}
