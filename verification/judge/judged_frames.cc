// SPDX-License-Identifier: MIT
#include "verification/judge/judged_frames.h"

#include "meshes/files/hdf5_reader.h"
#include "meshes/plain/errors.h"
#include "verification/drape/drape_tables.h"
#include "verification/drape/kept_frames.h"
#include "verification/record/error_norms.h"
#include "verification/record/number_text.h"
#include "verification/record/table.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace homespun::verification
{
using meshes::BadInput;

namespace
{
/// Triangles of the kept cloth.
meshes::Triangles kept_triangles(const std::string &folder)
{
  const meshes::Hdf5Reader file(folder + "/cloth.h5", "the meshes of a `drape --keep`");
  const auto shape              = file.shape_of("/triangles", {meshes::Hdf5Reader::any, 3});
  const std::vector<int> values = file.integers("/triangles", shape);
  return Eigen::Map<const meshes::Triangles>(values.data(), static_cast<Eigen::Index>(shape[0]), 3);
}

/// Each frame in a line: the error, its bar, and the rank among the methods, each on its cloth.
void tell(const JudgedRun &given, const std::vector<DrapeRow> &rows,
          const std::vector<DrapeRow> &judged)
{
  for (const DrapeRow &row : judged)
  {
    int n = 0, n_closer = 0;
    for (const DrapeRow &other : rows)
      if (other.reference == row.reference && other.frame == row.frame &&
          (other.variant == row.variant || other.variant == other.method) &&
          std::isfinite(other.mean))
      {
        ++n;
        n_closer += other.mean < row.mean;
      }
    const double unit = 1e3 * row.mean_per_cell / row.mean,
                 bar  = unit * (row.uncertainty + row.time_step);
    std::cout << row.reference << ", frame " << row.frame << ": "
              << (std::isfinite(bar) ? with_bar(unit * row.mean, bar) : short_text(unit * row.mean))
              << " thousandths of a cell side; " << n_closer << " of " << n
              << " methods of homespun are closer\n";
  }
  for (const std::string &note : given.notes)
    std::cout << note << "\n";
}
} // namespace

void judge_frames(JudgedRun &given)
{
  const JudgeOptions &options        = given.options;
  const std::vector<DrapeRow> rows   = read_table<DrapeRow>(options.run + "/" + DrapeRow::file);
  const nlohmann::ordered_json study = read_json(options.run + "/drape.json");
  if (rows.empty() || study["cells"].size() != 1)
    throw BadInput(options.run +
                   ": has no reference, or several cells; expected a run with --references, --keep "
                   "and one cell, which --unit-cells chooses");
  const std::string cell = rows.front().cell, main = study["cells"][0]["runs"][0]["variant"],
                    folder          = folder_of_positions(options.run, cell);
  const meshes::Triangles triangles = kept_triangles(folder);
  const double side                 = study["cells"][0]["cell_side_m"];
  const auto n_vertices             = study["fine_vertices"].get<int>();
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
      const PositionRows reference =
        kept_reference(folder, file_name_of(known.reference, known.frame), n_vertices, 3);
      const ErrorNorms norms =
        error_norms(given.distance(file, {triangles, side}, reference, known.displacement));
      DrapeRow row             = known; // and with it the bars, which are the reference's
      row.method               = options.method;
      row.mean                 = norms.mean;
      row.rms                  = norms.rms;
      row.max                  = norms.max;
      row.mean_per_cell        = norms.mean / side;
      row.mean_per_fluctuation = norms.mean * (known.mean_per_fluctuation / known.mean);
      return row;
    });
  std::vector<DrapeRow> all = rows;
  all.insert(all.end(), judged.begin(), judged.end());
  given.write("drape.json", {}, [&]() { Table<DrapeRow>(options.output).replace(all); });
  if (!options.quiet)
    tell(given, rows, judged);
}
} // namespace homespun::verification
