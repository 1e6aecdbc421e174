// SPDX-License-Identifier: MIT
#include "verification/bloch/stability_study.h"

#include "meshes/plain/errors.h"
#include "verification/bloch/margin_path.h"
#include "verification/bloch/pattern_rows.h"
#include "verification/bloch/stability_verdicts.h"
#include "verification/cell/study_of_cells.h"
#include "verification/laws/default_law.h"
#include "verification/laws/yarn_cells.h"
#include "verification/record/number_text.h"
#include "verification/record/on_root.h"
#include "verification/record/progress.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

namespace homespun::verification
{
namespace
{
using homogenization::UnitCell;

/// The strains of one sign, ascending in size; nothing where there are none.
std::vector<double> strains_of(const std::vector<double> &all, const double sign)
{
  std::vector<double> some;
  for (const double strain : all)
    if (sign * strain > 0.)
      some.push_back(strain);
  std::sort(some.begin(), some.end(),
            [](const double a, const double b) { return std::abs(a) < std::abs(b); });
  some.erase(std::unique(some.begin(), some.end()), some.end());
  return some;
}

template <typename Row, typename Names>
std::vector<Row> named(std::vector<Row> rows, const Names &names)
{
  for (Row &row : rows)
    names(row);
  return rows;
}

class StabilityStudy final : public StudyOfCells
{
public:
  StabilityStudy(const StabilityStudyOptions &options, const MPI_Comm communicator)
      : StudyOfCells("stability", options, communicator)
      , options(options)
  {
  }

private:
  void refuse() const override
  {
    check_yarns(cells(), "--law", options.laws);
  }

  nlohmann::ordered_json inputs() override
  {
    nlohmann::ordered_json all = {{"loads", options.loads},
                                  {"strains", options.strains},
                                  {"refinements", options.n_refinements}};
    all["supercell"]           = options.supercell ? std::to_string((*options.supercell)(0)) + "x" +
                                             std::to_string((*options.supercell)(1))
                                                   : "of the lowest wave";
    for (const UnitCell &cell : cells())
      all["law of " + cell.name] = laws_for(cell, options.laws);
    return all;
  }

  void open_tables() override
  {
    levels   = std::make_unique<Table<StabilityRow>>(options.output);
    losses   = std::make_unique<Table<LossRow>>(options.output);
    zones    = std::make_unique<Table<ZoneRow>>(options.output);
    modes    = std::make_unique<Table<ModeRow>>(options.output);
    patterns = std::make_unique<Table<PatternRow>>(options.output);
  }

  void work() override
  {
    const std::vector<AssessedCell> assessed = homogenize_all();
    on_root(communicator, [&]() { solve(assessed); });
  }

  void solve(const std::vector<AssessedCell> &assessed)
  {
    std::vector<std::vector<double>> ways;
    for (const double sign : {-1., 1.})
      if (const std::vector<double> strains = strains_of(options.strains, sign); !strains.empty())
        ways.push_back(strains);
    const std::size_t n_laws = std::max<std::size_t>(1, options.laws.size());
    Progress progress(!options.quiet, static_cast<int>(cells().size() * n_laws *
                                                       options.loads.size() * ways.size()));
    for (std::size_t k = 0; k < cells().size(); ++k)
    {
      const UnitCell &cell = cells()[k];
      write_cell(cell, assessed[k]);
      const double factor = factor_of_bars(cell);
      for (const std::string &law : laws_for(cell, options.laws))
      {
        const MeshOfCell given(cell, 0, law_of(law));
        std::unique_ptr<MeshOfCell> refined;
        if (options.n_refinements > 0)
          refined = std::make_unique<MeshOfCell>(cell, 1, law_of(law));
        verdicts.push_back(verdict_on_rest(cell.name + ", " + law, given.bloch, given.assembly));
        for (const std::string &load : options.loads)
          for (const std::vector<double> &strains : ways)
          {
            progress.milestone(cell.name + ", " + law + ", " + load +
                               (strains.front() < 0. ? ", pressed" : ", pulled"));
            LossRow names;
            names.cell = cell.name;
            names.law  = law;
            names.load = load;
            add_path(names, strains, given, refined.get(), factor);
            progress.done();
          }
      }
    }
  }

  void add_path(const LossRow &names, const std::vector<double> &strains, const MeshOfCell &given,
                const MeshOfCell *refined, const double factor)
  {
    const auto name = [&](auto &row)
    {
      row.cell = names.cell;
      row.law  = names.law;
      row.load = names.load;
    };
    LossRow of_path = names;
    of_path.way     = strains.front() < 0. ? "pressed" : "pulled";
    of_path.mesh    = refined ? "refined" : "given";
    if (losses->contains(of_path)) // the last row that a path leaves
      return;
    const Load load(names.load);
    MarginPath path = margin_path(given.assembly, given.bloch, load, strains);
    append(path, "given", name);
    for (ZoneRow &row : named(zone_of(given.assembly, given.bloch, path.shown), name))
    {
      row.way = of_path.way;
      zones->append_if_missing(row);
    }
    for (ModeRow &row : named(mode_of(given.assembly, path.shown), name))
    {
      row.way = of_path.way;
      modes->append_if_missing(row);
    }
    for (const PatternRow &row : patterns_of(given, load, path.rows, options.supercell))
      patterns->append_if_missing(row);
    name(path.loss);
    path.loss.mesh = "given";
    if (!refined)
    {
      losses->append(path.loss);
      return;
    }
    MarginPath finer = margin_path(refined->assembly, refined->bloch, load, strains);
    append(finer, "refined", name);
    name(finer.loss);
    finer.loss.mesh      = "refined";
    const double bar     = factor * std::abs(path.loss.strain - finer.loss.strain);
    path.loss.strain_bar = finer.loss.strain_bar = bar;
    losses->append_if_missing(path.loss);
    losses->append(finer.loss);
  }

  template <typename Name>
  void append(MarginPath &path, const std::string &mesh, const Name &name)
  {
    for (StabilityRow &row : path.rows)
    {
      name(row);
      row.mesh = mesh;
      levels->append_if_missing(row);
    }
  }

  StudyDescription conclude() override
  {
    const std::vector<Verdict> of_rows = verdicts_on_rows(levels->rows(), losses->rows());
    verdicts.insert(verdicts.end(), of_rows.begin(), of_rows.end());
    const std::vector<Verdict> of_patterns = verdicts_on_patterns(patterns->rows());
    verdicts.insert(verdicts.end(), of_patterns.begin(), of_patterns.end());
    std::vector<std::string> notes = notes_on_losses(losses->rows());
    if (options.laws.empty())
      for (const UnitCell &cell : cells())
        notes.push_back(note_on_default_law(cell));
    for (const std::string &note : notes_on_patterns(patterns->rows()))
      notes.push_back(note);
    for (
      const char *note :
      {"beta is the least eigenvalue of the tangent stiffness on waves of every length, relative "
       "to the stiffness at rest: 1 at rest, zero where a wave costs nothing.",
       "Of each state 49 waves are asked, one of k and -k, 12 of them long ones in the limit; "
       "and then those around the lowest, to 1/128 of the reciprocal vectors.",
       "`unstable-proved`: a field with a negative second variation was found: the state of the "
       "discrete cloth is no minimum. `stable-up-to-mesh`: every wave that was asked is positive "
       "definite by Cholesky factors; a finer mesh has more fields and a lower beta, and other "
       "waves lie between.",
       "A positive beta tells of a strict local minimum: a distant lower state is not excluded.",
       "beta_lower: no wave that was asked is below, by the inertia of K - beta K0, up to the "
       "rounding of its factors.",
       "The strain of first loss lies between held_to and lost_at on its mesh; strain_bar is "
       "1.25 |given - refined| / (1 - 2^-q), q the order of the energy that the corners of the "
       "cell leave, and knows nothing of the law.",
       "The zone and the mode are those of the given mesh just beyond the first loss, or else "
       "at the last strain that was reached."})
      notes.push_back(note);
    const nlohmann::ordered_json left_out = {
      {{"what", "mass, damping, third dimension, contact"},
       {"why", "an infinite cloth in its plane, in equilibrium: a cloth that is free to leave its "
               "plane wrinkles sooner wherever it is pressed"}},
      {{"what", "edges and clamps"}, {"why", "an infinite cloth has none"}}};
    return {{{"loads", options.loads}, {"laws", used_laws()}}, left_out, notes};
  }

  /// Of all cells, each once.
  std::vector<std::string> used_laws() const
  {
    std::set<std::string> names;
    for (const UnitCell &cell : cells())
      for (const std::string &law : laws_for(cell, options.laws))
        names.insert(law);
    return {names.begin(), names.end()};
  }

  const StabilityStudyOptions options;
  // On the first rank alone:
  std::unique_ptr<Table<StabilityRow>> levels;
  std::unique_ptr<Table<LossRow>> losses;
  std::unique_ptr<Table<ZoneRow>> zones;
  std::unique_ptr<Table<ModeRow>> modes;
  std::unique_ptr<Table<PatternRow>> patterns;
};
} // namespace

std::vector<Verdict> run_stability_study(const StabilityStudyOptions &options,
                                         const MPI_Comm communicator)
{
  return StabilityStudy(options, communicator).run();
}
} // namespace homespun::verification
