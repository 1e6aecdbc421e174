// SPDX-License-Identifier: MIT
// The one shape of a study of cells: it reads them, keeps one folder of one run, and says in
// study.json and verdicts.json what ran. A study fills in what it refuses, what its results depend
// on, its tables, its notes and its claims.
#pragma once

#include "verification/cell/assessed_cells.h"
#include "verification/cell/study_options.h"
#include "verification/record/claim.h"
#include "verification/record/json_files.h"
#include "verification/record/run_folder.h"
#include "verification/record/verdict.h"

#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace homespun::verification
{
/// What a study says of itself, beside its command, ranks, seconds and provenance.
struct StudyDescription
{
  nlohmann::ordered_json told;     ///< what it was told, by name
  nlohmann::ordered_json left_out; ///< a list of {what, why}
  std::vector<std::string> notes;  ///< what a reader has to know
  std::string file = "study.json"; ///< in which it is said
};

/// @throws BadInput with the faults of all cells that cannot be tiled to a sheet, by their files
void refuse_cells_without_sheets(const std::vector<homogenization::UnitCell> &cells);

/// The claims that are owed of every cell that is homogenized.
std::vector<OwedClaim> owed_of_cells(const std::vector<homogenization::UnitCell> &cells);

class StudyOfCells
{
public:
  virtual ~StudyOfCells()                       = default;
  StudyOfCells(const StudyOfCells &)            = delete;
  StudyOfCells &operator=(const StudyOfCells &) = delete;

  /// The study from its beginning to its end. All ranks must call this.
  /// @return the verdicts; where one of the first rank did not pass, every rank has such a one
  /// @throws BadInput, NotConverged, on all ranks; BadInput as RunFolder does
  std::vector<Verdict> run();

protected:
  /// Reads the cells, on all ranks.
  /// @param name of the command
  /// @throws BadInput of a file, and where two cells share a name
  StudyOfCells(std::string name, StudyOptions options, MPI_Comm communicator);

  /// Throws BadInput of what the study cannot take, before any file is touched. All ranks.
  virtual void refuse() const
  {
  }

  /// What the results depend on, beside the cells. First rank.
  virtual nlohmann::ordered_json inputs() = 0;

  /// The claims that its inputs ask for. First rank, before anything is solved.
  virtual std::vector<OwedClaim> owed() const
  {
    return {};
  }

  /// Opens the tables, in a folder that holds this run alone. First rank.
  virtual void open_tables() = 0;

  /// Fills the tables and adds verdicts. All ranks.
  virtual void work() = 0;

  /// Adds the verdicts of the tables, and describes what ran. First rank.
  virtual StudyDescription conclude() = 0;

  const std::vector<homogenization::UnitCell> &cells() const
  {
    return all_cells;
  }

  /// Inputs with what the cells are made of, by name.
  nlohmann::ordered_json with_cells(nlohmann::ordered_json inputs) const;

  /// A cell by P1, with its brackets: that of another study of this run or of an earlier process of
  /// this study where there is one, see AssessedCells. All ranks must call this.
  /// @param checks those of the cell are added
  /// @throws BadInput, NotConverged
  const AssessedCell &homogenize(const homogenization::UnitCell &cell, const CellNeeds &needs,
                                 std::vector<Verdict> &checks) const;

  /// All cells so, in their order; their checks are verdicts. All ranks must call this.
  std::vector<AssessedCell> homogenize_all();

  void add(const std::vector<Verdict> &more)
  {
    verdicts.insert(verdicts.end(), more.begin(), more.end());
  }

  /// The folder of a cell, made, with the files of write_cell_results(). First rank.
  std::string write_cell(const homogenization::UnitCell &cell, const AssessedCell &assessed) const;

  const MPI_Comm communicator;
  const bool is_root;
  bool is_taken_up = false; ///< whether the folder held this run already; first rank
  std::vector<Verdict> verdicts;

private:
  void write(StudyDescription description);

  const std::string name;
  const StudyOptions given;
  const std::shared_ptr<AssessedCells> homogenized;
  const std::chrono::steady_clock::time_point begin;
  std::vector<homogenization::UnitCell> all_cells;
  std::unique_ptr<RunFolder> folder;  ///< first rank
  std::vector<OwedClaim> owed_claims; ///< first rank
};
} // namespace homespun::verification
