// SPDX-License-Identifier: MIT
#include "verification/load/load_study.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/refine.h"
#include "verification/cell/algebraic_limit.h"
#include "verification/cell/energy_order.h"
#include "verification/cell/study_inputs.h"
#include "verification/cell/study_of_cells.h"
#include "verification/laws/default_law.h"
#include "verification/laws/yarn_cells.h"
#include "verification/load/load_path.h"
#include "verification/load/measured_curve.h"
#include "verification/record/number_text.h"
#include "verification/record/on_root.h"
#include "verification/record/progress.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <set>

namespace homespun::verification
{
namespace
{
using homogenization::UnitCell;
using meshes::HomogenizedCell;

/// What a cloth of a mesh, its lattice and its anchor is; chi and C^H are not used.
HomogenizedCell cell_of(const meshes::TriangleMesh &mesh, const meshes::Lattice &lattice)
{
  HomogenizedCell cell;
  cell.mesh    = mesh;
  cell.lattice = lattice;
  cell.anchor  = meshes::anchor_vertex(mesh, lattice);
  return cell;
}

/// A parallelogram of two triangles: a cloth without a microstructure.
meshes::TriangleMesh two_triangles(const meshes::Lattice &lattice)
{
  meshes::TriangleMesh mesh;
  mesh.vertices.setZero(4, 2);
  mesh.vertices.row(1) = lattice.vectors.row(0);
  mesh.vertices.row(2) = lattice.vectors.row(0) + lattice.vectors.row(1);
  mesh.vertices.row(3) = lattice.vectors.row(1);
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  mesh.material.setZero(2);
  return mesh;
}

/// The cell, once more refined, and the cloths with the C^H of both.
struct Cloths
{
  Cloths(const UnitCell &cell)
      : given(cell_of(cell.mesh, cell.lattice))
      , finer(cell_of(meshes::refined(cell.mesh, 1), cell.lattice))
      , uniform(cell_of(two_triangles(cell.lattice), cell.lattice))
      , phases(cell.stiffness_of_phase())
      , C_given(stiffness_at_rest(CellAssembly(given, phases, Law::linear)))
      , C_finer(stiffness_at_rest(CellAssembly(finer, phases, Law::linear)))
  {
  }

  const HomogenizedCell given, finer, uniform;
  const std::vector<Eigen::Matrix3d> phases;
  const Eigen::Matrix3d C_given, C_finer;
};

/// The rows of a path; bars where the finer mesh reached the level too.
std::vector<LoadRow> rows_of(const LoadPath &path, const LoadPath &finer, const LoadRow &of_path,
                             const LoadControl &control, const double factor)
{
  std::vector<LoadRow> rows;
  for (std::size_t k = 0; k < path.levels.size(); ++k)
  {
    const LoadLevel &level = path.levels[k];
    LoadRow row            = of_path;
    row.step               = static_cast<int>(k) + 1;
    row.factor             = level.factor;
    // What is prescribed stands there as it was prescribed, free of the rounding of F and P.
    Eigen::Vector3d strain = level.strain, stress = level.stress;
    for (std::size_t c = 0; c < 3; ++c)
      (control.is_stress[c] ? stress : strain)(static_cast<long>(c)) =
        level.factor * control.value(static_cast<long>(c));
    row.strain_11 = strain(0), row.strain_22 = strain(1), row.strain_12 = strain(2);
    row.stress_11 = stress(0), row.stress_22 = stress(1), row.stress_12 = stress(2);
    row.energy = level.energy;
    row.stable = level.is_stable;
    if (k < finer.levels.size())
    {
      strain = factor * (level.strain - finer.levels[k].strain).cwiseAbs();
      stress = factor * (level.stress - finer.levels[k].stress).cwiseAbs();
      for (std::size_t c = 0; c < 3; ++c)
        (control.is_stress[c] ? stress : strain)(static_cast<long>(c)) = 0.;
      row.strain_11_bar = strain(0), row.strain_22_bar = strain(1), row.strain_12_bar = strain(2);
      row.stress_11_bar = stress(0), row.stress_22_bar = stress(1), row.stress_12_bar = stress(2);
    }
    rows.push_back(row);
  }
  return rows;
}

Verdict verdict_on_rest(const UnitCell &cell, const Cloths &cloths, const AssessedCell &assessed)
{
  const double difference = energy_difference(cloths.C_given, assessed.result.stiffness);
  const double limit      = algebraic_limit(cell, std::sqrt(0.5 * cell.mesh.n_triangles()));
  return {cell.name + ": the slope of the path at rest is C^H of the cell problems on the same "
                      "mesh (largest relative difference of an energy)",
          difference <= limit ? Outcome::pass : Outcome::fail,
          difference,
          "<= " + short_text(limit),
          "two programs for one discrete problem: what round-off and the solver leave of both, by "
          "contrast and mesh",
          Kind::program};
}

Verdict verdict_on_work(const std::string &what, const WorkCheck &check)
{
  // Where the energy jumps from one equilibrium to another, its differences say nothing.
  const bool says_something = check.bar <= 1e-3 * std::abs(check.work);
  const Outcome outcome     = check.difference <= check.bar ? Outcome::pass : Outcome::fail;
  return {what + "the stress is the derivative of the energy at the last level (distance of the "
                 "work from a central difference along the strains, N/m)",
          says_something ? outcome : Outcome::inconclusive,
          check.difference,
          "<= " + short_text(check.bar),
          "central differences of steps h and 2h differ by three times the error of the first; and "
          "the rounding of the energy and of its gradients over h; open where that is more than a "
          "thousandth of the "
          "work",
          Kind::program};
}

Verdict verdict_on_reaching(const std::string &what, const std::size_t n_reached, const int n_steps,
                            const std::string &why)
{
  const double missing = n_steps - static_cast<double>(n_reached);
  return {what + "every level has an equilibrium (levels that were not reached)",
          missing == 0.    ? Outcome::pass
          : n_reached == 0 ? Outcome::fail
                           : Outcome::inconclusive,
          missing,
          why.empty() ? "0" : "0; found: " + why,
          "every step is asked for; one without equilibrium is open, because the cloth itself may "
          "have none there, and a path without a single level says nothing",
          Kind::method};
}

Verdict verdict_on_stability(const std::string &what, const LoadPath &path)
{
  const auto n_unstable = std::count_if(path.levels.begin(), path.levels.end(),
                                        [](const LoadLevel &level) { return !level.is_stable; });
  return {what + "every level is a minimum of the energy, against fluctuations of one cell and the "
                 "free strains (levels that are not)",
          n_unstable == 0 ? Outcome::pass : Outcome::inconclusive,
          static_cast<double>(n_unstable),
          "0",
          "a cloth leaves a state that is no minimum; where to is open",
          Kind::method};
}

class LoadStudy final : public StudyOfCells
{
public:
  LoadStudy(const LoadStudyOptions &options, const MPI_Comm communicator)
      : StudyOfCells("load", options, communicator)
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
    std::set<std::string> names;
    for (const std::string &file : options.measured)
      for (const MeasuredRow &row : read_measured_curve(file))
      {
        if (row.point == 1 && !names.insert(row.curve).second)
          throw meshes::BadInput(file + ": another measured curve is called `" + row.curve +
                                 "` too; expected files of different names: rename one");
        measured.push_back(row);
      }
    nlohmann::ordered_json all = {{"control", options.control.text()},
                                  {"axis", options.control.axis},
                                  {"steps", options.n_steps}};
    for (int k = 0; k < 3; ++k) // the text has six digits
      all["value " + std::to_string(k + 1)] = options.control.value(k);
    std::string points;
    for (const MeasuredRow &row : measured)
      for (const std::string &field : fields_of_row(row))
        points += field + ",";
    all["measured"] = fingerprint(points);
    for (const UnitCell &cell : cells())
      all["law of " + cell.name] = laws_of(cell);
    return all;
  }

  void open_tables() override
  {
    table = std::make_unique<Table<LoadRow>>(options.output);
    // Paths are short, and solved whole.
    table->keep([](const LoadRow &) { return false; });
    if (!measured.empty())
      Table<MeasuredRow>(options.output).replace(measured);
  }

  void work() override
  {
    const std::vector<AssessedCell> assessed = homogenize_all();
    on_root(communicator, [&]() { solve(assessed); });
  }

  void solve(const std::vector<AssessedCell> &assessed)
  {
    std::size_t n_paths = 0;
    for (const UnitCell &cell : cells())
      n_paths += 2 * laws_of(cell).size() - 1;
    Progress progress(!options.quiet, static_cast<int>(n_paths));
    for (std::size_t k = 0; k < cells().size(); ++k)
    {
      const UnitCell &cell = cells()[k];
      write_cell(cell, assessed[k]);
      const Cloths cloths(cell);
      verdicts.push_back(verdict_on_rest(cell, cloths, assessed[k]));
      const double factor = factor_of_bars(cell);
      for (const std::string &law : laws_of(cell))
      {
        progress.milestone(cell.name + ", " + law);
        add_path({cell.name, law, "resolved"}, {cloths.given, cloths.phases, law_of(law)},
                 {cloths.finer, cloths.phases, law_of(law)}, factor);
        progress.done();
        if (law == "linear") // C^H is what the cell is, then
          continue;
        progress.begin(cell.name + ", " + law + ", C^H in place of the cell");
        add_path({cell.name, law, "coarse"}, {cloths.uniform, {cloths.C_given}, law_of(law)},
                 {cloths.uniform, {cloths.C_finer}, law_of(law)}, factor);
        progress.done();
      }
    }
  }

  /// Linear first.
  std::vector<std::string> laws_of(const UnitCell &cell) const
  {
    std::vector<std::string> laws = {"linear"};
    for (const std::string &law : laws_for(cell, options.laws))
      if (std::find(laws.begin(), laws.end(), law) == laws.end())
        laws.push_back(law);
    return laws;
  }

  void add_path(const LoadRow &of_path, const CellAssembly &given, const CellAssembly &finer,
                const double factor)
  {
    const std::string what  = of_path.cell + ", " + of_path.law + ", " + of_path.method + ": ";
    const LoadPath path     = load_path(given, options.control, options.n_steps);
    const LoadPath at_finer = load_path(finer, options.control, options.n_steps);
    for (const LoadRow &row : rows_of(path, at_finer, of_path, options.control, factor))
      table->append(row);
    verdicts.push_back(verdict_on_reaching(what, path.levels.size(), options.n_steps, path.why));
    if (!path.levels.empty())
      verdicts.push_back(verdict_on_work(what, check_work(given, options.control, path)));
    verdicts.push_back(verdict_on_stability(what, path));
  }

  StudyDescription conclude() override
  {
    std::set<std::string> laws;
    for (const UnitCell &cell : cells())
      for (const std::string &law : laws_of(cell))
        laws.insert(law);
    std::vector<std::string> notes = {
      "Prescribed: " + options.control.text() + "; " + std::to_string(options.n_steps) + " steps.",
      "Strains are those of F = (1 + e11, " +
        std::string(options.control.axis == 1 ? "e12; 0" : "0; e12") +
        ", 1 + e22): the material axis " + std::to_string(options.control.axis) +
        " keeps its direction. Stresses are nominal, forces per rest width, and work on these "
        "strains.",
      "`resolved` is one cell with its phases and periodic fluctuations, P1 on the given mesh; "
      "`coarse` has C^H in place of the cell, as the coarse cloth has it. Under the law linear "
      "both "
      "are the same.",
      "Bars: 1.25 |mesh - once refined mesh| / (1 - 2^-q), q the order of the energy that the "
      "corners of the cell leave. They know nothing of the law.",
      "Stable means: against the fluctuation of one cell and the free strains; longer waves are "
      "not asked."};
    if (options.laws.empty())
      for (const UnitCell &cell : cells())
        notes.push_back(note_on_default_law(cell));
    nlohmann::ordered_json left_out = {
      {{"what", "mass, damping, third dimension, contact"},
       {"why", "an infinite cloth in its plane, in equilibrium"}},
      {{"what", "edges and clamps"}, {"why", "an infinite cloth has none; `homespun strain` has"}}};
    if (measured.empty())
      left_out.push_back({{"what", "measured curves"}, {"why", "--measured names no file"}});
    return {{{"control", options.control.text()}, {"axis", options.control.axis}, {"laws", laws}},
            left_out,
            notes};
  }

  const LoadStudyOptions options;
  // On the first rank alone:
  std::vector<MeasuredRow> measured;
  std::unique_ptr<Table<LoadRow>> table;
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
} // namespace homespun::verification
