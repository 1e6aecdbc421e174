// SPDX-License-Identifier: MIT
#include "verification/strain/strain_output.h"

#include "verification/method/method.h"
#include "verification/record/error_norms.h"
#include "verification/record/number_text.h"
#include "verification/reference/fine_reference.h"
#include "verification/strain/budget/budget_tables.h"
#include "verification/strain/gains.h"
#include "verification/strain/validity.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace homespun::verification
{
namespace
{
std::vector<std::string> remarks_of(const LevelRow &row)
{
  std::vector<std::string> remarks;
  const std::string separator = LevelRow::separator;
  for (std::size_t begin = 0, end = 0; begin < row.note.size(); begin = end + separator.size())
  {
    end = std::min(row.note.find(separator, begin), row.note.size());
    remarks.push_back(row.note.substr(begin, end - begin));
  }
  return remarks;
}

template <typename Row>
std::unique_ptr<Table<Row>> table_if(const bool is_wanted, const std::string &folder)
{
  return is_wanted ? std::make_unique<Table<Row>>(folder) : nullptr;
}
} // namespace

LevelRow row_of(const StrainLevel &level)
{
  return {level.cell, level.load, name_of(level.law), level.strain};
}

StrainRow row_of(const StrainLevel &level, const std::string &method, const meshes::Sheet &sheet)
{
  return {level.cell,
          level.load,
          level.strain,
          name_of(level.law),
          method,
          sheet.n1,
          2 * sheet.n1 * sheet.n2,
          sheet.mesh.n_triangles()};
}

void set_errors(StrainRow &row, const Eigen::VectorXd &distance, const meshes::Sheet &sheet,
                const double fluctuation)
{
  const ErrorNorms norms = error_norms(distance);
  row.mean               = norms.mean;
  row.rms                = norms.rms;
  row.max                = norms.max;
  row.per_cell           = row.mean / std::sqrt(sheet.lattice.area());
  if (fluctuation > 0.)
    row.per_fluctuation = row.mean / fluctuation;
  if (!Load(row.load).is_periodic())
    std::tie(row.interior, row.edge) = apart_from_edges(distance, sheet);
}

StrainOutput::StrainOutput(const StrainStudyOptions &options,
                           std::function<void(const std::string &)> tell)
    : strain(options.output)
    , levels(options.output)
    , forces(options.output)
    , uncertainty(options.output)
    , budget(table_if<BudgetRow>(options.budget, options.output))
    , checks(table_if<CrossCheckRow>(options.budget, options.output))
    , run_time(table_if<RunTimeRow>(options.run_time, options.output))
    , folder(options.output)
    , methods(options.methods)
    , tell(std::move(tell))
{
}

bool StrainOutput::is_complete(const StrainLevel &level) const
{
  const std::vector<std::string> distinct = distinct_methods(methods, level.law, Load(level.load));
  return is_unreached(level) ||
         std::all_of(distinct.begin(), distinct.end(),
                     [&](const std::string &method) { return has_errors(level, method); });
}

bool StrainOutput::has_errors(const StrainLevel &level, const std::string &method) const
{
  return strain.contains({level.cell, level.load, level.strain, name_of(level.law), method});
}

bool StrainOutput::is_unreached(const StrainLevel &level) const
{
  return has_errors(level, unreached);
}

bool StrainOutput::has_left(const StrainLevel &level) const
{
  const std::string left = name_of(Stability::left), reference = name_of(level.law);
  return std::any_of(levels.rows().begin(), levels.rows().end(),
                     [&](const LevelRow &row)
                     {
                       return row.cell == level.cell && row.load == level.load &&
                              row.reference == reference && row.strain <= level.strain &&
                              row.stability == left;
                     });
}

void StrainOutput::write_step(LevelRow step)
{
  const LevelRow known = levels.known(step);
  if (levels.contains(step) && known.is_solved())
    return;
  step.note = known.note;
  levels.put(step);
}

void StrainOutput::write_unreached(const StrainLevel &level, const meshes::Sheet &sheet)
{
  strain.append(row_of(level, unreached, sheet));
}

void StrainOutput::write_note(const StrainLevel &level, std::string text)
{
  text                                  = text.substr(0, text.find("; residual norms"));
  LevelRow row                          = levels.known(row_of(level));
  const std::vector<std::string> before = remarks_of(row);
  if (std::find(before.begin(), before.end(), text) == before.end())
  {
    row.note += (before.empty() ? "" : LevelRow::separator) + text;
    levels.put(row);
  }
  tell(row.cell + ", " + row.load + ", " + row.reference + " reference at strain " +
       short_text(row.strain) + ": " + text);
}

void StrainOutput::write_gains() const
{
  Table<GainRow>(folder).replace(gain_rows(strain.rows()));
  Table<ValidityRow>(folder).replace(
    validity_rows(strain.rows(), levels.rows(), least_radius_of_cell));
}

std::vector<std::string> StrainOutput::notes() const
{
  std::vector<std::string> sentences;
  for (const LevelRow &row : levels.rows())
    for (const std::string &remark : remarks_of(row))
      sentences.push_back(row.cell + ", " + row.load + ", " + row.reference + " at strain " +
                          short_text(row.strain) + ": " + remark);
  return sentences;
}
} // namespace homespun::verification
