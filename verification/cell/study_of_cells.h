// SPDX-License-Identifier: MIT
// The frame of a study of cells: it reads them, keeps one folder of one run, and says in study.json
// and verdicts.json what ran. What is left to a study is its tables, its notes and its claims.
#pragma once

#include "verification/cell/assessed_cells.h"
#include "verification/cell/study_options.h"
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
  bool is_resumed  = false;
  std::string file = "study.json"; ///< in which it is said
};

/// 1.25 / (1 - 2^-q), q twice the exponent of the strongest corner and at most 2, the order of the
/// energy of P1: by it the distance from the once refined mesh is the error of the given one, with
/// a margin (grid convergence index).
double factor_of_bars(const homogenization::UnitCell &cell);

class StudyOfCells
{
public:
  /// Reads the cells, on all ranks.
  /// @throws BadInput of a file, and where two cells share a name
  StudyOfCells(StudyOptions options, MPI_Comm communicator);

  const std::vector<homogenization::UnitCell> &cells() const
  {
    return all_cells;
  }

  /// Inputs with what the cells are made of, by name.
  nlohmann::ordered_json with_cells(nlohmann::ordered_json inputs) const;

  /// Takes the folder for a run of these inputs and cells. First rank.
  /// @param name of the command
  /// @return whether the folder held this run already
  /// @throws BadInput as RunFolder does
  bool open(const std::string &name, nlohmann::ordered_json inputs);

  /// A cell by P1, with its brackets: that of another study of this run or of an earlier process of
  /// this study where there is one, see AssessedCells. All ranks must call this.
  /// @param verdicts its checks are added
  /// @throws BadInput, NotConverged
  const AssessedCell &homogenize(const homogenization::UnitCell &cell, const CellNeeds &needs,
                                 std::vector<Verdict> &verdicts) const;

  /// The folder of a cell, made, with the files of write_cell_results(). First rank.
  std::string write_cell(const homogenization::UnitCell &cell, const AssessedCell &assessed) const;

  /// Writes the description and verdicts.json, adds how cells were cut to the notes, and ends the
  /// run. First rank.
  void conclude(StudyDescription description, const std::vector<Verdict> &verdicts);

private:
  const StudyOptions options;
  const std::shared_ptr<AssessedCells> homogenized;
  const MPI_Comm communicator;
  const std::chrono::steady_clock::time_point begin;
  std::vector<homogenization::UnitCell> all_cells;
  std::unique_ptr<RunFolder> folder; ///< first rank
};
} // namespace homespun::verification
