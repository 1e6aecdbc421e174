// SPDX-License-Identifier: MIT
#include "verification/verify/verify_study.h"

#include "homogenization/lint/cell_reading.h"
#include "meshes/plain/errors.h"
#include "verification/bend/bend_study.h"
#include "verification/cell/assessed_cells.h"
#include "verification/cell/study_inputs.h"
#include "verification/cell/study_of_cells.h"
#include "verification/command/data_folder.h"
#include "verification/converge/converge_cases.h"
#include "verification/converge/converge_study.h"
#include "verification/drape/drape_study.h"
#include "verification/homogenize/homogenize_study.h"
#include "verification/periodic/periodic_study.h"
#include "verification/record/claim.h"
#include "verification/record/json_files.h"
#include "verification/record/on_root.h"
#include "verification/record/run_folder.h"
#include "verification/strain/strain_study.h"
#include "verification/stress/stress_study.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace homespun::verification
{
namespace
{
class Verifier
{
public:
  Verifier(const VerifyOptions &options, const MPI_Comm communicator)
      : options(options)
      , parts(options.parts.empty() ? default_parts(options.cell_files) : options.parts)
      , communicator(communicator)
  {
  }

  Verification run()
  {
    read_cells();
    on_root(communicator,
            [&]()
            {
              folder = open_run_folder(options.output, {"verify", inputs()}, options.earlier,
                                       options.quiet);
            });
    for (const std::string &part : verify_parts())
      if (std::find(parts.begin(), parts.end(), part) != parts.end())
        run_part(part);
    on_root(communicator,
            [&]()
            {
              write_json(options.output + "/verdicts.json",
                         to_json(result.verdicts, options.command));
              folder->finish();
            });
    result.status = worse(result.status, status_of(result.verdicts));
    return result;
  }

private:
  nlohmann::ordered_json inputs() const
  {
    nlohmann::ordered_json all = {{"parts", parts}, {"quick", options.is_quick}};
    for (const homogenization::UnitCell &cell : cells)
      all["cell " + cell.name] = fingerprint(cell);
    return all;
  }

  /// All that a study refuses of a cell is asked before anything runs: hours of work must not end
  /// at the last one's fault.
  void read_cells()
  {
    std::vector<std::string> faults;
    for (const std::string &file : options.cell_files)
      try
      {
        cells.push_back(homogenization::read_unit_cell(file, communicator));
        refuse_cells_without_sheets({cells.back()});
      }
      catch (const meshes::BadInput &bad)
      {
        faults.insert(faults.end(), bad.faults().begin(), bad.faults().end());
      }
    if (!faults.empty())
      throw meshes::BadInput(faults);
    check_names(cells);
  }

  void run_part(const std::string &part)
  {
    if (part == "homogenize")
      for (const homogenization::UnitCell &cell : cells)
        attempt(part, "cells/" + cell.name,
                [&](const std::string &folder) { return homogenize(cell, folder); });
    else if (part == "strain")
      attempt(part, part, [&](const std::string &folder) { return strain(folder); });
    else if (part == "bend")
      attempt(part, part, [&](const std::string &folder) { return bend(folder); });
    else if (part == "load")
      attempt(part, part, [&](const std::string &folder) { return load(folder); });
    else if (part == "stability")
      attempt(part, part, [&](const std::string &folder) { return stability(folder); });
    else if (part == "converge")
      attempt(part, part, [&](const std::string &folder) { return converge(folder); });
    else if (part == "stress")
      attempt(part, part, [&](const std::string &folder) { return stress(folder); });
    else
      for (const std::string scene : {"hang", "pull"})
        attempt(part, scene, [&](const std::string &folder) { return drape(scene, folder); });
  }

  template <typename Study>
  void attempt(const std::string &part, const std::string &name, const Study &study)
  {
    const std::string folder = options.output + "/" + name;
    const std::string title  = name == part ? part : part + " " + name;
    if (is_root(communicator) && !options.quiet)
      std::fprintf(stderr, "homespun verify: %s\n", title.c_str());
    on_root(communicator, [&]() { std::filesystem::create_directories(folder); });
    try
    {
      for (Verdict verdict : study(folder))
      {
        verdict.claim = title + ": " + verdict.claim;
        result.verdicts.push_back(verdict);
      }
      result.folders.push_back(folder);
    }
    catch (const meshes::NotConverged &failure)
    {
      result.verdicts.push_back(
        judged("part-ends", {{"part", title}, {"why", failure.what()}}, Outcome::fail, 0.));
      result.status = exit_status::not_converged;
    }
  }

  std::vector<Verdict> homogenize(const homogenization::UnitCell &cell, const std::string &folder)
  {
    CellStudyOptions study;
    study.output                = folder;
    study.earlier               = Earlier::keep_work;
    study.quiet                 = options.quiet;
    const AssessedCell assessed = run_cell_study(cell, study, communicator);
    if (assessed.bending)
      homogenized->take_bending(cell, *assessed.bending);
    return assessed.checks;
  }

  template <typename Options, typename Run>
  std::vector<Verdict> of_cells(Options study, const Run &run, const std::string &folder) const
  {
    study.cell_files  = options.cell_files;
    study.output      = folder;
    study.command     = options.command;
    study.earlier     = Earlier::keep_work; // the whole has been taken up, or begun anew
    study.quiet       = options.quiet;
    study.homogenized = homogenized;
    return run(study, communicator);
  }

  std::vector<Verdict> strain(const std::string &folder) const
  {
    StrainStudyOptions study = default_strain_study();
    if (options.is_quick)
      make_quick(study);
    return of_cells(study, run_strain_study, folder);
  }

  std::vector<Verdict> bend(const std::string &folder) const
  {
    BendStudyOptions study;
    if (options.is_quick)
      make_quick(study);
    return of_cells(study, run_bend_study, folder);
  }

  /// Pulled along axis 1, sides free.
  std::vector<Verdict> load(const std::string &folder) const
  {
    LoadStudyOptions study;
    study.control = load_control({}, {"11=5%"}, 0);
    if (options.is_quick)
      study.n_steps = 5;
    return of_cells(study, run_load_study, folder);
  }

  /// Pressed along both axes, sides free.
  std::vector<Verdict> stability(const std::string &folder) const
  {
    StabilityStudyOptions study;
    if (options.is_quick)
    {
      study.strains       = {-0.05};
      study.n_refinements = 0;
    }
    return of_cells(study, run_stability_study, folder);
  }

  std::vector<Verdict> converge(const std::string &folder) const
  {
    ConvergenceStudyOptions study;
    study.studies  = convergence_studies();
    study.is_quick = options.is_quick;
    return of_cells(study, run_convergence_study, folder);
  }

  std::vector<Verdict> stress(const std::string &folder) const
  {
    StressStudyOptions study;
    if (options.is_quick)
      make_quick(study);
    return of_cells(study, run_stress_study, folder);
  }

  std::vector<Verdict> drape(const std::string &scene, const std::string &folder) const
  {
    DrapeOptions study;
    study.scene_file = cells_folder() + "/../scenes/" + scene + ".prm";
    study.methods    = {"affine", "localized"};
    study.references = {"biot"};
    // The reference takes seconds per step at the paper's size, and minutes to hours over all
    // steps.
    if (options.is_quick)
    {
      make_quick(study);
      study.duration = 0.2;
    }
    else
    {
      study.n_cells              = 8;
      study.n_cells_of_error_bar = 4;
    }
    return of_cells(study, run_drape_study, folder);
  }

  const VerifyOptions options;
  const std::vector<std::string> parts;
  const MPI_Comm communicator;
  std::vector<homogenization::UnitCell> cells;
  const std::shared_ptr<AssessedCells> homogenized = std::make_shared<AssessedCells>();
  std::unique_ptr<RunFolder> folder; ///< first rank
  Verification result;
};
} // namespace

Verification verify(const VerifyOptions &options, const MPI_Comm communicator)
{
  return Verifier(options, communicator).run();
}
} // namespace homespun::verification
