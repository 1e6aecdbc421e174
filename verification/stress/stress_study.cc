// SPDX-License-Identifier: MIT
#include "verification/stress/stress_study.h"

#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_reading.h"
#include "meshes/plain/errors.h"
#include "verification/cell/energy_order.h"
#include "verification/cell/study_inputs.h"
#include "verification/cell/study_of_cells.h"
#include "verification/command/data_folder.h"
#include "verification/record/number_text.h"
#include "verification/record/on_root.h"
#include "verification/record/progress.h"
#include "verification/record/provenance.h"
#include "verification/record/table.h"
#include "verification/stress/stress_axes.h"
#include "verification/stress/stress_localization.h"
#include "verification/stress/stress_sheet_axes.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <utility>

namespace homespun::verification
{
namespace
{
nlohmann::ordered_json what_was_left_out(const int n_ranks)
{
  nlohmann::ordered_json all;
  const auto left_out = [&](const char *what, const char *why) {
    all.push_back({{"what", what}, {"why", why}});
  };
  left_out("cloth and up-sampling on many threads and ranks", "one thread of one rank climbs");
  left_out("what tests the program and no limit of a cell or a cloth",
           "the tests of the program hold it");
  if (n_ranks == 1)
    left_out("C^H by several ranks beside one", "the study ran on one rank");
  return all;
}

const std::vector<std::string> notes = {
  "An axis drives one thing from harmless to hard by factors of 2, 10 or 1000, and ends at the "
  "first "
  "answer that is wrong or refused. Linear problems are right within 1e-6 of theory or of a direct "
  "solve, a motion within 1e-3 of where ever smaller steps go, momenta and energies to ten digits.",
  "Where theory promises that an axis does not end before a value, and where a limit is published "
  "for it, that is a claim. Else an end is a result and no failure.",
  "The last value that is right is run twice: numbers must be the same to the last bit.",
  "Of a free sheet that spins each integrator is asked for what its theory gives. That a sheet "
  "turns is judged by (x_new − x_old)/h: half of what a rigid body would turn by is asked for.",
  "A stiffness that loses ellipticity under the corotational law, pulled along its yarns, before "
  "20 %, has a twin under the law yarn."};

/// The limits that are shipped with the program.
std::vector<PublishedLimitRow> published_limits()
{
  const std::string path = data_folder("limits.csv", "verification/published/limits.csv");
  if (!std::filesystem::exists(path))
    return {};
  return read_table<PublishedLimitRow>(path);
}

/// Whether a cell is the shipped one of its name.
bool is_shipped(const UnitCell &cell)
{
  const std::string file = cells_folder() + "/" + cell.name + ".prm";
  return std::filesystem::exists(file) &&
         fingerprint(homogenization::read_unit_cell(file)) == fingerprint(cell);
}

class StressStudy final : public StudyOfCells
{
public:
  StressStudy(const StressStudyOptions &options, const MPI_Comm communicator)
      : StudyOfCells("stress", options, communicator)
      , options(options)
  {
  }

private:
  void refuse() const override
  {
    refuse_cells_without_sheets(cells());
  }

  nlohmann::ordered_json inputs() override
  {
    return {{"most_triangles", options.most_triangles}, {"ranks", n_ranks()}};
  }

  void open_tables() override
  {
    limits = std::make_unique<Table<LimitRow>>(options.output);
    rungs  = std::make_unique<Table<StressRow>>(options.output);
  }

  void work() override
  {
    std::vector<Eigen::Matrix3d> by_all_ranks;
    homogenization::HomogenizationOptions p1;
    p1.order = 1;
    if (n_ranks() > 1)
      for (const UnitCell &cell : cells())
        by_all_ranks.push_back(homogenization::homogenize(cell, p1, communicator).stiffness);
    on_root(communicator,
            [&]()
            {
              collect(by_all_ranks);
              climb_all();
            });
  }

  void collect(const std::vector<Eigen::Matrix3d> &by_all_ranks)
  {
    std::vector<SheetStiffness> sheets;
    std::vector<bool> shipped; // of each
    for (const UnitCell &cell : cells().empty() ? made_cells() : cells())
    {
      const meshes::HomogenizedCell homogenized =
        homogenization::homogenized_cell(cell, solved(cell), provenance_line());
      sheets.push_back({cell.name, homogenized.stiffness, homogenized.areal_density});
      shipped.push_back(cells().empty() || is_shipped(cell));
      add(cell_axes(cell, options.most_triangles), shipped.back());
      add(localization_axes(homogenized, cell.name), shipped.back());
    }
    for (std::size_t k = 0; k < by_all_ranks.size(); ++k)
      add({ranks_axis(cells()[k], by_all_ranks[k])}, shipped[k]);
    if (cells().empty())
    {
      sheets = built_in_stiffnesses();
      shipped.assign(sheets.size(), true);
    }
    for (std::size_t k = 0; k < sheets.size(); ++k)
      for (const SheetStiffness &sheet : with_twins_of_yarn({sheets[k]}))
      {
        add(sheet_axes(sheet), shipped[k]);
        add(scene_axes(sheet), shipped[k]);
      }
    std::set<std::pair<std::string, std::string>> keys;
    for (const StressAxis &one : axes)
      if (!keys.insert({one.axis, one.of}).second)
        throw meshes::BadInput("two axes are called `" + one.axis + " of " + one.of +
                               "`; two cells have one name: rename a file");
  }

  void add(std::vector<StressAxis> some, const bool is_shipped)
  {
    for (StressAxis &one : some)
    {
      one.is_shipped = is_shipped;
      axes.push_back(std::move(one));
    }
  }

  /// That several ranks give the C^H of one.
  StressAxis ranks_axis(const UnitCell &cell, const Eigen::Matrix3d &parallel) const
  {
    StressAxis axis;
    axis.axis       = "ranks";
    axis.of         = cell.name;
    axis.value_is   = "ranks";
    axis.criterion  = "relative energy of the worst macro strain against one rank";
    axis.limit      = 1e-10;
    axis.ladder     = {static_cast<double>(n_ranks())};
    axis.theory     = TheoryOfEnd::promises;
    axis.theory_end = n_ranks();
    axis.theory_is  = "it is the same problem";
    axis.at         = [=](double) -> StressAnswer {
      return {energy_difference(parallel, solved(cell).stiffness), parallel};
    };
    return axis;
  }

  int n_ranks() const
  {
    return static_cast<int>(n_ranks_of(communicator));
  }

  /// Where the row of an axis stands in a table.
  template <typename Row>
  static auto find_row(const StressAxis &axis, const std::vector<Row> &rows)
  {
    return std::find_if(rows.begin(), rows.end(),
                        [&](const Row &row) { return row.axis == axis.axis && row.of == axis.of; });
  }

  OwedValue owed_of(const StressAxis &axis) const
  {
    const auto shipped = find_row(axis, published);
    return owed_value(axis, !axis.is_shipped || shipped == published.end() ? nullptr : &*shipped);
  }

  void climb_all()
  {
    std::size_t n_rungs = 0;
    for (const StressAxis &one : axes)
      n_rungs += one.ladder.size();
    Progress progress(is_root && !options.quiet, static_cast<int>(n_rungs));
    for (const StressAxis &one : axes)
    {
      const std::string name = one.axis + " of " + one.of;
      LimitRow row;
      row.axis = one.axis;
      row.of   = one.of;
      progress.milestone(name);
      std::size_t n_done = 0;
      if (!limits->contains(row))
      {
        row = climb(one, owed_of(one).value, options.longest,
                    [&](const StressRow &rung)
                    {
                      rungs->append_if_missing(rung);
                      progress.begin(name + ": " + short_text(rung.value) + " " + rung.outcome);
                      progress.done();
                      ++n_done;
                    });
        limits->append(row);
      }
      for (; n_done < one.ladder.size(); ++n_done)
        progress.done();
    }
  }

  StudyDescription conclude() override
  {
    for (const StressAxis &one : axes)
    {
      const auto found = find_row(one, limits->rows());
      if (const auto verdict =
            verdict_of(one, found == limits->rows().end() ? LimitRow() : *found, owed_of(one)))
        verdicts.push_back(*verdict);
    }
    return {{{"axes", axes.size()}}, what_was_left_out(n_ranks()), notes};
  }

  const StressStudyOptions options;
  const std::vector<PublishedLimitRow> published = published_limits();
  std::vector<StressAxis> axes;
  std::unique_ptr<Table<LimitRow>> limits; ///< both on the first rank alone
  std::unique_ptr<Table<StressRow>> rungs;
};
} // namespace

std::vector<Verdict> run_stress_study(const StressStudyOptions &options,
                                      const MPI_Comm communicator)
{
  return StressStudy(options, communicator).run();
}
} // namespace homespun::verification
