// SPDX-License-Identifier: MIT
#include "verification/periodic/periodic_study.h"

#include "meshes/plain/errors.h"
#include "verification/cell/algebraic_limit.h"
#include "verification/cell/discretization_distance.h"
#include "verification/cell/energy_order.h"
#include "verification/cell/study_inputs.h"
#include "verification/cell/study_of_cells.h"
#include "verification/ellipticity/default_law.h"
#include "verification/ellipticity/yarn_cells.h"
#include "verification/periodic/margin_path.h"
#include "verification/periodic/measured_curve.h"
#include "verification/periodic/periodic_cloth.h"
#include "verification/periodic/periodic_verdicts.h"
#include "verification/record/checksum.h"
#include "verification/record/on_root.h"
#include "verification/record/progress.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <memory>
#include <set>

namespace homespun::verification
{
namespace
{
using homogenization::UnitCell;

/// What both forms share: every cell under each of its laws, on the first rank.
class PeriodicStudy : public StudyOfCells
{
protected:
  PeriodicStudy(const std::string &name, const PeriodicStudyOptions &options,
                const MPI_Comm communicator)
      : StudyOfCells(name, options, communicator)
      , told(options)
  {
  }

  virtual std::vector<std::string> laws_of(const UnitCell &cell) const
  {
    return laws_for(cell, told.laws);
  }

  virtual std::size_t n_paths() const = 0;

  /// The claims at rest, and all paths of a cell. First rank.
  virtual void solve(const UnitCell &cell, const AssessedCell &assessed, Progress &progress) = 0;

  nlohmann::ordered_json with_laws(nlohmann::ordered_json inputs) const
  {
    for (const UnitCell &cell : cells())
      inputs["law of " + cell.name] = laws_of(cell);
    return inputs;
  }

  /// @param notes before those on default laws
  StudyDescription description(nlohmann::ordered_json of_form, std::vector<std::string> notes) const
  {
    std::set<std::string> laws;
    for (const UnitCell &cell : cells())
    {
      for (const std::string &law : laws_of(cell))
        laws.insert(law);
      if (told.laws.empty())
        notes.push_back(note_on_default_law(cell));
    }
    of_form["laws"] = laws;
    return {of_form,
            {{{"what", "mass, damping, third dimension, contact"},
              {"why", "an infinite cloth in its plane, in equilibrium: a cloth that is free to "
                      "leave its plane wrinkles sooner wherever it is pressed"}},
             {{"what", "edges and clamps"},
              {"why", "an infinite cloth has none; `homespun strain` has"}}},
            notes};
  }

private:
  void refuse() const override
  {
    check_yarns(cells(), "--references", told.laws);
  }

  void work() override
  {
    const std::vector<AssessedCell> assessed = homogenize_all();
    on_root(communicator,
            [&]()
            {
              Progress progress(!told.quiet, static_cast<int>(n_paths()));
              for (std::size_t k = 0; k < cells().size(); ++k)
              {
                write_cell(cells()[k], assessed[k]);
                solve(cells()[k], assessed[k], progress);
              }
            });
  }

  const PeriodicStudyOptions told;
};

/// The rows of a path; bars where the finer mesh reached the level too.
std::vector<LoadRow> rows_of(const LoadPath &path, const LoadPath &finer, const LoadRow &of_path,
                             const LoadControl &control, const double factor)
{
  std::vector<LoadRow> rows(path.levels.size(), of_path);
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    const LoadLevel &level = path.levels[k];
    LoadRow &row           = rows[k];
    row.step               = static_cast<int>(k) + 1;
    row.factor             = level.factor;
    row.energy             = level.energy;
    row.stable             = level.is_stable;
    for (std::size_t c = 0; c < 3; ++c)
    {
      const auto entry = static_cast<long>(c);
      // What is prescribed stands there as it was prescribed, free of the rounding of F and P.
      const bool is_stress    = control.is_stress[c];
      const double value      = level.factor * control.value(entry);
      row.*strains_of_row[c]  = is_stress ? level.strain(entry) : value;
      row.*stresses_of_row[c] = is_stress ? value : level.stress(entry);
      if (k >= finer.levels.size())
        continue;
      const auto bar = [&](const Eigen::Vector3d &here, const Eigen::Vector3d &there)
      { return factor * std::abs(here(entry) - there(entry)); };
      row.*strain_bars_of_row[c] = is_stress ? bar(level.strain, finer.levels[k].strain) : 0.;
      row.*stress_bars_of_row[c] = is_stress ? 0. : bar(level.stress, finer.levels[k].stress);
    }
  }
  return rows;
}

class LoadStudy final : public PeriodicStudy
{
public:
  LoadStudy(const LoadStudyOptions &options, const MPI_Comm communicator)
      : PeriodicStudy("load", options, communicator)
      , options(options)
  {
  }

private:
  nlohmann::ordered_json inputs() override
  {
    std::set<std::string> names;
    for (const std::string &file : options.measured)
      for (const LoadRow &row : read_measured_curve(file))
      {
        if (row.step == 1 && !names.insert(row.cell).second)
          throw meshes::BadInput(file + ": another measured curve is called `" + row.cell +
                                 "` too; expected files of different names: rename one");
        measured.push_back(row);
      }
    nlohmann::ordered_json all = {{"control", options.control.text()},
                                  {"axis", options.control.axis},
                                  {"steps", options.n_steps}};
    for (int k = 0; k < 3; ++k) // the text has six digits
      all["value " + std::to_string(k + 1)] = options.control.value(k);
    std::string points;
    for (const LoadRow &row : measured)
      for (const std::string &field : fields_of_row(row))
        points += field + ",";
    all["measured"] = checksum_of_text(points);
    return with_laws(all);
  }

  std::vector<OwedClaim> owed() const override
  {
    std::vector<OwedClaim> owed = owed_of_cells(cells());
    for (const UnitCell &cell : cells())
      add_owed_of_paths(cell.name, laws_of(cell), owed);
    return owed;
  }

  void open_tables() override
  {
    table = std::make_unique<Table<LoadRow>>(options.output);
    table->replace(measured); // paths are short, and solved whole
  }

  /// Linear first.
  std::vector<std::string> laws_of(const UnitCell &cell) const override
  {
    std::vector<std::string> laws = {"linear"};
    for (const std::string &law : PeriodicStudy::laws_of(cell))
      if (std::find(laws.begin(), laws.end(), law) == laws.end())
        laws.push_back(law);
    return laws;
  }

  std::size_t n_paths() const override
  {
    std::size_t n = 0;
    for (const UnitCell &cell : cells())
      n += 2 * laws_of(cell).size() - 1;
    return n;
  }

  void solve(const UnitCell &cell, const AssessedCell &assessed, Progress &progress) override
  {
    const Eigen::Matrix3d C_given = stiffness_at_rest(resolved_cloth(cell, 0, Law::linear));
    const Eigen::Matrix3d C_finer = stiffness_at_rest(resolved_cloth(cell, 1, Law::linear));
    verdicts.push_back(
      verdict_on_slope(cell.name, energy_difference(C_given, assessed.result.stiffness),
                       algebraic_limit(cell, std::sqrt(0.5 * cell.mesh.n_triangles()))));
    const double factor = factor_of_bars(cell);
    for (const std::string &name : laws_of(cell))
    {
      const Law law = law_of(name);
      progress.milestone(cell.name + ", " + name);
      add_path({cell.name, name, "resolved"}, resolved_cloth(cell, 0, law),
               resolved_cloth(cell, 1, law), factor);
      progress.done();
      if (law == Law::linear) // C^H is what the cell is, then
        continue;
      progress.begin(cell.name + ", " + name + ", C^H in place of the cell");
      add_path({cell.name, name, "coarse"}, uniform_cloth(cell.lattice, C_given, law),
               uniform_cloth(cell.lattice, C_finer, law), factor);
      progress.done();
    }
  }

  void add_path(const LoadRow &of_path, const CellAssembly &given, const CellAssembly &finer,
                const double factor)
  {
    const LoadPath path     = load_path(given, options.control, options.n_steps);
    const LoadPath at_finer = load_path(finer, options.control, options.n_steps);
    for (const LoadRow &row : rows_of(path, at_finer, of_path, options.control, factor))
      table->append(row);
    add(verdicts_on_path({{"cell", of_path.cell}, {"law", of_path.law}, {"method", of_path.method}},
                         given, options.control, path, options.n_steps));
  }

  StudyDescription conclude() override
  {
    StudyDescription all =
      description({{"control", options.control.text()}, {"axis", options.control.axis}},
                  notes_on_load(options.control, options.n_steps));
    if (measured.empty())
      all.left_out.push_back({{"what", "measured curves"}, {"why", "--measured names no file"}});
    return all;
  }

  const LoadStudyOptions options;
  // On the first rank alone:
  std::vector<LoadRow> measured;
  std::unique_ptr<Table<LoadRow>> table;
};

class StabilityStudy final : public PeriodicStudy
{
public:
  StabilityStudy(const StabilityStudyOptions &options, const MPI_Comm communicator)
      : PeriodicStudy("stability", options, communicator)
      , options(options)
  {
    const std::set<double> sorted(options.strains.begin(), options.strains.end());
    const auto rest = sorted.lower_bound(0.);
    for (const std::vector<double> &way :
         {std::vector<double>(std::make_reverse_iterator(rest), sorted.rend()),
          std::vector<double>(rest, sorted.end())})
      if (!way.empty())
        ways.push_back(way);
  }

private:
  nlohmann::ordered_json inputs() override
  {
    const std::string cells = options.supercell ? std::to_string((*options.supercell)(0)) + "x" +
                                                    std::to_string((*options.supercell)(1))
                                                : "of the lowest wave";
    return with_laws({{"loads", options.loads},
                      {"strains", options.strains},
                      {"refinements", options.n_refinements},
                      {"supercell", cells}});
  }

  std::vector<OwedClaim> owed() const override
  {
    std::vector<OwedClaim> owed = owed_of_cells(cells());
    for (const UnitCell &cell : cells())
      for (const std::string &law : laws_of(cell))
      {
        owed.push_back({"beta-at-rest", {{"cell", cell.name}, {"law", law}}});
        for (const std::string &load : options.loads)
          for (const std::vector<double> &strains : ways)
            add_owed_of_margins(
              {{"cell", cell.name}, {"law", law}, {"load", load}, {"way", name_of_way(strains)}},
              options.n_refinements, owed);
      }
    return owed;
  }

  static const char *name_of_way(const std::vector<double> &strains)
  {
    return strains.front() < 0. ? "pressed" : "pulled";
  }

  void open_tables() override
  {
    table = std::make_unique<Table<StabilityRow>>(options.output);
  }

  std::size_t n_paths() const override
  {
    return cells().size() * std::max<std::size_t>(1, options.laws.size()) * options.loads.size() *
           ways.size();
  }

  void solve(const UnitCell &cell, const AssessedCell &, Progress &progress) override
  {
    const double factor = factor_of_bars(cell);
    for (const std::string &law : laws_of(cell))
    {
      const BlochMargin given(resolved_cloth(cell, 0, law_of(law)));
      std::unique_ptr<BlochMargin> refined;
      if (options.n_refinements > 0)
        refined = std::make_unique<BlochMargin>(resolved_cloth(cell, 1, law_of(law)));
      verdicts.push_back(verdict_on_rest(cell.name, law, given));
      for (const std::string &load : options.loads)
        for (const std::vector<double> &strains : ways)
        {
          StabilityRow names;
          names.cell = cell.name;
          names.law  = law;
          names.load = load;
          names.way  = name_of_way(strains);
          progress.milestone(cell.name + ", " + law + ", " + load + ", " + names.way);
          add_path(names, strains, given, refined.get(), factor);
          progress.done();
        }
    }
  }

  void add_path(StabilityRow names, const std::vector<double> &strains, const BlochMargin &given,
                const BlochMargin *refined, const double factor)
  {
    names.mesh = refined ? "refined" : "given";
    if (table->contains(row_of(names, "loss", 0, 0.))) // the last row that a path leaves
      return;
    const LoadControl control = load_control(Load(names.load));
    names.mesh                = "given";
    MarginPath path           = margin_path(given, control, strains, names);
    append(path.rows);
    append(waves_of(given, path.shown, names));
    append(mode_of(given.assembly.cell.mesh, path.shown, names));
    append(patterns_of(given, control, path.levels, options.supercell, names));
    if (refined)
    {
      names.mesh       = "refined";
      MarginPath finer = margin_path(*refined, control, strains, names);
      append(finer.rows);
      path.loss.strain_bar = finer.loss.strain_bar =
        larger(factor * std::abs(path.loss.strain - finer.loss.strain),
               larger(path.loss.apart(), finer.loss.apart()));
      append({path.loss, finer.loss});
    }
    else
      append({path.loss});
  }

  void append(const std::vector<StabilityRow> &rows)
  {
    for (const StabilityRow &row : rows)
      table->append_if_missing(row);
  }

  StudyDescription conclude() override
  {
    add(verdicts_on_margins(table->rows()));
    return description({{"loads", options.loads}}, notes_on_margins(table->rows()));
  }

  const StabilityStudyOptions options;
  std::vector<std::vector<double>> ways; ///< strains that are pressed, that are pulled
  // On the first rank alone:
  std::unique_ptr<Table<StabilityRow>> table;
};
} // namespace

std::vector<Verdict> run_load_study(const LoadStudyOptions &options, const MPI_Comm communicator)
{
  LoadStudy study(options, communicator);
  if (!options.quiet && is_root(communicator))
    std::cout << "Prescribed: " << options.control.text() << "; axis " << options.control.axis
              << " keeps its direction\n";
  return study.run();
}

std::vector<Verdict> run_stability_study(const StabilityStudyOptions &options,
                                         const MPI_Comm communicator)
{
  return StabilityStudy(options, communicator).run();
}
} // namespace homespun::verification
