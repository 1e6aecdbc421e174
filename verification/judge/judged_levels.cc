// SPDX-License-Identifier: MIT
#include "verification/judge/judged_levels.h"

#include "meshes/files/cell_file.h"
#include "meshes/plain/errors.h"
#include "verification/law/laws.h"
#include "verification/record/number_text.h"
#include "verification/strain/gains.h"
#include "verification/strain/kept_positions.h"
#include "verification/strain/validity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

namespace homespun::verification
{
using meshes::BadInput;
using nlohmann::ordered_json;

namespace
{
StrainLevel level_of(const StrainRow &row)
{
  return {row.cell, row.load, law_of(row.reference), row.strain};
}

class JudgedLevels
{
public:
  explicit JudgedLevels(JudgedRun &given)
      : given(given)
      , options(given.options)
      , rows(read_table<StrainRow>(options.run + "/" + StrainRow::file))
      , levels(read_table<LevelRow>(options.run + "/" + LevelRow::file))
  {
    for (const StrainRow &row : rows)
      if (row.method == options.method)
        throw BadInput("--name: " + row.method + " is a method of the study; choose another");
      else if (row.cell != rows.front().cell)
        throw BadInput(options.run + ": is of several cells; expected a run of one");
    cell = meshes::read_cell(options.run + "/" + rows.front().cell + "/cell.h5");
  }

  std::vector<Verdict> judge()
  {
    std::vector<StrainRow> reached;
    for (const StrainRow &row : rows)
      if (row.is_reached())
        reached.push_back(row);
    judged = given.judge_all<StrainRow>(
      reached, [](const StrainRow &row) { return file_name_of(level_of(row)); },
      [&](const StrainRow &row, const GivenFile &file) { return row_of(row, file); });
    std::vector<StrainRow> all = rows;
    all.insert(all.end(), judged.begin(), judged.end());
    std::vector<Verdict> verdicts;
    std::set<std::pair<std::string, std::string>> done;
    for (const StrainRow &row : judged)
      if (done.emplace(row.load, row.reference).second)
        for (const Verdict &verdict : verdicts_of_own_method(
               all, row, elliptic_up_to(levels, row.cell, row.load, row.reference)))
          verdicts.push_back(verdict);
    given.write("study.json", verdicts, [&]() { Table<StrainRow>(options.output).replace(all); });
    if (!options.quiet)
      tell();
    return verdicts;
  }

private:
  /// The cells of a level, and the mesh of it that was kept, which must be the same.
  struct Kept
  {
    meshes::Sheet sheet;
    KeptMesh mesh;
  };

  const Kept &kept_of(const StrainRow &row)
  {
    const bool is_periodic    = Load(row.load).is_periodic();
    std::optional<Kept> &kept = is_periodic ? repeated : full;
    if (!kept)
    {
      std::array<int, 2> n = {row.cells, row.cells};
      if (is_periodic)
        n = given.run["inputs"].value("supercell", ordered_json({1, 1})).get<std::array<int, 2>>();
      const std::string file =
        folder_of_positions(options.run, row.cell) + (is_periodic ? "/periodic.h5" : "/sheet.h5");
      kept = {meshes::tile(cell.mesh, cell.lattice, n[0], n[1]), kept_mesh(file, "/rest")};
      const meshes::TriangleMesh &made = kept->sheet.mesh;
      // Numbers of a sheet differ by round-off where another build made it.
      if (made.vertices.rows() != kept->mesh.vertices.rows() ||
          made.triangles != kept->mesh.triangles ||
          (made.vertices - kept->mesh.vertices).cwiseAbs().maxCoeff() > 1e-9 * side())
        throw BadInput(file + ": is not the mesh that this version makes of cell.h5; run the study "
                              "again, with --keep --overwrite");
    }
    return *kept;
  }

  double side() const
  {
    return std::sqrt(cell.lattice.area());
  }

  /// @param known a row of another method at the level
  StrainRow row_of(const StrainRow &known, const GivenFile &file)
  {
    const Kept &kept             = kept_of(known);
    const meshes::Sheet &sheet   = kept.sheet;
    const PositionRows reference = kept_reference(folder_of_positions(options.run, known.cell),
                                                  file_name_of(level_of(known)), kept.mesh);
    // Of infinite cloth positions count up to a translation; the reference leaves in place where
    // chi is zero.
    const auto align = [&](PositionRows &positions)
    {
      if (!Load(known.load).is_periodic())
        return;
      Eigen::Index held = 0; // at the lattice point where the cell is anchored
      (sheet.mesh.vertices.rowwise() - sheet.origin).rowwise().squaredNorm().minCoeff(&held);
      const Eigen::RowVectorXd translation = positions.row(held) - reference.row(held);
      positions.rowwise() -= translation;
    };
    const Eigen::VectorXd distance = given.distance(file, kept.mesh, side(), reference, align);
    const auto itself              = std::find_if(levels.begin(), levels.end(),
                                                  [&](const LevelRow &one)
                                                  {
                                       return one.is_solved() && one.load == known.load &&
                                              one.reference == known.reference &&
                                              one.strain == known.strain;
                                     });
    StrainRow row                  = known;
    row.method                     = options.method;
    set_errors(row, distance, sheet,
               itself == levels.end() ? StrainRow::none : itself->fluctuation);
    // Another program's method is not refined with the reference: its error is known as well as
    // that is.
    row.bar        = row.uncertainty;
    row.bar_safety = StrainRow::none;
    // As of homespun's methods: the equilibrium of the coarse cloth and up-sampling.
    row.seconds =
      (std::isnan(file.seconds) ? options.seconds.value_or(StrainRow::none) : file.seconds) +
      (itself == levels.end() ? StrainRow::none : itself->seconds_coarse);
    return row;
  }

  /// Each level in a line: the error, its bar, and the rank among the methods.
  void tell() const
  {
    for (const StrainRow &row : judged)
    {
      std::vector<ErrorWithBar> others;
      for (const StrainRow &other : rows)
        if (other.load == row.load && other.reference == row.reference &&
            other.strain == row.strain)
          others.push_back({other.mean, other.bar});
      given.tell(row.load + ", " + row.reference + ", " + percent_text(row.strain),
                 {row.mean, row.bar},
                 {1e-3 * row.strain * side(), "thousandths of strain x cell side"}, others);
    }
    given.tell_notes();
  }

  JudgedRun &given;
  const JudgeOptions &options;
  const std::vector<StrainRow> rows;
  const std::vector<LevelRow> levels;
  std::vector<StrainRow> judged;
  meshes::HomogenizedCell cell;
  std::optional<Kept> repeated, full; ///< made where a level asks for it
};
} // namespace

std::vector<Verdict> judge_levels(JudgedRun &given)
{
  return JudgedLevels(given).judge();
}
} // namespace homespun::verification
