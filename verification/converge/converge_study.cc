// SPDX-License-Identifier: MIT
#include "verification/converge/converge_study.h"

#include "homogenization/fem/homogenize.h"
#include "meshes/plain/errors.h"
#include "verification/bend/plate_sheet.h"
#include "verification/cell/study_of_cells.h"
#include "verification/converge/converge_cases.h"
#include "verification/ellipticity/default_law.h"
#include "verification/record/on_root.h"
#include "verification/record/progress.h"
#include "verification/record/provenance.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <memory>
#include <tuple>

namespace homespun::verification
{
using homogenization::UnitCell;

ConvergenceSizes convergence_sizes(const bool quick)
{
  ConvergenceSizes sizes;
  sizes.refinements_p1  = quick ? std::vector<int>{0, 1, 2, 3} : std::vector<int>{0, 1, 2, 3, 4, 5};
  sizes.refinements_p2  = quick ? std::vector<int>{0, 1, 2, 3} : std::vector<int>{0, 1, 2, 3, 4};
  sizes.adaptive_dofs   = quick ? 60000 : 400000;
  sizes.cells_per_sheet = quick ? std::vector<int>{2, 4, 8, 16} : std::vector<int>{2, 4, 8, 16, 32};
  sizes.cells_of_edges  = quick ? std::vector<int>{4, 6, 10, 16} : std::vector<int>{5, 10, 20, 40};
  sizes.cells_of_bending = quick ? std::vector<int>{3, 4, 6, 8} : std::vector<int>{4, 6, 8, 12};
  sizes.cells_of_coarse_study = quick ? 4 : 16;
  sizes.coarse_per_cell       = {0.5, 1., 2., 4., 8.};
  if (!quick)
    sizes.coarse_per_cell.push_back(16.);
  // At 1e-4 the rounding of F = 1 + grad u is 1e-12 of the strain, and Newton's method stalls above
  // its tolerance.
  sizes.strains    = quick ? std::vector<double>{0.1, 0.03, 0.01, 0.003, 0.001}
                           : std::vector<double>{0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};
  sizes.time_steps = quick ? std::vector<int>{50, 100, 200, 400}
                           : std::vector<int>{25, 50, 100, 200, 400, 800, 1600};
  return sizes;
}

namespace
{
bool has(const ConvergenceStudyOptions &options, const std::string &study)
{
  return std::find(options.studies.begin(), options.studies.end(), study) != options.studies.end();
}

nlohmann::ordered_json what_was_left_out(const ConvergenceStudyOptions &options,
                                         const std::vector<ConvergeRow> &levels)
{
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  const auto left_out         = [&](const std::string &what, const std::string &why) {
    list.push_back({{"what", what}, {"why", why}});
  };
  for (const std::string &study : convergence_studies())
    if (!has(options, study))
      left_out("study " + study, "--studies does not name it");
  if (options.is_quick)
    left_out("finer levels", "--quick");
  // Series of meshes whose number the DoFs decide, by cell, order and kind of mesh.
  std::map<std::tuple<std::string, unsigned int, bool>, std::size_t> n_meshes;
  for (const ConvergeRow &row : levels)
    if (row.study == "adaptive")
      ++n_meshes[{row.cell, *row.order_p,
                  !row.judgement && row.quantity.rfind("adaptive", 0) == 0}];
  for (const auto &[key, n] : n_meshes)
    if (std::get<2>(key) && n < fewest_uneven_levels)
      left_out(std::get<0>(key) + ", adaptive, P" + std::to_string(std::get<1>(key)) +
                 ": order of the width",
               std::to_string(n) + " meshes have no more than " +
                 std::to_string(convergence_sizes(options.is_quick).adaptive_dofs) +
                 " DoFs; a fit needs " + std::to_string(fewest_uneven_levels));
  return list;
}

/// What a reader has to know of the studies that ran.
std::vector<std::string> notes(const ConvergenceStudyOptions &options)
{
  std::vector<std::string> list = {
    "An order is judged on the three finest levels of at least four. PASS: it lies within the "
    "limits and has settled (the last two differ by no more than 0.1). FAIL: the last one lies "
    "below the limits and does not rise, or it has settled above. Everything else is INCONCLUSIVE.",
    "Where the exact value is not known, errors are distances from the Richardson limit of the "
    "last three levels, and the error bar is the grid convergence index with the safety factor "
    "1.25."};
  const auto add = [&](const std::string &study, const std::string &note)
  {
    if (has(options, study))
      list.push_back(study + ": " + note);
  };
  add("mesh", "h is the square root of the mean area of a triangle over the cell side. Where "
              "phases meet in corners the order is at least twice the exponent of the strongest "
              "one and at most twice the smallest exponent above 1 (with P1 at most 2), all "
              "computed from angles and stiffnesses: finer meshes come nearer to the first. C^H "
              "falls from level to level. An error bar is given only where the order has settled.");
  add("adaptive", "h is one over the square root of the DoFs of the displacements. Adaptive meshes "
                  "do not grow evenly: the order is fitted to the last five levels and to the "
                  "last three, and both must lie within the limit.");
  return list;
}

/// Of each cell, the law of the study over strains.
std::vector<std::string> notes_on_laws(const ConvergenceStudyOptions &options,
                                       const std::vector<UnitCell> &cells)
{
  std::vector<std::string> all;
  if (has(options, "strain"))
    for (const UnitCell &cell : cells)
      all.push_back("strain: " + note_on_default_law(cell));
  return all;
}

class ConvergenceStudy final : public StudyOfCells
{
public:
  ConvergenceStudy(const ConvergenceStudyOptions &options, const MPI_Comm communicator)
      : StudyOfCells("converge", options, communicator)
      , options(options)
      , sizes(convergence_sizes(options.is_quick))
  {
  }

private:
  void refuse() const override
  {
    refuse_cells_without_sheets(cells());
  }

  nlohmann::ordered_json inputs() override
  {
    nlohmann::ordered_json inputs;
    inputs["quick"]                 = options.is_quick;
    inputs["studies"]               = options.studies;
    inputs["refinements_p1"]        = sizes.refinements_p1;
    inputs["refinements_p2"]        = sizes.refinements_p2;
    inputs["adaptive_dofs"]         = sizes.adaptive_dofs;
    inputs["cells_per_sheet"]       = sizes.cells_per_sheet;
    inputs["cells_of_edges"]        = sizes.cells_of_edges;
    inputs["cells_of_bending"]      = sizes.cells_of_bending;
    inputs["cells_of_coarse_study"] = sizes.cells_of_coarse_study;
    inputs["coarse_per_cell"]       = sizes.coarse_per_cell;
    inputs["strains"]               = sizes.strains;
    inputs["time_steps"]            = sizes.time_steps;
    for (const UnitCell &cell : cells())
      inputs["laws"][cell.name] = name_of(default_law(cell));
    return inputs;
  }

  /// Where the levels of a case end early, that is a claim of its own.
  std::vector<OwedClaim> owed() const override
  {
    std::vector<OwedClaim> owed;
    const auto add = [&](const std::string &study, const std::vector<std::string> &cases,
                         const std::vector<const char *> &ids)
    {
      if (has(options, study))
        for (const UnitCell &cell : cells())
          for (const std::string &one : cases)
            for (const char *id : ids)
              owed.push_back(
                {id, {{"cell", cell.name}, {"study", study}, {"case", one}}, {"all-levels"}});
    };
    const std::vector<std::string> sheets = Load::names_of(LoadKind::sheet);
    add("mesh", {"uniform refinement"}, {"nested-levels", "mesh-changes"});
    add("scale", sheets, {"sheet-order", "closer-on-the-largest-sheet"});
    add("coarse", sheets, {"coarse-energy-falls", "coarse-order"});
    add("edges", sheets, {"edge-order"});
    add("edges", {"closed along axis 1"}, {"edge-order"});
    std::vector<std::string> bent;
    for (const BendingLoad &load : bending_loads)
      bent.push_back(load.name);
    add("bending", bent, {"bending-order", "closer-when-bent"});
    add("strain", Load::names_of(LoadKind::periodic), {"method-order"});
    add("time", {"linearly implicit Euler", "implicit Euler"}, {"time-order"});
    add("time", {"damped fall"}, {"damped-fall"});
    return owed;
  }

  void open_tables() override
  {
    record = std::make_unique<ConvergenceRecord>(options.output);
  }

  void work() override
  {
    collect();
    run_cases();
  }

  /// Cases stand study by study, so that the finest levels of one cell do not delay the others.
  void collect()
  {
    for (const UnitCell &cell : cells())
    {
      CellNeeds needs;
      if (!is_of_yarns(default_law(cell)))
        needs.second_order = {Law::biot}; // whose methods are of third order in strain
      std::vector<Verdict> checks;        // a study of orders claims nothing of C^H itself
      homogenized.push_back(
        homogenized_cell(cell, homogenize(cell, needs, checks), provenance_line()));
    }
    const auto add = [&](const std::string &name, const auto &cases_of)
    {
      if (has(options, name))
        for (std::size_t k = 0; k < cells().size(); ++k)
          for (ConvergenceCase &one : cases_of(cells()[k], homogenized[k]))
            cases.push_back(std::move(one));
    };
    add("mesh",
        [&](const UnitCell &cell, const auto &) { return mesh_cases(cell, sizes, communicator); });
    add("adaptive", [&](const UnitCell &cell, const auto &)
        { return adaptive_cases(cell, sizes, communicator); });
    add("scale", [&](const UnitCell &cell, const auto &h)
        { return scale_cases(cell, h, sizes, communicator); });
    add("coarse", [&](const UnitCell &cell, const auto &h)
        { return coarse_cases(cell, h, sizes, communicator); });
    add("edges", [&](const UnitCell &cell, const auto &h)
        { return edge_cases(cell, h, sizes, communicator); });
    add("bending", [&](const UnitCell &cell, const auto &) { return bending_cases(cell, sizes); });
    add("strain", [&](const UnitCell &cell, const auto &h)
        { return strain_cases(cell, h, sizes, communicator); });
    add("time", [&](const UnitCell &cell, const auto &h) { return time_cases(cell, h, sizes); });
  }

  void run_cases()
  {
    Progress progress(is_root && !options.quiet, static_cast<int>(cases.size()));
    std::string group;
    for (const ConvergenceCase &one : cases)
    {
      const std::string here = one.cell + ", " + one.study;
      if (here == group)
        progress.begin(here + ": " + one.name);
      else
        progress.milestone(here + ": " + one.name);
      group        = here;
      int is_there = is_root && record->is_complete(one);
      MPI_Bcast(&is_there, 1, MPI_INT, 0, communicator);
      if (!is_there)
        run_case(one, progress);
      progress.done();
    }
  }

  /// Solvers are deterministic and agree on all ranks: where one does not converge, none does.
  void run_case(const ConvergenceCase &one, Progress &progress)
  {
    const auto start = std::chrono::steady_clock::now();
    ConvergenceResult result;
    result.solves([&]() { result = one.run(); });
    if (!result.unfinished.empty())
    {
      result.verdicts.push_back(judged("all-levels", {{"why", result.unfinished}},
                                       result.outcome_of_unfinished,
                                       std::numeric_limits<double>::quiet_NaN()));
      unfinished.push_back(one.cell + ", " + one.study + ", " + one.name + ": " +
                           result.unfinished);
      progress.note(unfinished.back());
    }
    const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    on_root(communicator, [&]() { record->add(one, result, seconds); });
  }

  StudyDescription conclude() override
  {
    verdicts                           = record->verdicts();
    std::vector<std::string> all_notes = notes(options);
    for (const std::string &note : notes_on_laws(options, cells()))
      all_notes.push_back(note);
    all_notes.insert(all_notes.end(), unfinished.begin(), unfinished.end());
    return {{{"studies", options.studies}, {"quick", options.is_quick}},
            what_was_left_out(options, record->levels()),
            all_notes};
  }

  const ConvergenceStudyOptions options;
  const ConvergenceSizes sizes;
  std::vector<meshes::HomogenizedCell> homogenized;
  std::vector<ConvergenceCase> cases;
  std::vector<std::string> unfinished;       ///< cases whose ladder ended early, and why
  std::unique_ptr<ConvergenceRecord> record; ///< on the first rank alone
};
} // namespace

std::vector<Verdict> run_convergence_study(const ConvergenceStudyOptions &options,
                                           const MPI_Comm communicator)
{
  return ConvergenceStudy(options, communicator).run();
}
} // namespace homespun::verification
