// SPDX-License-Identifier: MIT
#include "verification/judge/judged_frames.h"

#include "meshes/plain/errors.h"
#include "verification/drape/drape_tables.h"
#include "verification/drape/drape_verdicts.h"
#include "verification/drape/kept_frames.h"
#include "verification/record/error_norms.h"
#include "verification/record/table.h"

#include <cmath>
#include <set>

namespace homespun::verification
{
using meshes::BadInput;

namespace
{
/// Each frame in a line: the error, its bar, and the rank among the methods, each on its cloth.
void tell(const JudgedRun &given, const std::vector<DrapeRow> &rows,
          const std::vector<DrapeRow> &judged, const double side)
{
  for (const DrapeRow &row : judged)
  {
    std::vector<ErrorWithBar> others;
    for (const DrapeRow &other : rows)
      if (other.reference == row.reference && other.frame == row.frame &&
          (other.variant == row.variant || other.variant == other.method))
        others.push_back({other.mean, other.uncertainty + other.time_step});
    given.tell(row.reference + ", frame " + std::to_string(row.frame),
               {row.mean, row.uncertainty + row.time_step},
               {1e-3 * side, "thousandths of a cell side"}, others);
  }
  given.tell_notes();
}

void refuse_seconds(const JudgedRun &given)
{
  std::vector<std::string> faults;
  if (given.options.seconds)
    faults.emplace_back("--seconds: is of a level of `homespun strain`; a run of `homespun drape` "
                        "has no table of run times: leave it out");
  for (const auto &[name, file] : given.files)
    if (std::isfinite(file.seconds))
      faults.push_back(file.row + "column seconds: has a run time, of which a run of `homespun "
                                  "drape` has no table; leave it empty");
  if (!faults.empty())
    throw BadInput(faults);
}
} // namespace

std::vector<Verdict> judge_frames(JudgedRun &given)
{
  const JudgeOptions &options        = given.options;
  const std::vector<DrapeRow> rows   = read_table<DrapeRow>(options.run + "/" + DrapeRow::file);
  const nlohmann::ordered_json study = read_json(options.run + "/drape.json");
  if (rows.empty() || study["cells"].size() != 1)
    throw BadInput(options.run +
                   ": has no reference, or several cells; expected a run with --references, --keep "
                   "and one cell, which --unit-cells chooses");
  refuse_seconds(given);
  const std::string cell = rows.front().cell, main = study["cells"][0]["runs"][0]["variant"],
                    folder = folder_of_positions(options.run, cell);
  const KeptMesh mesh      = kept_mesh(folder + "/cloth.h5", "/start");
  const double side        = study["cells"][0]["cell_side_m"];
  std::vector<DrapeRow> others; // of homespun's methods on the coarse cloth that was kept
  for (const DrapeRow &row : rows)
    if (row.method == options.method)
      throw BadInput("--name: " + row.method + " is a method of the study; choose another");
    else if (row.variant == main)
      others.push_back(row);
  const std::vector<DrapeRow> judged = given.judge_all<DrapeRow>(
    others, [](const DrapeRow &row) { return file_name_of(row.reference, row.frame); },
    [&](const DrapeRow &known, const GivenFile &file)
    {
      const std::string name       = file_name_of(known.reference, known.frame);
      const PositionRows reference = kept_reference(folder, name, mesh);
      const ErrorNorms norms       = error_norms(given.distance(file, mesh, side, reference));
      DrapeRow row                 = known; // and with it the bar by mesh, which is the reference's
      row.method                   = options.method;
      row.mean                     = norms.mean;
      row.rms                      = norms.rms;
      row.max                      = norms.max;
      row.mean_per_cell            = norms.mean / side;
      row.mean_per_fluctuation     = norms.mean * (known.mean_per_fluctuation / known.mean);
      // Methods of the study share with the reference what the step changes in the coarse cloth.
      row.time_step += kept_coarse_step(folder, name);
      return row;
    });
  std::vector<DrapeRow> all = rows;
  all.insert(all.end(), judged.begin(), judged.end());
  std::set<std::string> references;
  for (const DrapeRow &row : judged)
    if (row.frame > 0)
      references.insert(row.reference);
  std::vector<Verdict> verdicts;
  for (const std::string &reference : references)
    for (const char *other : {"affine", "localized"})
      verdicts.push_back(verdict_of_closer(all, {cell, main, reference}, options.method, other));
  given.write("drape.json", verdicts, [&]() { Table<DrapeRow>(options.output).replace(all); });
  if (!options.quiet)
    tell(given, rows, judged, side);
  return verdicts;
}
} // namespace homespun::verification
