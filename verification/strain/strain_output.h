// SPDX-License-Identifier: MIT
// What a strain study leaves on the disk as it goes on: the tables strain.csv (errors), forces.csv,
// levels.csv (times, ellipticity, remarks), uncertainty.csv, budget.csv, cross-checks.csv and
// runtime.csv, and at its end gains.csv and validity.csv. First rank alone.
#pragma once

#include "meshes/plain/sheet.h"
#include "verification/law/laws.h"
#include "verification/strain/budget/budget_tables.h"
#include "verification/strain/reference_uncertainty.h"
#include "verification/strain/strain_options.h"
#include "verification/strain/strain_tables.h"

#include <Eigen/Core>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace homespun::verification
{
/// What rows are named after.
struct StrainLevel
{
  std::string cell, load;
  Law law;
  double strain;
};

/// The row of a level but for its numbers.
LevelRow row_of(const StrainLevel &level);

/// The row of a method at a level, without errors.
StrainRow row_of(const StrainLevel &level, const std::string &method, const meshes::Sheet &sheet);

/// The norms of an error in a row that has the keys and sizes of the level.
void set_errors(StrainRow &row, const Eigen::VectorXd &distance, const meshes::Sheet &sheet,
                double fluctuation);

/// Tables in a folder. Rows that are there already are not written again.
class StrainOutput
{
public:
  /// Takes up the tables that the options ask for, or begins them.
  /// @throws BadInput where a table is damaged
  /// @param tell receives each note as it is written
  StrainOutput(const StrainStudyOptions &options, std::function<void(const std::string &)> tell);

  /// Whether a level has a row of every method that has a meaning for its law, or is known to have
  /// no equilibrium.
  bool is_complete(const StrainLevel &level) const;

  bool has_errors(const StrainLevel &level, const std::string &method) const;

  bool is_unreached(const StrainLevel &level) const;

  /// Whether the reference was left for another equilibrium, at a level or below it: bars, P2 and
  /// the second code stay on the branch that was left.
  bool has_left(const StrainLevel &level) const;

  /// @param step with the keys of its level; what is known of it stays
  void write_step(LevelRow step);

  /// A level without equilibrium.
  void write_unreached(const StrainLevel &level, const meshes::Sheet &sheet);

  /// A remark on a level, for the report and the terminal.
  void write_note(const StrainLevel &level, std::string text);

  /// gains.csv and validity.csv, from all rows of strain.csv and levels.csv.
  void write_gains() const;

  /// Every note of the study, those of earlier runs too. Ready sentences.
  std::vector<std::string> notes() const;

  Table<StrainRow> strain;
  Table<LevelRow> levels;
  Table<ForceRow> forces;
  Table<UncertaintyRow> uncertainty;
  std::unique_ptr<Table<BudgetRow>> budget;     ///< none where it is left out
  std::unique_ptr<Table<CrossCheckRow>> checks; ///< with the budget
  std::unique_ptr<Table<RunTimeRow>> run_time;  ///< none where it is left out
  /// From which on D^H holds, of each cell of which it is known, for validity.csv [m].
  std::map<std::string, double> least_radius_of_cell;

private:
  const std::string folder;
  const std::vector<std::string> methods;
  const std::function<void(const std::string &)> tell;
};
} // namespace homespun::verification
