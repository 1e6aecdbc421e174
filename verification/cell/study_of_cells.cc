// SPDX-License-Identifier: MIT
#include "verification/cell/study_of_cells.h"

#include "homogenization/lint/cell_reading.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/sheet.h"
#include "verification/cell/cell_files.h"
#include "verification/cell/study_inputs.h"
#include "verification/record/json_files.h"
#include "verification/record/on_root.h"
#include "verification/record/provenance.h"

#include <iostream>
#include <utility>

namespace homespun::verification
{
using homogenization::UnitCell;

void refuse_cells_without_sheets(const std::vector<UnitCell> &cells)
{
  std::vector<std::string> faults;
  for (const UnitCell &cell : cells)
    try
    {
      meshes::tile(cell.mesh, cell.lattice, 1, 1);
    }
    catch (const meshes::BadInput &bad)
    {
      for (const std::string &fault : bad.faults())
        faults.push_back(cell.file + ": " + fault);
    }
  if (!faults.empty())
    throw meshes::BadInput(faults);
}

std::vector<OwedClaim> owed_of_cells(const std::vector<UnitCell> &cells)
{
  std::vector<OwedClaim> owed;
  for (const UnitCell &cell : cells)
    for (const char *id : {"hill-mandel", "below-voigt", "above-reuss", "checks-find-a-millionth",
                           "measures-see-a-millionth"})
      owed.push_back({id, {{"cell", cell.name}}});
  return owed;
}

StudyOfCells::StudyOfCells(std::string name_of_command, StudyOptions options,
                           const MPI_Comm communicator)
    : communicator(communicator)
    , is_root(verification::is_root(communicator))
    , name(std::move(name_of_command))
    , given(std::move(options))
    , homogenized(given.homogenized ? given.homogenized : std::make_shared<AssessedCells>())
    , begin(std::chrono::steady_clock::now())
{
  for (const std::string &file : given.cell_files)
    all_cells.push_back(
      homogenization::read_unit_cell(file, communicator, is_root ? &std::cerr : nullptr));
  check_names(all_cells);
}

std::vector<Verdict> StudyOfCells::run()
{
  refuse();
  on_root(communicator,
          [&]()
          {
            folder      = open_run_folder(given.output, {name, with_cells(inputs())}, given.earlier,
                                          given.quiet);
            is_taken_up = folder->is_taken_up();
            open_tables();
            owed_claims = owed();
          });
  work();
  on_root(communicator,
          [&]()
          {
            StudyDescription description = conclude();
            add(missing_claims(owed_claims, verdicts));
            write(std::move(description));
          });
  if (is_mpi_running())
    share_failure(verdicts, communicator);
  return verdicts;
}

nlohmann::ordered_json StudyOfCells::with_cells(nlohmann::ordered_json inputs) const
{
  for (const UnitCell &cell : all_cells)
    inputs["cell " + cell.name] = fingerprint(cell);
  return inputs;
}

const AssessedCell &StudyOfCells::homogenize(const UnitCell &cell, const CellNeeds &needs,
                                             std::vector<Verdict> &checks) const
{
  if (answer_of_root(is_taken_up, communicator))
    homogenized->read(cell, given.output + "/" + cell.name, communicator);
  return homogenized->of(cell, needs, communicator, checks);
}

std::vector<AssessedCell> StudyOfCells::homogenize_all()
{
  std::vector<AssessedCell> all;
  for (const UnitCell &cell : all_cells)
    all.push_back(homogenize(cell, {}, verdicts));
  return all;
}

std::string StudyOfCells::write_cell(const UnitCell &cell, const AssessedCell &assessed) const
{
  const std::string folder_of_cell = given.output + "/" + cell.name;
  write_cell_results(cell, assessed, {}, n_ranks_of(communicator), folder_of_cell);
  return folder_of_cell;
}

void StudyOfCells::write(StudyDescription description)
{
  const unsigned int n_ranks = n_ranks_of(communicator);
  for (const std::string &note : notes_on_cells(all_cells))
    description.notes.push_back(note);
  nlohmann::ordered_json study = {{"command", given.command}};
  if (!description.told.is_null())
    study.update(description.told);
  study["ranks"] = n_ranks;
  study["seconds_total"] =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  study["resumed"]              = is_taken_up;
  study["left_out"]             = description.left_out;
  study["notes"]                = description.notes;
  study["provenance"]           = provenance(n_ranks);
  nlohmann::ordered_json claims = to_json(verdicts, given.command);
  claims["owed"]                = nlohmann::ordered_json::array();
  for (const OwedClaim &one : owed_claims)
    claims["owed"].push_back({{"id", one.id}, {"of", one.of}});
  write_json(given.output + "/verdicts.json", claims);
  write_json(given.output + "/" + description.file, study);
  folder->finish();
  folder.reset(); // and with it the lock
}
} // namespace homespun::verification
