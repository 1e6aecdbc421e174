// SPDX-License-Identifier: MIT
#include "verification/stress/stress_study.h"

#include "homogenization/fem/homogenize.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/sheet.h"
#include "verification/cell/energy_order.h"
#include "verification/cell/study_of_cells.h"
#include "verification/record/number_text.h"
#include "verification/record/on_root.h"
#include "verification/record/progress.h"
#include "verification/record/provenance.h"
#include "verification/record/table.h"
#include "verification/stress/stress_axes.h"
#include "verification/stress/stress_localization.h"
#include "verification/stress/stress_moved_cells.h"
#include "verification/stress/stress_sheet_axes.h"

#include <memory>
#include <set>

namespace homespun::verification
{
namespace
{
nlohmann::ordered_json what_was_left_out(const int most_triangles, const int n_ranks,
                                         const bool has_cells)
{
  nlohmann::ordered_json all;
  const auto left_out = [&](const char *what, const char *why) {
    all.push_back({{"what", what}, {"why", why}});
  };
  left_out("cloth and up-sampling on many threads and ranks",
           "the cases run on one thread of one rank");
  left_out("what tests the program and no limit of a cell or a cloth",
           "the tests of the program hold it");
  if (!has_cells)
    left_out("a cell moved, turned, mirrored, in other units; its contrast; its up-sampling",
             "no cell was given");
  if (most_triangles < 1000000)
    left_out("a cell of 1e6 triangles", "1e5 at most, to end in minutes");
  if (n_ranks == 1)
    left_out("C^H by several ranks beside one", "the study ran on one rank");
  return all;
}

const std::vector<std::string> notes = {
  "A case is repeated with different seeds where it has random numbers; else every repetition must "
  "give the same numbers to the last bit. Cells are homogenized twice, those of 100,000 triangles "
  "and more once.",
  "C^H of a cell is held against the closed form of a laminate, against a direct solve, or against "
  "itself moved, by the relative energy of the worst macro strain.",
  "Of a free sheet that spins each integrator is asked for what its theory gives: both Euler "
  "methods for their linear momentum and a falling energy, the conserving one for both momenta and "
  "the energy. That a sheet turns is judged by (x_new − x_old)/h: half of what a rigid body would "
  "turn by is asked for. The turn per step is doubled until one of these fails; "
  "it must not end before the spin stretches the sheet by a half.",
  "A stiffness that loses ellipticity under the corotational law, pulled along its yarns, before "
  "20 %, has a twin under the law yarn.",
  "The figure of a case is the largest of its repetitions; the time is that of all of them.",
  "Each limit stands in stress.csv with where it comes from: theory, round-off, or a requirement. "
  "Iterations and times of the solver have none: they are reported."};

class StressStudy final : public StudyOfCells
{
public:
  StressStudy(const StressStudyOptions &options, const MPI_Comm communicator)
      : StudyOfCells("stress", options, communicator)
      , options(options)
      , axes(cell_axes(cells()))
  {
  }

private:
  void refuse() const override
  {
    for (const homogenization::UnitCell &cell : cells())
      meshes::tile(cell.mesh, cell.lattice, 1, 1); // refuses cells that make no sheet
  }

  nlohmann::ordered_json inputs() override
  {
    return {{"repeats", options.repeats},
            {"most_triangles", options.most_triangles},
            {"ranks", n_ranks()}};
  }

  void open_tables() override
  {
    table = std::make_unique<Table<StressRow>>(options.output);
  }

  void work() override
  {
    Progress progress(is_root && !options.quiet, static_cast<int>(cells().size()));
    for (const homogenization::UnitCell &cell : cells())
    {
      progress.milestone(cell.name + ": homogenization");
      take(cell);
      progress.done();
    }
    on_root(communicator,
            [&]()
            {
              collect();
              run_cases();
              measure_solver();
            });
  }

  /// The cases of a given cell. All ranks.
  void take(const homogenization::UnitCell &cell)
  {
    const meshes::HomogenizedCell homogenized = homogenization::homogenized_cell(
      cell, homogenize(cell, {}, verdicts).result, provenance_line());
    stiffnesses.push_back({cell.name, homogenized.stiffness, homogenized.areal_density});
    add(moved_cell_cases(cell));
    add(localization_cases(homogenized, cell.name));
    if (n_ranks() == 1)
      return;
    homogenization::HomogenizationOptions p1;
    p1.order                       = 1;
    const Eigen::Matrix3d parallel = homogenization::homogenize(cell, p1, communicator).stiffness;
    cases.emplace_back(
      "cell ranks", std::to_string(n_ranks()) + " beside one; " + cell.name, "finite; the same C^H",
      limit_of(cell, "largest relative energy difference to one rank [-]"), Repeats::twice,
      [=](unsigned int) -> StressAnswer {
        return {energy_difference(parallel, solved(cell).stiffness), parallel};
      });
  }

  void collect()
  {
    add(axis_cases(axes, options.most_triangles));
    const std::vector<SheetStiffness> sheets =
      with_twins_of_yarn(cells().empty() ? built_in_stiffnesses() : stiffnesses);
    add(time_step_cases(sheets));
    add(stiffness_cases());
    add(spin_cases(sheets));
    std::set<std::vector<std::string>> keys;
    for (const StressCase &one : cases)
      if (!keys.insert(keys_of_row(one.row)).second)
        throw meshes::BadInput("two stress cases are called `" + one.row.group + ": " +
                               one.row.name +
                               "`; a cell has the name of a built-in one: rename its file");
  }

  void add(const std::vector<StressCase> &some)
  {
    cases.insert(cases.end(), some.begin(), some.end());
  }

  int n_ranks() const
  {
    return static_cast<int>(n_ranks_of(communicator));
  }

  void run_cases()
  {
    Progress progress(is_root && !options.quiet, static_cast<int>(cases.size()));
    std::string group;
    for (const StressCase &one : cases)
    {
      const std::string what = one.row.group + ": " + one.row.name;
      one.row.group == group ? progress.begin(what) : progress.milestone(one.row.group);
      group = one.row.group;
      if (!table->contains(one.row))
      {
        const StressRow row = run_case(one, options.repeats);
        table->append(row);
        if (row.verdict != Outcome::pass)
          progress.note("FAIL " + what + ": " + row.outcome + ", " + short_text(row.figure) + " (" +
                        row.limit + ")");
      }
      progress.done();
    }
  }

  /// Iterations and times, which have no limit.
  void measure_solver()
  {
    Table<SolverRow> rows(options.output);
    const std::vector<SolverMeasurement> all = solver_measurements(axes);
    Progress progress(is_root && !options.quiet, static_cast<int>(all.size()));
    std::string parameter;
    for (const SolverMeasurement &one : all)
    {
      const std::string what = "solver: " + one.keys.parameter + " " + short_text(one.keys.value);
      one.keys.parameter == parameter ? progress.begin(what) : progress.milestone(what);
      parameter = one.keys.parameter;
      if (!rows.contains(one.keys))
        rows.append(one.run(options.repeats > 2 ? 3 : 1));
      progress.done();
    }
  }

  StudyDescription conclude() override
  {
    for (const Verdict &verdict : stress_verdicts(table->rows()))
      verdicts.push_back(verdict);
    return {{{"cases", cases.size()}, {"repeats", options.repeats}},
            what_was_left_out(options.most_triangles, n_ranks(), !cells().empty()),
            notes};
  }

  const StressStudyOptions options;
  const std::vector<CellAxis> axes;
  std::vector<SheetStiffness> stiffnesses;
  std::vector<StressCase> cases;
  std::unique_ptr<Table<StressRow>> table; ///< on the first rank alone
};
} // namespace

std::vector<Verdict> run_stress_study(const StressStudyOptions &options,
                                      const MPI_Comm communicator)
{
  return StressStudy(options, communicator).run();
}
} // namespace homespun::verification
