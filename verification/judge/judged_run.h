// SPDX-License-Identifier: MIT
// What judging has in common for studies of all kinds: the run and the files, what is refused, and
// the folder of the result, which holds the study with the method as one more.
#pragma once

#include "meshes/plain/errors.h"
#include "meshes/plain/triangle_mesh.h"
#include "verification/judge/given_files.h"
#include "verification/judge/judge_options.h"
#include "verification/record/json_files.h"
#include "verification/record/kept_positions.h"
#include "verification/record/verdict.h"

#include <Eigen/Core>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace homespun::verification
{
/// [m]; a bar that is not known is not a number.
struct ErrorWithBar
{
  double error, bar;
};

struct UnitOfError
{
  double length; ///< [m]
  const char *text;
};

class JudgedRun
{
public:
  /// @throws BadInput where the run is not whole or was judged, or the files cannot be
  explicit JudgedRun(const JudgeOptions &options);

  /// Judges every file that a row of the study asks for.
  /// @param name_of what the files of a row are called
  /// @param judge the row of the method, from a row of another method at the same place
  /// @throws BadInput with a message per file that cannot be judged
  template <typename Row>
  std::vector<Row> judge_all(const std::vector<Row> &rows,
                             const std::function<std::string(const Row &)> &name_of,
                             const std::function<Row(const Row &, const GivenFile &)> &judge);

  /// The distance of each vertex from the reference (n) [m].
  /// @param mesh of the reference, where the cloth was at first
  /// @param side of a cell [m]
  /// @param align moves what was given where only positions up to a translation count
  /// @throws BadInput where the positions are not of the mesh, or more than twice as far
  ///   off as cloth that does not move at all, in a scene also half of a cell's side, which mostly
  ///   means another unit, order or sheet
  Eigen::VectorXd distance(const GivenFile &file, const KeptMesh &mesh, double side,
                           const PositionRows &reference,
                           const std::function<void(PositionRows &)> &align = {});

  /// A line of the terminal: an error, its bar, and how many methods of homespun are closer, and
  /// by more than both bars.
  /// @param where level or frame
  /// @param others of those methods; an error that is not a number does not count
  void tell(const std::string &where, const ErrorWithBar &own, const UnitOfError &unit,
            const std::vector<ErrorWithBar> &others) const;
  void tell_notes() const;

  /// Writes the folder of the result.
  /// @param description the study's file of its description
  /// @param write_table puts the rows of the method into the table
  void write(const std::string &description, const std::vector<Verdict> &verdicts,
             const std::function<void()> &write_table) const;

  const JudgeOptions &options;
  const nlohmann::ordered_json run;
  const std::map<std::string, GivenFile> files;
  std::vector<std::string> notes;

private:
  /// @param known names of files that rows ask for
  void refuse_unknown(const std::vector<std::string> &known, std::vector<std::string> faults) const;
};

template <typename Row>
std::vector<Row>
JudgedRun::judge_all(const std::vector<Row> &rows,
                     const std::function<std::string(const Row &)> &name_of,
                     const std::function<Row(const Row &, const GivenFile &)> &judge)
{
  std::vector<Row> judged;
  std::vector<std::string> known, faults;
  for (const Row &row : rows)
  {
    const std::string name = name_of(row);
    if (std::find(known.begin(), known.end(), name) != known.end())
      continue;
    known.push_back(name);
    if (const auto file = files.find(name); file != files.end())
      try
      {
        judged.push_back(judge(row, file->second));
      }
      catch (const meshes::BadInput &bad)
      {
        faults.push_back(file->second.row + bad.what());
      }
  }
  refuse_unknown(known, std::move(faults));
  return judged;
}
} // namespace homespun::verification
