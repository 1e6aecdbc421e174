// SPDX-License-Identifier: MIT
#include "verification/extremes/stress_study.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/sheet.h"
#include "verification/cell/study_of_cells.h"
#include "verification/extremes/stress_cases.h"
#include "verification/extremes/stress_solver.h"
#include "verification/record/number_text.h"
#include "verification/record/on_root.h"
#include "verification/record/progress.h"
#include "verification/record/provenance.h"
#include "verification/record/table.h"

#include <memory>
#include <set>

namespace homespun::verification
{
namespace
{
nlohmann::ordered_json what_was_left_out(const int most_triangles, const int n_ranks)
{
  const auto left_out = [](const char *what, const char *why) {
    return nlohmann::ordered_json{{"what", what}, {"why", why}};
  };
  nlohmann::ordered_json all = {
    left_out("1e6 steps at rest",
             "20,000 steps in each repetition, on a sheet of 8 triangles, to end in minutes"),
    left_out("cloth and up-sampling on many threads and ranks",
             "the cases run on one thread of one rank"),
    left_out("linear strain field of the up-sampling, O(cell)",
             "an order, which the strain study measures"),
    left_out("a resumed run equals an uninterrupted one",
             "a test of the moving cloth holds it to the last bit")};
  if (most_triangles < 1000000)
    all.push_back(left_out("a cell of 1e6 triangles", "1e5 at most, to end in minutes"));
  if (n_ranks == 1)
    all.push_back(left_out("C^H by several ranks beside one", "the study ran on one rank"));
  return all;
}

/// @param has_cells whether any were given
std::vector<std::string> notes(const bool has_cells)
{
  std::vector<std::string> all = {
    "A case is repeated with different seeds where it has random numbers; else every repetition "
    "must give the same numbers to the last bit. Cells are homogenized twice, those of 100,000 "
    "triangles and more once.",
    "C^H of a cell is held against the closed form of a laminate, against a factorized solve, or "
    "against itself moved, by the relative energy of the worst macro strain.",
    "Of a free sheet that spins each integrator is asked for what its theory gives: both Euler "
    "methods for their linear momentum and a falling energy, the conserving one for both momenta "
    "and the energy. That a sheet turns is judged by (x_new − x_old)/h: half of what a rigid body "
    "would turn by is asked for.",
    "A stiffness that loses ellipticity under the corotational law, pulled along its yarns, before "
    "20 %, has a twin under the law yarn.",
    "The figure of a case is the largest of its repetitions; the time is that of all of them.",
    "Each limit stands in stress.csv with where it comes from: theory, round-off, or a "
    "requirement. Iterations and times of the solver have none: they are reported."};
  if (!has_cells)
    all.push_back(
      "No cell was given: the cloths are sheets of three built-in stiffnesses, and up-sampling "
      "takes a cell of smooth modes.");
  return all;
}

class StressStudy final : public StudyOfCells
{
public:
  StressStudy(const StressStudyOptions &options, const MPI_Comm communicator)
      : StudyOfCells("stress", options, communicator)
      , options(options)
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
    homogenize_given();
    homogenize_by_all_ranks();
    on_root(communicator,
            [&]()
            {
              collect();
              run_cases();
              measure_solver();
            });
  }

  /// C^H and chi of the given cells.
  void homogenize_given()
  {
    Progress progress(is_root && !options.quiet, static_cast<int>(cells().size()));
    for (const homogenization::UnitCell &cell : cells())
    {
      progress.milestone(cell.name + ": homogenization");
      const AssessedCell &assessed = homogenize(cell, {}, verdicts);
      homogenized.push_back(
        homogenization::homogenized_cell(cell, assessed.result, provenance_line()));
      names.push_back(cell.name);
      stiffnesses.push_back(
        {cell.name, homogenized.back().stiffness, homogenized.back().areal_density});
      progress.done();
    }
    if (homogenized.empty())
    {
      homogenized = {smooth_cell()};
      names       = {"smooth modes"};
      stiffnesses = built_in_stiffnesses();
    }
  }

  /// The cells that the cases move, by all ranks, to be held against one.
  void homogenize_by_all_ranks()
  {
    if (n_ranks() == 1)
      return;
    std::vector<homogenization::UnitCell> moved = built_in_cells();
    moved.insert(moved.end(), cells().begin(), cells().end());
    homogenization::HomogenizationOptions p1;
    p1.order = 1;
    for (const homogenization::UnitCell &cell : moved)
      by_all_ranks.push_back(homogenization::homogenize(cell, p1, communicator).stiffness);
  }

  int n_ranks() const
  {
    return static_cast<int>(n_ranks_of(communicator));
  }

  void collect()
  {
    stiffnesses = with_twins_of_yarn(stiffnesses);
    for (const std::vector<StressCase> &some :
         {cell_cases(cells(), by_all_ranks, n_ranks(), options.most_triangles),
          time_step_cases(stiffnesses), stiffness_cases(), start_cases(stiffnesses),
          spin_cases(stiffnesses), motion_cases(stiffnesses), scene_cases(stiffnesses[0]),
          localization_cases(homogenized, names)})
      cases.insert(cases.end(), some.begin(), some.end());
    std::set<std::vector<std::string>> keys;
    for (const StressCase &one : cases)
      if (!keys.insert(keys_of_row(keys_of(one))).second)
        throw meshes::BadInput("two stress cases are called `" + one.group + ": " + one.name +
                               "`; a cell has the name of a built-in one: rename its file");
  }

  void run_cases()
  {
    Progress progress(is_root && !options.quiet, static_cast<int>(cases.size()));
    std::string group;
    for (const StressCase &one : cases)
    {
      if (table->contains(keys_of(one)))
      {
        progress.done();
        continue;
      }
      if (one.group == group)
        progress.begin(one.group + ": " + one.name);
      else
        progress.milestone(one.group);
      group                     = one.group;
      const StressResult result = run_case(one, options.repeats);
      table->append(stress_row(one, result));
      if (result.verdict != Outcome::pass)
        progress.note("FAIL " + one.group + ": " + one.name + ": " + result.outcome + ", " +
                      short_text(result.figure) + " (" + limit_text(one) + ")");
      progress.done();
    }
  }

  /// Iterations and times, which have no limit.
  void measure_solver()
  {
    Table<SolverRow> rows(options.output);
    const std::vector<SolverMeasurement> all = solver_measurements();
    Progress progress(is_root && !options.quiet, static_cast<int>(all.size()));
    std::string parameter;
    for (const SolverMeasurement &one : all)
    {
      const std::string what = "solver: " + one.keys.parameter + " " + short_text(one.keys.value);
      if (one.keys.parameter == parameter)
        progress.begin(what);
      else
        progress.milestone(what);
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
    nlohmann::ordered_json sheets = nlohmann::ordered_json::array();
    for (const SheetStiffness &sheet : stiffnesses)
    {
      nlohmann::ordered_json rows = nlohmann::ordered_json::array();
      for (int i = 0; i < 3; ++i)
        rows.push_back({sheet.D(i, 0), sheet.D(i, 1), sheet.D(i, 2)});
      sheets.push_back({{"name", sheet.name},
                        {"stiffness_N_per_m", rows},
                        {"areal_density_kg_per_m2", sheet.areal_density}});
    }
    return {{{"cases", cases.size()}, {"repeats", options.repeats}, {"sheets", sheets}},
            what_was_left_out(options.most_triangles, n_ranks()),
            notes(!cells().empty())};
  }

  const StressStudyOptions options;
  std::vector<Eigen::Matrix3d> by_all_ranks; ///< C^H of the cells that the cases move
  std::vector<meshes::HomogenizedCell> homogenized;
  std::vector<std::string> names; ///< of the cells
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
