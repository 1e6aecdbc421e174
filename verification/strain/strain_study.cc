// SPDX-License-Identifier: MIT
#include "verification/strain/strain_study.h"

#include "meshes/plain/errors.h"
#include "verification/cell/cell_file_verdicts.h"
#include "verification/ellipticity/yarn_cells.h"
#include "verification/record/main_reference.h"
#include "verification/record/number_text.h"
#include "verification/record/on_root.h"
#include "verification/record/peak_memory.h"
#include "verification/record/progress.h"
#include "verification/record/provenance.h"
#include "verification/record/timing.h"
#include "verification/reference/fine_reference.h"
#include "verification/strain/budget/budget_study.h"
#include "verification/strain/budget/energy_sides.h"
#include "verification/strain/cell_references.h"
#include "verification/strain/claims/budget_verdicts.h"
#include "verification/strain/claims/coarse_checks.h"
#include "verification/strain/claims/self_checks.h"
#include "verification/strain/claims/study_claims.h"
#include "verification/strain/kept_positions.h"
#include "verification/strain/level_ellipticity.h"
#include "verification/strain/run_time.h"
#include "verification/strain/strain_comparison.h"
#include "verification/strain/strain_output.h"
#include "verification/strain/study_description.h"
#include "verification/strain/study_modes.h"

#include <algorithm>
#include <memory>
#include <numeric>

namespace homespun::verification
{
using homogenization::UnitCell;

namespace
{
class StrainStudy final : public StudyOfCells
{
public:
  StrainStudy(const StrainStudyOptions &asked, const MPI_Comm communicator)
      : StudyOfCells("strain", asked, communicator)
      , asked(asked)
      , n_ranks(n_ranks_of(communicator))
      , progress(is_root && !asked.quiet,
                 static_cast<int>(asked.cell_files.size() * asked.loads.size() *
                                  (1 + references_per_cell(asked) * asked.strains.size())))
  {
  }

private:
  void refuse() const override
  {
    check_yarns(cells(), "--references", asked.references);
    refuse_cells_without_sheets(cells());
  }

  nlohmann::ordered_json inputs() override
  {
    return strain_inputs(asked, cells());
  }

  std::vector<OwedClaim> owed() const override
  {
    return owed_of_strain(asked, cells());
  }

  /// Tables live on the first rank alone.
  void open_tables() override
  {
    options = options_of(asked, cells());
    output  = std::make_unique<StrainOutput>(options, [this](const std::string &line)
                                            { progress.note(line); });
    for (const std::string &note : notes_on_references(asked, cells()))
      progress.note(note);
    if (asked.keep)
      progress.note(note_on_keeping(asked, cells()));
  }

  void work() override
  {
    for (const UnitCell &cell : cells())
      study_cell(cell);
    options                          = options_of(asked, cells());
    const std::vector<double> memory = peak_memory_of_ranks(communicator);
    peak_memory                      = std::accumulate(memory.begin(), memory.end(), 0.);
  }

  void study_cell(const UnitCell &cell)
  {
    options = options_of(asked, cell);
    if (options.budget)
      budget = std::make_unique<BudgetStudy>(options.references, options.strains,
                                             output ? output->budget.get() : nullptr,
                                             output ? output->checks.get() : nullptr, communicator);
    progress.milestone(cell.name + ": homogenization");
    const CellNeeds needs        = {laws_of_second_order(options), has_edges(options)};
    const AssessedCell &assessed = homogenize(cell, needs, verdicts);
    on_root(communicator,
            [&]()
            {
              add(cell_file_verdicts(write_cell(cell, assessed) + "/cell.h5", cell));
              add(self_checks(cell, laws_of(options), options.strains.back()));
              if (const KnownRoll roll = roll_of(cell, {}); roll.rolled)
                output->least_radius_of_cell[cell.name] =
                  roll.rolled->worst(tolerated_stiffening).radius;
            });
    const auto homogenized = homogenized_cell(cell, assessed.result, provenance_line());
    edges                  = needs.edges ? *assessed.edges : KnownEdges();
    progress.begin(cell.name + ": coarse cloths and layers of small sheets");
    on_root(communicator,
            [&]()
            {
              fitted = modes_of_study(options, cell, homogenized, *output);
              add(coarse_checks(cell, {homogenized, edges.edges ? &*edges.edges : nullptr}));
            });
    ladder = kept_ladder(cell, {homogenized, edges.edges}, communicator);

    // Made where a load asks for them; the run times have references of their own.
    std::unique_ptr<SheetReferences> of_cell, of_sheet;
    for (const std::string &name : options.loads)
    {
      const Load load(name);
      std::unique_ptr<SheetReferences> &its = load.is_periodic() ? of_cell : of_sheet;
      const auto [n1, n2] =
        load.is_periodic() ? options.supercell : std::array{options.n_cells, options.n_cells};
      if (!its)
        its = std::make_unique<SheetReferences>(meshes::tile(cell.mesh, cell.lattice, n1, n2),
                                                cell.stiffness_of_phase(), communicator);
      study_load(cell, homogenized, load, *its);
    }
    on_root(communicator, [&]() { add(cell_verdicts(*output, options, cell, homogenized)); });
    if (has_run_times(options))
    {
      of_sheet.reset();
      study_run_time(cell, homogenized, {assessed.result.voigt, assessed.result.reuss},
                     meshes::tile(cell.mesh, cell.lattice, options.n_cells, options.n_cells));
    }
  }

  /// Every way to the positions at the pictured strain, where the coarse mesh matters most.
  void study_run_time(const UnitCell &cell, const meshes::HomogenizedCell &homogenized,
                      const StiffnessBounds &bounds, const meshes::Sheet &sheet)
  {
    for (const char *name : {"shear-frame", "strip-1", "strip-2"})
      if (std::find(options.loads.begin(), options.loads.end(), name) != options.loads.end())
      {
        const Load load(name);
        RunTimeOptions of_run;
        of_run.strain  = pictured_strain(options);
        of_run.methods = options.methods;
        of_run.n_runs  = options.is_quick ? 3 : of_run.n_runs;
        of_run.law     = law_of(main_reference(options.references));
        of_run.edges   = edges.edges ? &*edges.edges : nullptr;
        if (const auto found = fitted.find(of_run.law); found != fitted.end())
          of_run.fitted = &found->second;
        const std::string fault =
          run_time_study({cell, homogenized, bounds, sheet, load}, of_run,
                         output ? output->uncertainty.rows() : std::vector<UncertaintyRow>(),
                         output ? output->run_time.get() : nullptr, communicator,
                         [&](const std::string &what) {
                           progress.begin(cell.name + ", " + load.name + ", run times: " + what);
                         });
        note({cell.name, load.name, of_run.law, of_run.strain}, "run times: ", fault);
        return;
      }
  }

  void study_load(const UnitCell &cell, const meshes::HomogenizedCell &homogenized,
                  const Load &load, SheetReferences &references)
  {
    if (options.budget && !load.is_periodic())
    {
      progress.begin(cell.name + ", " + load.name + ": energy of the reference between two sides");
      measure_energies(cell, load, options.n_cells, output ? output->checks.get() : nullptr,
                       communicator);
    }
    const std::vector<Law> laws = laws_of(options);
    // What is missing is told to all ranks, so that they ask for the same laws.
    if (std::all_of(laws.begin(), laws.end(),
                    [&](const Law law) { return missing_strains(cell, load, law).empty(); }))
    {
      progress.milestone(cell.name + ", " + load.name + ": all rows are there");
      for (std::size_t k = 0; k < 1 + laws.size() * options.strains.size(); ++k)
        progress.done();
      return;
    }

    progress.milestone(cell.name + ", " + load.name + ": error bar of the reference");
    const ReferenceUncertainty uncertainty(
      cell, load,
      {laws,
       options.n_cells,
       options.n_cells_of_error_bar,
       options.strains.back(),
       {distinct_methods(options.methods, laws, load), ladder, &fitted},
       &references},
      output ? &output->uncertainty : nullptr, communicator,
      [&](const std::string &what) { progress.begin(cell.name + ", " + load.name + ": " + what); });
    progress.done();

    MethodsOnSheet methods = methods_on_sheet(cell, homogenized, edges, references.sheet, load);
    methods.fitted         = fitted;
    const LoadedSheet of_load{cell,        load,
                              uncertainty, references,
                              methods,     begin_budget(cell, homogenized, references, load)};
    for (std::size_t k = 0; k < laws.size(); ++k)
    {
      const std::vector<double> missing = missing_strains(cell, load, laws[k]);
      for (std::size_t done = missing.size(); done < options.strains.size(); ++done)
        progress.done();
      if (missing.empty())
        continue;
      references.by(1).start(load, laws[k]);
      // Above a level that was not reached none is tried, now or when a study is taken up again.
      bool is_reached = !is_unreached_below(cell, load, laws[k], missing.front());
      for (const double strain : missing)
      {
        progress.milestone(cell.name + ", " + load.name + ": " + name_of(laws[k]) +
                           " reference, strain " + short_text(strain));
        if (is_reached)
          is_reached = study_level(of_load, laws[k], strain);
        else
          on_root(
            communicator,
            [&]() {
              output->write_unreached({cell.name, load.name, laws[k], strain}, references.sheet);
            });
        progress.done();
      }
    }
  }

  /// What the budget of a load asks for beside the study, if any level of it is missing.
  /// @return whether levels can be measured, on every rank
  bool begin_budget(const UnitCell &cell, const meshes::HomogenizedCell &homogenized,
                    SheetReferences &references, const Load &load)
  {
    const auto is_missing = [&](const double strain) {
      return budget->row_is_missing({cell.name, load.name, budget->law_of_budget, strain});
    };
    if (!has_budget(options, load) ||
        !answer_of_root(std::any_of(options.strains.begin(), options.strains.end(), is_missing),
                        communicator))
      return false;
    progress.begin(cell.name + ", " + load.name +
                   ": the sheet by a second code, for the error budget");
    try
    {
      budget->begin_load(cell, homogenized, references, load);
      return true;
    }
    catch (const meshes::NotConverged &failure)
    {
      note({cell.name, load.name, budget->law_of_budget, options.strains.front()},
           "no error budget of this load; ", failure.what());
      return false;
    }
  }

  /// The levels of which a row is missing, told to all ranks.
  std::vector<double> missing_strains(const UnitCell &cell, const Load &load, const Law law) const
  {
    std::vector<char> is_missing(options.strains.size(), 0);
    if (is_root)
      for (std::size_t k = 0; k < options.strains.size(); ++k)
      {
        const StrainLevel level = {cell.name, load.name, law, options.strains[k]};
        is_missing[k]           = !output->is_complete(level) ||
                        (has_budget(options, load) && !output->is_unreached(level) &&
                         !output->has_left(level) && budget->row_is_missing(level));
      }
    MPI_Bcast(is_missing.data(), static_cast<int>(is_missing.size()), MPI_CHAR, 0, communicator);
    std::vector<double> missing;
    for (std::size_t k = 0; k < options.strains.size(); ++k)
      if (is_missing[k])
        missing.push_back(options.strains[k]);
    return missing;
  }

  bool is_unreached_below(const UnitCell &cell, const Load &load, const Law law,
                          const double strain) const
  {
    const auto is_one = [&](const double lower) {
      return lower < strain && output->is_unreached({cell.name, load.name, law, lower});
    };
    return answer_of_root(
      is_root && std::any_of(options.strains.begin(), options.strains.end(), is_one), communicator);
  }

  /// @return whether both found an equilibrium, from which the next level may start
  bool study_level(const LoadedSheet &of, const Law law, const double strain)
  {
    const StrainLevel level    = {of.cell.name, of.load.name, law, strain};
    const meshes::Sheet &sheet = of.references.sheet;
    FineReference &reference   = of.references.by(1);
    ReferenceStep fine         = reference.advance(strain);
    if (!fine.reached)
    {
      const Stability at_the_end = reference.stability_of_last(fine);
      on_root(communicator,
              [&]()
              {
                write_stop(level, {fine, at_the_end, sheet, of.cell},
                           options.n_cells_of_error_bar > 0 ? options.strains
                                                            : std::vector<double>(),
                           *output);
                output->write_unreached(level, sheet);
              });
      return false;
    }
    Stability stability            = Stability::every_triangle;
    const double seconds_stability = seconds_of([&]() { stability = reference.stabilize(fine); });
    const bool has_left            = stability == Stability::left ||
                          answer_of_root(is_root && output->has_left(level), communicator);
    largest_residual = std::max(largest_residual, fine.relative_residual);
    UpsampledLevel solved;
    bool is_solved = false;
    on_root(communicator,
            [&]()
            {
              for (const std::string &note : notes_of(fine, stability))
                output->write_note(level, note);
              try
              {
                ResolvedLevel resolved = {sheet,
                                          fine,
                                          reference.n_dofs(),
                                          n_ranks,
                                          of.uncertainty.at(law, strain),
                                          stability,
                                          seconds_stability,
                                          of.uncertainty.of_errors(law, strain)};
                resolved.forget_bars(has_left);
                solved    = compare_methods(options, level, resolved, of.methods, *output);
                is_solved = true;
              }
              catch (const meshes::NotConverged &failure)
              {
                output->write_note(level, std::string("the coarse cloth found no equilibrium; ") +
                                            failure.what());
                output->write_unreached(level, sheet);
              }
            });
    is_solved = answer_of_root(is_solved, communicator);
    if (is_solved && of.has_budget && !has_left &&
        answer_of_root(budget->row_is_missing(level), communicator))
      note(level, "error budget: ", budget->measure(law, strain, fine.positions, solved));
    return is_solved;
  }

  /// A remark on a level, unless the first rank has none.
  void note(const StrainLevel &level, const std::string &what, const std::string &text)
  {
    on_root(communicator,
            [&]()
            {
              if (!text.empty())
                output->write_note(level, what + text);
            });
  }

  StudyDescription conclude() override
  {
    add(study_verdicts(*output, options));
    output->write_gains();
    std::vector<std::string> notes = notes_on_references(asked, cells());
    const auto add_notes           = [&](const std::vector<std::string> &more)
    { notes.insert(notes.end(), more.begin(), more.end()); };
    for (const UnitCell &cell : cells())
      add_notes(notes_on_yarns(cell, options_of(asked, cell).references));
    add_notes(output->notes());
    if (options.budget)
      add_notes(budget_notes(output->strain.rows(), output->budget->rows()));
    return describe(options, {output->strain.rows(), output->levels.rows(), notes},
                    {peak_memory, largest_residual});
  }

  const StrainStudyOptions asked;
  StrainStudyOptions options; ///< the same, with the references of the present cell, or of all
  const unsigned int n_ranks;
  Progress progress;
  std::unique_ptr<StrainOutput> output;       ///< first rank
  std::unique_ptr<BudgetStudy> budget;        ///< of the present cell; none where it is left out
  KnownEdges edges;                           ///< of the present cell
  std::function<const CellLadder &()> ladder; ///< the same
  std::map<Law, meshes::FittedModes> fitted;  ///< the same, by law; first rank
  double largest_residual = 0., peak_memory = 0.;
};
} // namespace

std::vector<Verdict> run_strain_study(const StrainStudyOptions &options,
                                      const MPI_Comm communicator)
{
  return StrainStudy(options, communicator).run();
}
} // namespace homespun::verification
