// SPDX-License-Identifier: MIT
#include "verification/cell/study_of_cells.h"

#include "homogenization/cell/corners.h"
#include "homogenization/lint/cell_reading.h"
#include "verification/cell/cell_files.h"
#include "verification/cell/study_inputs.h"
#include "verification/record/json_files.h"
#include "verification/record/on_root.h"
#include "verification/record/provenance.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace homespun::verification
{
using homogenization::UnitCell;

double factor_of_bars(const UnitCell &cell)
{
  const homogenization::Singularity corners = homogenization::singularity_of(
    homogenization::corners_of(cell.mesh, cell.lattice, cell.stiffness_of_phase()));
  const double order = 2. * std::min(1., corners.exists ? corners.strongest : 1.);
  return 1.25 / (1. - std::pow(2., -order));
}

StudyOfCells::StudyOfCells(StudyOptions given_options, const MPI_Comm communicator)
    : options(std::move(given_options))
    , homogenized(options.homogenized ? options.homogenized : std::make_shared<AssessedCells>())
    , communicator(communicator)
    , begin(std::chrono::steady_clock::now())
{
  for (const std::string &file : options.cell_files)
    all_cells.push_back(homogenization::read_unit_cell(file, communicator));
  check_names(all_cells);
}

nlohmann::ordered_json StudyOfCells::with_cells(nlohmann::ordered_json inputs) const
{
  for (const UnitCell &cell : all_cells)
    inputs["cell " + cell.name] = fingerprint(cell);
  return inputs;
}

bool StudyOfCells::open(const std::string &name, nlohmann::ordered_json inputs)
{
  folder = open_run_folder(options.output, {name, with_cells(std::move(inputs))}, options.earlier,
                           options.quiet);
  return folder->is_taken_up();
}

const AssessedCell &StudyOfCells::homogenize(const UnitCell &cell, const CellNeeds &needs,
                                             std::vector<Verdict> &verdicts) const
{
  if (answer_of_root(folder && folder->is_taken_up(), communicator))
    homogenized->read(cell, options.output + "/" + cell.name, communicator);
  return homogenized->of(cell, needs, communicator, verdicts);
}

std::string StudyOfCells::write_cell(const UnitCell &cell, const AssessedCell &assessed) const
{
  const std::string folder_of_cell = options.output + "/" + cell.name;
  write_cell_results(cell, assessed, {}, n_ranks_of(communicator), folder_of_cell);
  return folder_of_cell;
}

void StudyOfCells::conclude(StudyDescription description, const std::vector<Verdict> &verdicts)
{
  const unsigned int n_ranks = n_ranks_of(communicator);
  for (const std::string &note : notes_on_cuts(all_cells))
    description.notes.push_back(note);
  nlohmann::ordered_json study = {{"command", options.command}};
  if (!description.told.is_null())
    study.update(description.told);
  study["ranks"] = n_ranks;
  study["seconds_total"] =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  study["resumed"]    = description.is_resumed;
  study["left_out"]   = description.left_out;
  study["notes"]      = description.notes;
  study["provenance"] = provenance(n_ranks);
  write_json(options.output + "/verdicts.json", to_json(verdicts, options.command));
  write_json(options.output + "/" + description.file, study);
  folder->finish();
}
} // namespace homespun::verification
