// SPDX-License-Identifier: MIT
#include "verification/strain/judge/judge_study.h"

#include "meshes/files/cell_file.h"
#include "meshes/plain/errors.h"
#include "verification/law/laws.h"
#include "verification/record/checksum.h"
#include "verification/record/json_files.h"
#include "verification/record/number_text.h"
#include "verification/record/on_root.h"
#include "verification/record/run_folder.h"
#include "verification/strain/gains.h"
#include "verification/strain/judge/given_files.h"
#include "verification/strain/judge/given_positions.h"
#include "verification/strain/kept_positions.h"
#include "verification/strain/validity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <set>

namespace homespun::verification
{
namespace fs = std::filesystem;
using meshes::BadInput;
using nlohmann::ordered_json;

namespace
{
class Judge
{
public:
  explicit Judge(const JudgeOptions &options)
      : options(options)
      , run(finished_run(options.run))
      , files(files_by_level(options.files))
  {
    if (run.value("command", "") != "strain" || run["inputs"].contains("judged"))
      throw BadInput(options.run + ": is a run of `homespun " + run.value("command", "") +
                     "`, or was judged; expected one of `homespun strain --keep`");
    rows   = read_table<StrainRow>(options.run + "/" + StrainRow::file);
    levels = read_table<LevelRow>(options.run + "/" + LevelRow::file);
    for (const StrainRow &row : rows)
      if (row.method == options.method)
        throw BadInput("--name: " + row.method + " is a method of the study; choose another");
      else if (row.cell != rows.front().cell)
        throw BadInput(options.run + ": is of several cells; expected a run of one");
    cell = meshes::read_cell(options.run + "/" + rows.front().cell + "/cell.h5");
  }

  std::vector<Verdict> judge()
  {
    judge_levels();
    std::vector<Verdict> verdicts;
    std::set<std::pair<std::string, std::string>> done;
    for (const StrainRow &row : judged)
      if (done.emplace(row.load, row.reference).second)
        for (const Verdict &verdict : verdicts_of_own_method(
               all_rows(), row, elliptic_up_to(levels, row.cell, row.load, row.reference)))
          verdicts.push_back(verdict);
    write(verdicts);
    return verdicts;
  }

private:
  std::vector<StrainRow> all_rows() const
  {
    std::vector<StrainRow> all = rows;
    all.insert(all.end(), judged.begin(), judged.end());
    return all;
  }

  void judge_levels()
  {
    std::vector<std::string> faults;
    std::set<std::string> known;
    for (const StrainRow &row : rows)
    {
      const StrainLevel level = {row.cell, row.load, law_of(row.reference), row.strain};
      const auto file         = files.find(file_name_of(level));
      if (file == files.end() || !row.is_reached() || !known.insert(file->first).second)
        continue;
      try
      {
        judged.push_back(row_of(level, row, file->second));
      }
      catch (const BadInput &bad)
      {
        faults.push_back(bad.what());
      }
    }
    for (const auto &[name, its] : files)
      if (known.count(name) == 0)
        faults.push_back(its.path + ": is of no level that " + options.run +
                         " has; expected a name like that of its files in " + rows.front().cell +
                         "/positions/, as in " +
                         file_name_of({rows.front().cell, rows.front().load,
                                       law_of(rows.front().reference), rows.front().strain}) +
                         ".npy");
    if (!faults.empty())
      throw BadInput(faults);
  }

  const meshes::Sheet &sheet_of(const StrainRow &row)
  {
    std::optional<meshes::Sheet> &sheet = Load(row.load).is_periodic() ? repeated : full;
    if (!sheet)
    {
      const ordered_json one = {1, 1};
      const auto n           = Load(row.load).is_periodic()
                                 ? run["inputs"].value("supercell", one).get<std::array<int, 2>>()
                                 : std::array<int, 2>{row.cells, row.cells};
      sheet                  = meshes::tile(cell.mesh, cell.lattice, n[0], n[1]);
    }
    return *sheet;
  }

  /// @param known a row of another method at the level
  StrainRow row_of(const StrainLevel &level, const StrainRow &known, const GivenFile &file)
  {
    const meshes::Sheet &sheet     = sheet_of(known);
    const meshes::Points reference = kept_reference(options.run, level, sheet.mesh.n_vertices());
    GivenPositions given           = read_positions(file.path, sheet.mesh);
    if (Load(level.load).is_periodic()) // which the reference leaves in place where chi is zero
    {
      int held = 0;
      while (sheet.cell_vertex(held) != cell.anchor)
        ++held;
      const Eigen::RowVector2d translation = given.points.row(held) - reference.row(held);
      given.points.rowwise() -= translation;
    }
    const Eigen::VectorXd distance = (given.points - reference).rowwise().norm();
    refuse_misread(file.path, distance, sheet, reference);
    const auto itself = std::find_if(levels.begin(), levels.end(),
                                     [&](const LevelRow &one)
                                     {
                                       return one.is_solved() && one.load == known.load &&
                                              one.reference == known.reference &&
                                              one.strain == known.strain;
                                     });
    StrainRow row     = known;
    row.method        = options.method;
    set_errors(row, distance, sheet,
               itself == levels.end() ? StrainRow::none : itself->fluctuation);
    // Another program's method is not refined with the reference: its error is known as well as
    // that is.
    row.bar        = row.uncertainty;
    row.bar_safety = StrainRow::none;
    // As of homespun's methods: the equilibrium of the coarse cloth and up-sampling.
    row.seconds = (std::isnan(file.seconds) ? options.seconds : file.seconds) +
                  (itself == levels.end() ? StrainRow::none : itself->seconds_coarse);
    if (given.resolution > 0.01 * row.mean)
      notes.push_back(file.path + ": its numbers tell " + short_text(given.resolution) +
                      " m apart; errors of this size, as the " + short_text(row.mean) +
                      " m found here, are of the file and not of the method");
    return row;
  }

  /// A method that is farther off than cloth that does not move at all has mostly another unit,
  /// order or sheet.
  static void refuse_misread(const std::string &file, const Eigen::VectorXd &distance,
                             const meshes::Sheet &sheet, const meshes::Points &reference)
  {
    const double side  = std::sqrt(sheet.lattice.area());
    const double moved = (reference - sheet.mesh.vertices).rowwise().norm().mean();
    if (distance.mean() > std::max(2. * moved, 0.5 * side))
      throw BadInput(file + ": its positions are " + short_text(distance.mean()) +
                     " m from the reference in the mean, where the cloth at rest is " +
                     short_text(moved) +
                     " m from it; expected positions in metres, in the order of "
                     "/rest");
  }

  void write(const std::vector<Verdict> &verdicts) const
  {
    RunDescription description = {"strain", run["inputs"]};
    ordered_json of_files      = ordered_json::object();
    for (const auto &[name, its] : files)
      of_files[name] = checksum_of_file(its.path);
    description.inputs["judged"] = {
      {"method", options.method}, {"run", run["fingerprint"]}, {"positions", of_files}};
    const auto folder =
      open_run_folder(options.output, description, options.earlier, options.quiet);
    for (const auto &[name, listed] : run["files"].items())
      if (fs::path(name).parent_path().filename() != "positions" && name != "report.html" &&
          name.rfind("figures/", 0) != 0)
      {
        fs::create_directories((fs::path(options.output) / name).parent_path());
        fs::copy_file(fs::path(options.run) / name, fs::path(options.output) / name,
                      fs::copy_options::overwrite_existing);
      }
    Table<StrainRow>(options.output).replace(all_rows());
    ordered_json claims      = read_json(options.output + "/verdicts.json");
    const ordered_json added = to_json(verdicts, options.command)["verdicts"];
    claims["verdicts"].insert(claims["verdicts"].end(), added.begin(), added.end());
    write_json(options.output + "/verdicts.json", claims);
    ordered_json study = read_json(options.output + "/study.json");
    study["judged"]    = options.method;
    study["command"]   = study["command"].get<std::string>() + " && " + options.command;
    study["notes"].push_back(
      "`" + options.method + "` is no method of this program: its positions were given, and held " +
      "against the references of the run " + run["fingerprint"].get<std::string>() +
      "; the bar of its error is that of the reference");
    for (const std::string &note : notes)
      study["notes"].push_back(note);
    write_json(options.output + "/study.json", study);
    folder->finish();
    if (!options.quiet)
      tell();
  }

  /// Each level in a line: the error, its bar, and the rank among the methods.
  void tell() const
  {
    for (const StrainRow &row : judged)
    {
      int n = 0, n_closer = 0;
      for (const StrainRow &other : rows)
        if (other.load == row.load && other.reference == row.reference &&
            other.strain == row.strain && std::isfinite(other.mean))
        {
          ++n;
          n_closer += other.mean < row.mean;
        }
      const double unit = 1e3 / (row.strain * row.mean / row.per_cell);
      std::cout << row.load << ", " << row.reference << ", " << percent_text(row.strain) << ": "
                << with_bar(unit * row.mean, unit * row.bar)
                << " thousandths of strain x cell side; " << n_closer << " of " << n
                << " methods of homespun are closer\n";
    }
    for (const std::string &note : notes)
      std::cout << note << "\n";
  }

  const JudgeOptions &options;
  const ordered_json run;
  const std::map<std::string, GivenFile> files;
  std::vector<StrainRow> rows, judged;
  std::vector<LevelRow> levels;
  std::vector<std::string> notes;
  meshes::HomogenizedCell cell;
  std::optional<meshes::Sheet> repeated, full; ///< made where a level asks for it
};
} // namespace

std::vector<Verdict> judge(const JudgeOptions &options, const MPI_Comm communicator)
{
  return is_root(communicator) ? Judge(options).judge() : std::vector<Verdict>();
}
} // namespace homespun::verification
