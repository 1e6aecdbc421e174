// SPDX-License-Identifier: MIT
#include "verification/strain/run_time.h"

#include "localization/upsampler.h"
#include "meshes/plain/errors.h"
#include "verification/cell/discretization_distance.h"
#include "verification/method/coarse_model.h"
#include "verification/method/warped_rest.h"
#include "verification/record/number_text.h"
#include "verification/record/on_root.h"
#include "verification/record/timing.h"
#include "verification/reference/fine_reference.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <tuple>

namespace homespun::verification
{
namespace
{
using meshes::Points;
using Clock = std::chrono::steady_clock;

double seconds_since(const Clock::time_point begin)
{
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// What one way came to.
struct Timed
{
  Points positions;            ///< at the fine vertices [m]
  std::vector<double> seconds; ///< of each run
  RunTimeRow row = {};         ///< what is known of it before it is written
};

class RunTimeStudy : SheetUnderLoad
{
public:
  RunTimeStudy(const SheetUnderLoad &of, const RunTimeOptions &options,
               const std::vector<UncertaintyRow> &uncertainty, Table<RunTimeRow> *table,
               const MPI_Comm communicator, const std::function<void(const std::string &)> &tell)
      : SheetUnderLoad(of)
      , options(options)
      , uncertainty(uncertainty)
      , table(table)
      , communicator(communicator)
      , tell(tell)
  {
  }

  std::string run()
  {
    // The last one.
    if (answer_of_root(table != nullptr && has("nodal-warping"), communicator))
      return {};
    Timed p2 = fine(2);
    if (p2.positions.size() == 0)
      return "the best reference finds no equilibrium; " + p2.row.note;
    best         = p2.positions;
    Timed p1     = fine(1);
    p1.row.ranks = p2.row.ranks = n_ranks_of(communicator);
    on_root(communicator,
            [&]()
            {
              bar = bar_of_p2(uncertainty, {cell.name, load.name, options.law, options.strain},
                              sheet.n1, order_of_p2(cell, order_of_p2_sheet));
              p2.row.mean = bar;
              p2.row.note += std::string(p2.row.note.empty() ? "" : "; ") +
                             "what the others are held against: its error is its own error bar";
              write("fine-p2", p2);
              write("fine-p1", p1);
              full_resolution();
              coarse_cloths();
            });
    return {};
  }

private:
  bool has(const std::string &way) const
  {
    return table->contains({cell.name, load.name, options.strain, name_of(options.law), way});
  }

  /// Repeats a run up to the number asked for, or until it has taken long enough.
  template <typename Run>
  void repeat(Timed &outcome, const Run &one) const
  {
    const Clock::time_point begin = Clock::now();
    for (int k = 0; k < options.n_runs; ++k)
    {
      const Clock::time_point of_run = Clock::now();
      one();
      outcome.seconds.push_back(seconds_since(of_run));
      if (seconds_since(begin) > options.seconds_of_a_way)
        break;
    }
    say_if_fewer(outcome);
  }

  void say_if_fewer(Timed &outcome) const
  {
    if (const auto n = static_cast<int>(outcome.seconds.size()); n < options.n_runs)
      outcome.row.note = std::to_string(n) + " of " + std::to_string(options.n_runs) +
                         " runs: together they took more than " +
                         short_text(options.seconds_of_a_way) + " s";
  }

  Timed fine(const unsigned int order)
  {
    const std::string name = order == 1 ? "P1" : "P2";
    Timed outcome;
    outcome.row.triangles = sheet.mesh.n_triangles();
    FineReference reference(sheet, cell.stiffness_of_phase(), {order, 0}, communicator);
    double spent = 0.; // slowest rank, the same on all
    for (int k = 0; k < options.n_runs && spent <= options.seconds_of_a_way; ++k)
    {
      tell("fine " + name + ", run " + std::to_string(k + 1));
      reference.start(load, options.law);
      const ReferenceStep step = reference.advance(options.strain);
      if (!step.reached)
      {
        Timed none;
        none.row.note = step.why;
        return none;
      }
      outcome.seconds.push_back(step.seconds);
      spent += step.seconds;
      outcome.positions = step.positions;
    }
    say_if_fewer(outcome);
    return outcome;
  }

  /// A way that the law of the study leaves no meaning has a row that says so.
  bool is_corotational(const char *const way)
  {
    if (options.law == Law::biot)
      return true;
    leave_out(way, "its law is biot, and that of the others " + name_of(options.law));
    return false;
  }

  void leave_out(const std::string &way, const std::string &why)
  {
    Timed none;
    none.row.note = "left out: " + why;
    write(way, none);
  }

  void full_resolution()
  {
    if (!is_corotational("fine-corotational"))
      return;
    tell("fine corotational");
    const shell::Positions<2> start =
      moved_affinely(load, sheet, sheet.mesh.vertices, options.strain);
    Timed outcome;
    outcome.row.triangles = sheet.mesh.n_triangles();
    const shell::MembraneSolver solver(shell::membrane(sheet.mesh, cell.stiffness_of_phase()),
                                       held_vertices(load, sheet, sheet.mesh.vertices));
    attempt("fine-corotational", outcome,
            [&]() {
              repeat(outcome,
                     [&]() { outcome.positions = solver.solve_equilibrium(start).positions; });
            });
  }

  void coarse_cloths()
  {
    for (const int quads : {5, 10, 20, 40})
      for (const char *method : {"affine", "localized"})
        coarse_cloth(method + ("-" + std::to_string(quads)), method, quads, homogenized.stiffness);
    coarse_cloth("voigt", "localized", sheet.n1, bounds.voigt);
    if (bounds.reuss.isZero())
      leave_out("reuss", "of a cell with holes Reuss's bound is zero");
    else
      coarse_cloth("reuss", "localized", sheet.n1, bounds.reuss);

    for (const std::string &name : distinct_methods(options.methods, options.law, load))
      own_cloth(Method(name));
    if (is_corotational("nodal-warping"))
      nodal_warping();
  }

  void nodal_warping()
  {
    const CoarseModel coarse({homogenized}, sheet, load, Method("localized"), options.law);
    const Points &rest          = coarse.mesh().vertices;
    const Points start          = moved_affinely(load, sheet, rest, options.strain);
    const std::vector<int> held = held_vertices(load, sheet, rest);
    upsampled("nodal-warping", coarse,
              [&]() { return Moved{warped_rest(coarse.mesh(), homogenized, start, held)}; });
  }

  void coarse_cloth(const std::string &way, const std::string &method, const int quads,
                    const Eigen::Matrix3d &stiffness)
  {
    meshes::HomogenizedCell of = homogenized;
    of.stiffness               = stiffness;
    // As many quads along the other side as there are per cell along the first.
    const Quads along = {quads, std::max(1, quads * sheet.n2 / sheet.n1)};
    const CoarseModel model({of}, sheet, load, Method(method), options.law, along);
    upsampled(way, model, [&]() { return solved(model); });
  }

  void own_cloth(const Method &asked)
  {
    CellModel of          = {homogenized, options.edges};
    const Method own      = under(asked, options.law, load),
                 method   = CoarseModel::used(asked, options.law, load, sheet, of);
    const std::string way = asked.name + "-" + std::to_string(sheet.n1);
    for (const char *plain : {"affine", "localized"})
      if (own.has_terms_of(Method(plain)))
      {
        if (asked.name != plain)
          leave_out(way, std::string("under this law it is ") + plain);
        return;
      }
    if (const std::string less = own.beyond(method); !less.empty())
      return leave_out(way, "without " + less + " here it is another method; notes say why");
    if (method.has_fitted_modes(options.law) && options.fitted == nullptr)
      return leave_out(way, "no modes were fitted; a note says why");
    if (has(way))
      return;
    if (method.has_fitted_modes(options.law))
      of.fitted = options.fitted;
    const CoarseModel model(of, sheet, load, method, options.law);
    upsampled(way, model, [&]() { return solved(model); });
  }

  /// A coarse cloth in equilibrium, as up-sampling reads it.
  struct Moved
  {
    shell::Positions<2> positions;
    int steps = 0; ///< Newton steps; 0 where there are none
  };

  Moved solved(const CoarseModel &model) const
  {
    const CoarseState state = model.solve(options.strain);
    return {model.on_grid(state), state.iterations};
  }

  /// Solves a coarse cloth and up-samples it: timed in single precision, held against the best in
  /// double.
  template <typename Solve>
  void upsampled(const std::string &way, const CoarseModel &model, const Solve &solve)
  {
    const auto in_float  = model.upsampler<float>();
    const auto in_double = model.upsampler<double>();
    tell(way);
    localization::Upsampler<2, float>::Fine fine;
    Timed outcome;
    outcome.row.triangles = model.mesh().n_triangles() / (model.method.has(Term::p2) ? 4 : 1);
    attempt(way, outcome,
            [&]()
            {
              Moved moved;
              repeat(outcome,
                     [&]()
                     {
                       moved = solve();
                       in_float.upsample(moved.positions, fine);
                     });
              outcome.row.upsample =
                median_seconds([&]() { in_float.upsample(moved.positions, fine); });
              if (moved.steps > 0)
                outcome.row.step = (median(outcome.seconds) - outcome.row.upsample) / moved.steps;
              localization::Upsampler<2, double>::Fine best_of_way;
              in_double.upsample(moved.positions, best_of_way);
              outcome.positions = best_of_way;
            });
  }

  /// A way that finds no equilibrium has a row that says so.
  template <typename Work>
  void attempt(const std::string &way, Timed &outcome, const Work &work)
  {
    if (has(way))
      return;
    try
    {
      work();
    }
    catch (const meshes::NotConverged &failure)
    {
      outcome.positions.resize(0, 2);
      outcome.row.note = std::string("no equilibrium found; ") + failure.what();
    }
    write(way, outcome);
  }

  /// The mean error is the distance from the best solution, unless it is known already.
  void write(const std::string &way, const Timed &outcome)
  {
    if (has(way))
      return;
    RunTimeRow row = outcome.row;
    std::tie(row.cell, row.load, row.strain, row.reference, row.way) =
      std::tuple(cell.name, load.name, options.strain, name_of(options.law), way);
    if (outcome.positions.size() > 0)
      row.seconds = median(outcome.seconds);
    if (outcome.positions.size() > 0 && way != "fine-p2" && !std::isfinite(row.mean))
      row.mean = (outcome.positions - best).rowwise().norm().mean();
    row.per_cell    = row.mean / std::sqrt(cell.lattice.area());
    row.uncertainty = bar;
    row.runs        = static_cast<int>(outcome.seconds.size());
    table->append(row);
  }

  const RunTimeOptions &options;
  const std::vector<UncertaintyRow> &uncertainty;
  Table<RunTimeRow> *const table;
  const MPI_Comm communicator;
  const std::function<void(const std::string &)> &tell;
  Points best;
  double bar = 0.;
};
} // namespace

double bar_of_p2(const std::vector<UncertaintyRow> &rows, const StrainLevel &level,
                 const int n_cells, const double order)
{
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  double small = unknown, full = unknown, of_p2 = unknown;
  int n_small = 0;
  for (const UncertaintyRow &row : rows)
    if (row.cell == level.cell && row.load == level.load && row.is_of_reference() &&
        std::isfinite(row.p2_to_refined))
    {
      n_small = row.cells;
      if (row.reference == name_of(level.law) || !std::isfinite(of_p2))
      {
        // P2 in the place of P1.
        const DiscretizationDistance its = {row.p1_to_p2, row.p2_to_refined, row.p2_to_refined};
        of_p2                            = its.uncertainty(order) / row.strain;
      }
    }
  for (const UncertaintyRow &row : rows)
    if (row.cell == level.cell && row.load == level.load && row.is_of_reference() &&
        row.reference == name_of(Law::linear))
    {
      if (row.cells == n_small)
        small = row.p1_to_p2 / row.strain;
      if (row.cells == n_cells)
        full = row.p1_to_p2 / row.strain;
    }
  return of_p2 * (full / small) * level.strain;
}

std::string run_time_study(const SheetUnderLoad &of, const RunTimeOptions &options,
                           const std::vector<UncertaintyRow> &uncertainty, Table<RunTimeRow> *table,
                           const MPI_Comm communicator,
                           const std::function<void(const std::string &)> &tell)
{
  return RunTimeStudy(of, options, uncertainty, table, communicator, tell).run();
}
} // namespace homespun::verification
